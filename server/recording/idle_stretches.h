#pragma once

#include <filesystem>
#include <fstream>
#include <vector>

#include "core/base/problem.h"
#include "core/base/time.h"

namespace armloom {

// A time in which no arm moves. states.csv contains only the first and the last row of the stretch.
// states_idle.csv lists the times of these two rows (header `from_s,to_s`), so that a reader can
// tell omitted rows from lost rows.
struct IdleStretch {
  TimePoint from;
  TimePoint to;
  bool operator==(const IdleStretch&) const = default;
};

// Returns "states_idle.csv" for "states.csv".
[[nodiscard]] std::filesystem::path idle_file_of(const std::filesystem::path& states_file);

// Writes states_idle.csv. The constructor removes the file of an earlier recording; the first
// stretch creates the new file.
class IdleWriter {
 public:
  explicit IdleWriter(std::filesystem::path file);
  void write(const IdleStretch& stretch);
  [[nodiscard]] bool good() const { return out_.good(); }

 private:
  std::filesystem::path file_;
  std::ofstream out_;
};

// Returns the stretches in order of time, or an empty list if the file is missing. Problems name
// "states_idle.csv:LINE".
[[nodiscard]] Result<std::vector<IdleStretch>> read_idle_stretches(
    const std::filesystem::path& file);

}  // namespace armloom
