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

// Writes states.csv: header `time_s,<joint>,...` in the order of the cell's joints, one row per
// control tick in which an arm moves. An idle stretch has only its first and last row
// (idle_stretches.h). Times in seconds, positions in rad or m, rounded to nine decimals. Equal
// motions give equal bytes.
class StatesWriter {
 public:
  StatesWriter(const std::filesystem::path& file, const Cell& cell);
  ~StatesWriter();
  StatesWriter(const StatesWriter&) = delete;
  StatesWriter& operator=(const StatesWriter&) = delete;

  // Call with true if no arm is commanded to move in the following rows; initially false. A row in
  // which a joint is farther than checking.tracking_error from its rest position is written all the
  // same.
  void at_rest(bool at_rest) { at_rest_ = at_rest; }
  // Precondition: |q| < 9e8. Takes about 20 ns per joint.
  void write(TimePoint time, const Configuration& q);
  // Writes all rows so far, for readers of the file. Ends an idle stretch; the next row starts
  // another.
  void catch_up();
  // Flushes buffered rows. Returns true if everything was written.
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
  std::optional<TimePoint> rest_from_;  // time of the first row of the idle stretch
  Configuration rest_q_;
  std::size_t rows_held_ = 0;  // rows since then; only the last of them is written, later
  TimePoint held_at_{};
  Configuration held_q_;
};

// File of a recording for the true positions, in the format of states.csv (Recording).
inline constexpr const char* kTrueStates = "true_states.csv";

// Reads states.csv strictly: a column for each joint of the cell (in any order, no others), finite
// numbers, increasing times. Problems name "states.csv:LINE" and the column. `warnings`, if given,
// gets up to ten sentences: on gaps that are not idle stretches, on motion or missing rows in idle
// stretches, and on a last row without line end (this row is ignored).
[[nodiscard]] Result<std::vector<RecordedState>> read_states(
    const std::filesystem::path& file, const Cell& cell,
    std::vector<std::string>* warnings = nullptr);

// The true states of a recording.
struct TrueStates {
  std::vector<RecordedState> states;
  // The states are measured before this time, and true from then on; nullopt if all are measured.
  std::optional<TimePoint> true_from;
};
// Reads true_states.csv, and states.csv for the time before. Problems and warnings: those of
// read_states().
[[nodiscard]] Result<TrueStates> read_true_states(const std::filesystem::path& folder,
                                                  const Cell& cell,
                                                  std::vector<std::string>* warnings = nullptr);

}  // namespace armloom
