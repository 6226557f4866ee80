#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace armloom::experiments {

// The earliest path through a table of cells from the first row and column to the last. Each time
// step advances the row, the column, both or neither, and may not enter a blocked cell. Rows are
// added one after the other, so that a table may exceed the memory.
class ShortestWay {
 public:
  // `ready`: the step before which a column must not be entered.
  explicit ShortestWay(std::vector<std::size_t> ready);

  // Adds a row that must not be entered before step `ready`. Precondition: blocked.size() is the
  // number of columns.
  void add_row(std::span<const char> blocked, std::size_t ready);

  // Returns the number of steps to the last column of the last added row, or nullopt if there is no
  // path.
  [[nodiscard]] std::optional<std::size_t> steps() const;

 private:
  static constexpr std::size_t kNever = std::numeric_limits<std::size_t>::max();

  std::vector<std::size_t> ready_;
  std::vector<std::size_t> earliest_;  // for the last row
  bool begun_ = false;
};

}  // namespace armloom::experiments
