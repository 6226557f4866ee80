#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "core/audit/audit.h"
#include "core/base/problem.h"
#include "core/base/time.h"
#include "core/model/cell.h"
#include "server/recording/idle_stretches.h"

namespace armloom {

// states.csv: header `time_s,<joint>,...` in the order of the cell's joints, one row per control
// tick in which an arm moves; of a stretch in which none does, the first and the last one (see
// idle_stretches.h). Times in seconds, positions in rad or m with nine decimals: half a nanometre
// or nanoradian of rounding, and the same bytes for the same run.
class StatesWriter {
 public:
  StatesWriter(const std::filesystem::path& file, const Cell& cell);
  ~StatesWriter();
  StatesWriter(const StatesWriter&) = delete;
  StatesWriter& operator=(const StatesWriter&) = delete;

  // Of the rows from now on: no arm is commanded to move, or one is (so it begins). A row in which
  // a joint is farther from where it came to rest than checking.tracking_error is written though.
  void at_rest(bool at_rest) { at_rest_ = at_rest; }
  // Precondition: |q| < 9e8. About 20 ns for each joint.
  void write(TimePoint time, const Configuration& q);
  // Brings the file up to the last row that came, for who reads it meanwhile: a stretch of rest is
  // ended by it, and begins anew with the next row.
  void catch_up();
  // Writes what is held back. Whether all has been written.
  bool close();
  [[nodiscard]] bool good() const { return out_.good() && idle_.good(); }

 private:
  void end_rest();
  void append(TimePoint time, const Configuration& q);
  void flush();
  std::ofstream out_;
  std::string buffer_;
  IdleWriter idle_;
  double tolerance_;
  bool at_rest_ = false;
  std::optional<TimePoint> rest_from_;  // of the present stretch: its first row
  Configuration rest_q_;
  std::size_t rows_held_ = 0;  // since then, of which the last one is to be written
  TimePoint held_at_{};
  Configuration held_q_;
};

// Reads such a file strictly: every joint of the cell has its column (in any order, no others),
// every field is a finite number, times increase. Problems say "states.csv:LINE" and the column.
// `warnings`, if given, gets a sentence for each hole in the times that is no rest, and for a last
// row without an end of line, which is left out (the first ten): what can be read, but need not be
// all that happened.
[[nodiscard]] Result<std::vector<RecordedState>> read_states(
    const std::filesystem::path& file, const Cell& cell,
    std::vector<std::string>* warnings = nullptr);

}  // namespace armloom
