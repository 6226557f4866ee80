#include "server/codec/format.h"

#include <cmath>
#include <cstdint>

#include "server/codec/part.h"

namespace armloom {

template <class Any>
SharedAny<Any>::SharedAny(const Any* made) : any_(made) {}
template <class Any>
SharedAny<Any>::SharedAny(const SharedAny& other) = default;
template <class Any>
SharedAny<Any>::SharedAny(SharedAny&& other) noexcept = default;
template <class Any>
SharedAny<Any>& SharedAny<Any>::operator=(SharedAny other) noexcept {
  any_.swap(other.any_);
  return *this;
}
template <class Any>
SharedAny<Any>::~SharedAny() = default;

template class SharedAny<AnyFormat>;
template class SharedAny<formats::AnyPart>;

Schema as_json(double number) {
  constexpr double kWholeMax = 1e15;
  if (std::abs(number) <= kWholeMax && number == std::trunc(number)) {
    return static_cast<std::int64_t>(number);
  }
  return number;
}

Schema as_json(const JsonWriter& written) { return Schema::parse(written.text()); }

Schema as_json(const AnyFormat& format, const void* value) {
  JsonWriter out;
  format.write_any(out, value);
  return as_json(out);
}

}  // namespace armloom
