#include <algorithm>
#include <limits>
#include <queue>

#include "test/experiments/lower_bound.h"

namespace armloom::experiments {
namespace {

constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();

// A maximum matching of compatible rows and columns (Hopcroft and Karp 1973).
class Matching {
 public:
  explicit Matching(const ConflictTable& table)
      : table_(table),
        of_row_(table.rows, kNobody),
        of_column_(table.columns, kNobody),
        layer_(table.rows) {
    while (layers()) {
      next_.assign(table_.rows, 0);
      for (std::size_t a = 0; a < table_.rows; ++a) {
        if (of_row_[a] == kNobody) augment(a);
      }
    }
  }

  // Returns the rows that alternating paths from unmatched rows reach, and the columns that they do
  // not reach. By Koenig's theorem they are a largest independent set.
  [[nodiscard]] ChosenMoments independent() const {
    ChosenMoments chosen{std::vector<char>(table_.rows, 0), std::vector<char>(table_.columns, 1)};
    std::vector<std::size_t> open;
    for (std::size_t a = 0; a < table_.rows; ++a) {
      if (of_row_[a] != kNobody) continue;
      chosen.rows[a] = 1;
      open.push_back(a);
    }
    while (!open.empty()) {
      const std::size_t a = open.back();
      open.pop_back();
      for (std::size_t b = 0; b < table_.columns; ++b) {
        if (!free(a, b) || chosen.columns[b] == 0) continue;
        chosen.columns[b] = 0;
        const std::size_t row = of_column_[b];  // matched, because the matching is maximum
        if (chosen.rows[row] != 0) continue;
        chosen.rows[row] = 1;
        open.push_back(row);
      }
    }
    return chosen;
  }

 private:
  [[nodiscard]] bool free(std::size_t a, std::size_t b) const {
    return table_.conflict[a * table_.columns + b] == 0;
  }

  // Returns false if no unmatched column is reachable from unmatched rows.
  bool layers() {
    std::fill(layer_.begin(), layer_.end(), kNobody);
    std::queue<std::size_t> open;
    for (std::size_t a = 0; a < table_.rows; ++a) {
      if (of_row_[a] != kNobody) continue;
      layer_[a] = 0;
      open.push(a);
    }
    bool reached = false;
    while (!open.empty()) {
      const std::size_t a = open.front();
      open.pop();
      for (std::size_t b = 0; b < table_.columns; ++b) {
        if (!free(a, b)) continue;
        const std::size_t row = of_column_[b];
        if (row == kNobody) {
          reached = true;
        } else if (layer_[row] == kNobody) {
          layer_[row] = layer_[a] + 1;
          open.push(row);
        }
      }
    }
    return reached;
  }

  // Depth-first without recursion, because paths may be long.
  void augment(std::size_t root) {
    std::vector<std::size_t> rows = {root};
    while (!rows.empty()) {
      const std::size_t a = rows.back();
      if (next_[a] == table_.columns) {
        layer_[a] = kNobody;
        rows.pop_back();
        if (!rows.empty()) ++next_[rows.back()];
        continue;
      }
      const std::size_t b = next_[a];
      if (free(a, b)) {
        const std::size_t row = of_column_[b];
        if (row == kNobody) {
          for (const std::size_t on_way : rows) {
            of_row_[on_way] = next_[on_way];
            of_column_[next_[on_way]] = on_way;
          }
          return;
        }
        if (layer_[row] != kNobody && layer_[row] == layer_[a] + 1) {
          rows.push_back(row);
          continue;
        }
      }
      ++next_[a];
    }
  }

  const ConflictTable& table_;
  std::vector<std::size_t> of_row_;
  std::vector<std::size_t> of_column_;
  std::vector<std::size_t> layer_;
  std::vector<std::size_t> next_;  // next column that a row tries
};

}  // namespace

ChosenMoments largest_exclusion(const ConflictTable& table) {
  return Matching(table).independent();
}

std::vector<char> exclusion_of_all(const std::vector<char>& free, std::size_t n) {
  std::vector<char> chosen(n, 1);
  std::vector<std::size_t> degree(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    degree[i] = static_cast<std::size_t>(
        std::count(free.begin() + static_cast<std::ptrdiff_t>(i * n),
                   free.begin() + static_cast<std::ptrdiff_t>((i + 1) * n), char{1}));
  }
  while (true) {
    const std::size_t worst =
        static_cast<std::size_t>(std::ranges::max_element(degree) - degree.begin());
    if (n == 0 || degree[worst] == 0) return chosen;
    chosen[worst] = 0;
    degree[worst] = 0;
    for (std::size_t j = 0; j < n; ++j) {
      if (free[worst * n + j] != 0 && chosen[j] != 0) --degree[j];
    }
  }
}

std::size_t steps_chosen(const std::vector<char>& chosen, const std::vector<std::size_t>& motion) {
  std::size_t steps = 0;
  for (std::size_t i = 1; i < chosen.size(); ++i) {
    if (chosen[i] != 0 && chosen[i - 1] != 0 && motion[i] == motion[i - 1]) ++steps;
  }
  return steps;
}

}  // namespace armloom::experiments
