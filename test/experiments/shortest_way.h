#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace armloom::experiments {

// The earliest way through a table of cells, from the first row and column to the last: each step
// of time advances a row, a column, both or none, and comes to no blocked cell. Rows are handed in
// one after the other, so that a table may be larger than the memory.
class ShortestWay {
 public:
  // `ready`: the step before which a column may not be come to.
  explicit ShortestWay(std::vector<std::size_t> ready);

  // Preconditions: blocked.size() is the number of columns. `ready`: of the row.
  void add_row(std::span<const char> blocked, std::size_t ready);

  // Steps until the last column of the last row that was added; absent: there is no way.
  [[nodiscard]] std::optional<std::size_t> steps() const;

 private:
  static constexpr std::size_t kNever = std::numeric_limits<std::size_t>::max();

  std::vector<std::size_t> ready_;
  std::vector<std::size_t> earliest_;  // of the last row
  bool begun_ = false;
};

}  // namespace armloom::experiments
