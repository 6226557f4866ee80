#pragma once

#include <filesystem>
#include <fstream>
#include <vector>

#include "core/base/problem.h"
#include "core/base/time.h"

namespace armloom {

// While no arm moves, states.csv has the first and the last row, and none between. Which stretches
// these are stands in a file beside it, states_idle.csv: header `from_s,to_s`, one line for each,
// both times as in the rows. So what is left out is told from what is lost.
struct IdleStretch {
  TimePoint from;
  TimePoint to;
  bool operator==(const IdleStretch&) const = default;
};

// "states_idle.csv" for "states.csv".
[[nodiscard]] std::filesystem::path idle_file_of(const std::filesystem::path& states_file);

// Makes the file with the first stretch; one of an earlier recording is removed.
class IdleWriter {
 public:
  explicit IdleWriter(std::filesystem::path file);
  void write(const IdleStretch& stretch);
  [[nodiscard]] bool good() const { return out_.good(); }

 private:
  std::filesystem::path file_;
  std::ofstream out_;
};

// In order of time; none where there is no such file. Problems say "states_idle.csv:LINE".
[[nodiscard]] Result<std::vector<IdleStretch>> read_idle_stretches(
    const std::filesystem::path& file);

}  // namespace armloom
