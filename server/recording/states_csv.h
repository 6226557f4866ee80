#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/audit/audit.h"
#include "core/base/problem.h"
#include "core/base/time.h"
#include "core/model/cell.h"

namespace armloom {

// states.csv: header `time_s,<joint>,...` in the order of the cell's joints, one row per control
// tick. Times in seconds, positions in rad or m with nine decimals: half a nanometre or nanoradian
// of rounding, and the same bytes for the same run.
class StatesWriter {
 public:
  StatesWriter(const std::filesystem::path& file, const Cell& cell);
  ~StatesWriter();
  StatesWriter(const StatesWriter&) = delete;
  StatesWriter& operator=(const StatesWriter&) = delete;

  // Precondition: |q| < 9e8. About 20 ns for each joint.
  void write(TimePoint time, const Configuration& q);
  [[nodiscard]] bool good() const { return out_.good(); }

 private:
  void flush();
  std::ofstream out_;
  std::string buffer_;
};

// Reads such a file strictly: every joint of the cell has its column (in any order, no others),
// every field is a finite number, times increase. Problems say "states.csv:LINE" and the column.
// `doubts`, if given, gets a sentence for each hole in the times and for a last row that may be cut
// off (the first ten): what can be read, but need not be all that happened.
[[nodiscard]] Result<std::vector<RecordedState>> read_states(
    const std::filesystem::path& file, const Cell& cell,
    std::vector<std::string>* doubts = nullptr);

}  // namespace armloom
