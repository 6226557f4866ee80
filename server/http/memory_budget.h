#pragma once

#include <cstddef>
#include <utility>

namespace armloom {

// Limits the memory of request and response bodies of all connections together. The first kFree
// bytes of each charge are free, so that a stop always gets through. Further bytes are refused when
// the budget is exhausted. Use on the server's thread. Must outlive its charges.
class MemoryBudget {
 public:
  inline static constexpr std::size_t kFree = 16 * 1024;  // bytes of each charge

  explicit MemoryBudget(std::size_t max) : max_(max) {}

  class Charge {
   public:
    Charge() = default;
    explicit Charge(MemoryBudget& budget) : budget_(&budget) {}
    Charge(Charge&& other) noexcept
        : budget_(std::exchange(other.budget_, nullptr)), held_(std::exchange(other.held_, 0)) {}
    Charge& operator=(Charge&& other) noexcept {
      std::swap(budget_, other.budget_);
      std::swap(held_, other.held_);
      return *this;
    }
    ~Charge() {
      if (budget_ != nullptr) budget_->used_ -= held_;
    }

    // Grows the charge to `bytes` in total, including the free bytes. Returns false and changes
    // nothing if the budget has no room.
    [[nodiscard]] bool grow_to(std::size_t bytes) {
      const std::size_t wanted = bytes > kFree ? bytes - kFree : 0;
      if (budget_ == nullptr || wanted <= held_) return true;
      if (budget_->max_ - budget_->used_ < wanted - held_) return false;
      budget_->used_ += wanted - held_;
      held_ = wanted;
      return true;
    }

   private:
    MemoryBudget* budget_ = nullptr;
    std::size_t held_ = 0;
  };

  [[nodiscard]] std::size_t used() const { return used_; }

 private:
  const std::size_t max_;
  std::size_t used_ = 0;
};

}  // namespace armloom
