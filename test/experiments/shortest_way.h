#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace armloom::experiments {

// Finds the earliest path through a table, from the first row and column to the last. Each step
// advances the row, the column, both or neither, and avoids blocked fields. Rows are added one by
// one to save memory.
class ShortestWay {
 public:
  // `ready`: for each column, the first step in which it may be entered.
  explicit ShortestWay(std::vector<std::size_t> ready);

  // `ready`: first step in which the row may be entered. Precondition: blocked.size() is the number
  // of columns.
  void add_row(std::span<const char> blocked, std::size_t ready);

  // Steps to the last column of the last added row; nullopt if there is no path.
  [[nodiscard]] std::optional<std::size_t> steps() const;

 private:
  static constexpr std::size_t kNever = std::numeric_limits<std::size_t>::max();

  std::vector<std::size_t> ready_;
  std::vector<std::size_t> earliest_;  // for the last row
  bool begun_ = false;
};

}  // namespace armloom::experiments
