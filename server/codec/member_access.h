#pragma once

#include <bit>
#include <cstddef>
#include <new>
#include <optional>
#include <type_traits>
#include <utility>

namespace armloom::formats {

// Refers to a function that takes the address of a value. The function must outlive this object.
template <class Void>
class AddressFunction {
 public:
  template <class F>
  AddressFunction(const F& call)
      : f_(&call), call_([](const void* f, Void* value) { (*static_cast<const F*>(f))(value); }) {}
  void operator()(Void* value) const { call_(f_, value); }

 private:
  const void* f_;
  void (*call_)(const void*, Void*);
};
using UseValue = AddressFunction<const void>;
using FillValue = AddressFunction<void>;

// Returns the offset of a member in bytes. In the Itanium C++ ABI (GCC; Clang except on Windows), a
// pointer to a data member is this number.
template <class T, class Where>
[[nodiscard]] std::ptrdiff_t offset_of(Where T::*where) {
  static_assert(sizeof where == sizeof(std::ptrdiff_t) && !std::is_function_v<Where>);
  return std::bit_cast<std::ptrdiff_t>(where);
}
[[nodiscard]] inline const void* address_at(const void* object, std::ptrdiff_t offset) {
  return static_cast<const std::byte*>(object) + offset;
}
[[nodiscard]] inline void* address_at(void* object, std::ptrdiff_t offset) {
  return static_cast<std::byte*>(object) + offset;
}

// Returns a value to read into. Eigen types need Zero(), because their constructors leave them
// uninitialized.
template <class M>
[[nodiscard]] M fresh() {
  if constexpr (requires { M::Zero(); }) {
    return M::Zero();
  } else {
    return M{};
  }
}

// Access to a value in an object whose type is erased: by the offset of the value, or by two
// functions.
class Access {
 public:
  // Calls use(address of the value in the object), unless the object has no such value.
  using Use = void (*)(const Access&, const void* object, const UseValue& use);
  // Calls fill(address of storage for the value). Then stores the value that was read in the
  // object.
  using Fill = void (*)(const Access&, void* object, const FillValue& fill);

  explicit Access(std::ptrdiff_t offset) : Access(offset, nullptr, nullptr) {}
  // `state` is kept for the functions. If one of the functions is null, `state` must be the offset.
  template <class State>
  Access(const State& state, Use use, Fill fill) : use_(use), fill_(fill) {
    static_assert(std::is_trivially_copyable_v<State> && sizeof(State) <= sizeof state_);
    new (state_) State(state);
  }

  template <class Call>
  void use_value(const void* object, const Call& call) const {
    if (use_ != nullptr) return use_(*this, object, UseValue(call));
    call(address_at(object, state<std::ptrdiff_t>()));
  }
  template <class Call>
  void fill_value(void* object, const Call& call) const {
    if (fill_ != nullptr) return fill_(*this, object, FillValue(call));
    call(address_at(object, state<std::ptrdiff_t>()));
  }
  template <class State>
  [[nodiscard]] const State& state() const {
    return *std::launder(reinterpret_cast<const State*>(state_));
  }
  template <class Member>
  [[nodiscard]] const Member& member(const void* object) const {
    return *static_cast<const Member*>(address_at(object, state<std::ptrdiff_t>()));
  }
  template <class Member>
  [[nodiscard]] Member& member(void* object) const {
    return *static_cast<Member*>(address_at(object, state<std::ptrdiff_t>()));
  }

 private:
  Use use_;
  Fill fill_;
  alignas(std::max_align_t) std::byte state_[40];
};

template <class T, class M>
[[nodiscard]] Access member_access(std::optional<M> T::*where) {
  using Maybe = std::optional<M>;
  return Access(
      offset_of(where),
      [](const Access& access, const void* object, const UseValue& use) {
        if (const Maybe& maybe = access.member<Maybe>(object)) use(&*maybe);
      },
      [](const Access& access, void* object, const FillValue& fill) {
        Maybe& maybe = access.member<Maybe>(object);
        fill(maybe ? &*maybe : &maybe.emplace(fresh<M>()));
      });
}
// Returns an access to a list, dictionary or text. If it is empty, the object has no value.
template <class T, class M>
[[nodiscard]] Access unless_empty(M T::*where) {
  return Access(
      offset_of(where),
      [](const Access& access, const void* object, const UseValue& use) {
        if (const M& member = access.member<M>(object); !member.empty()) use(&member);
      },
      nullptr);
}

// Returns an access by two functions. Get(const T&) returns std::optional<M>; Put(T&, M) stores the
// value that was read.
template <class T, class M, class Get, class Put>
[[nodiscard]] Access computed_access(Get get, Put put) {
  struct Both {
    Get get;
    Put put;
  };
  return Access(
      Both{get, put},
      [](const Access& access, const void* object, const UseValue& use) {
        const std::optional<M> value = access.state<Both>().get(*static_cast<const T*>(object));
        if (value) use(&*value);
      },
      [](const Access& access, void* object, const FillValue& fill) {
        const Both& both = access.state<Both>();
        T& out = *static_cast<T*>(object);
        std::optional<M> value = both.get(std::as_const(out));
        if (!value) value = fresh<M>();
        fill(&*value);
        both.put(out, std::move(*value));
      });
}

}  // namespace armloom::formats
