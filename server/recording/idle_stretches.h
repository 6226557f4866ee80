#pragma once

#include <filesystem>
#include <fstream>
#include <vector>

#include "core/base/problem.h"
#include "core/base/time.h"

namespace armloom {

// A time in which no arm moves: states.csv has its first and last row only. states_idle.csv lists
// these times (header `from_s,to_s`, times as in the rows), to tell omitted rows from lost rows.
struct IdleStretch {
  TimePoint from;
  TimePoint to;
  bool operator==(const IdleStretch&) const = default;
};

// Returns "states_idle.csv" for "states.csv".
[[nodiscard]] std::filesystem::path idle_file_of(const std::filesystem::path& states_file);

// Creates the file with the first stretch. Removes a file of an earlier recording.
class IdleWriter {
 public:
  explicit IdleWriter(std::filesystem::path file);
  void write(const IdleStretch& stretch);
  [[nodiscard]] bool good() const { return out_.good(); }

 private:
  std::filesystem::path file_;
  std::ofstream out_;
};

// Returns the stretches in order of time, none if the file is missing. Problems name
// "states_idle.csv:LINE".
[[nodiscard]] Result<std::vector<IdleStretch>> read_idle_stretches(
    const std::filesystem::path& file);

}  // namespace armloom
