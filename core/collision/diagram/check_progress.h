#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>

namespace armloom {

// Lets other threads watch a check and end it early. Thread-safe.
class CheckProgress {
 public:
  // Sets how many cells the check may evaluate.
  void expect(std::uint64_t cells) { expected_ = cells; }
  void add(std::uint64_t cells) { done_ += cells; }
  // Returns the used share of the budget, 0 to 1. Most checks end long before 1.
  [[nodiscard]] double share() const {
    const std::uint64_t expected = expected_;
    if (expected == 0) return 0.0;
    return std::min(1.0, static_cast<double>(done_) / static_cast<double>(expected));
  }

  // Ends the check after its current batch of cells. The verdict of the check is then void.
  void interrupt() { interrupted_ = true; }
  [[nodiscard]] bool is_interrupted() const { return interrupted_; }

 private:
  std::atomic<std::uint64_t> expected_ = 0;
  std::atomic<std::uint64_t> done_ = 0;
  std::atomic<bool> interrupted_ = false;
};

}  // namespace armloom
