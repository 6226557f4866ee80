#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/executive/simulation.h"
#include "server/command/headless.h"

namespace armloom {

struct ComparedRun {
  std::string policy;
  RunSummary summary;
  RunFigures figures;
  Judging judging;
  bool all_ended = false;
  // Planned time in motion of the busiest arm, counting jobs that succeeded. It is a lower bound of
  // the makespan.
  Duration least{};
  Duration wall{};  // wall time

  // Returns nullopt if a job did not end, or if no job started.
  [[nodiscard]] std::optional<Duration> makespan() const;
};

struct Comparison {
  std::string cell;
  std::vector<std::string> arms;
  std::size_t jobs = 0;  // number of jobs in the file
  std::string busiest;   // arm with the most planned motion; "" without jobs
  Duration busiest_work{};
  std::uint64_t seed = 1;
  std::vector<ComparedRun> runs;
};

// Returns an aligned Markdown table with a row for each policy. The last two columns are times of
// the machine; all others depend only on the seed.
[[nodiscard]] std::string comparison_markdown(const Comparison& comparison);

// Returns CSV as in RFC 4180, but with "\n". Units are at the end of column names; missing values
// are empty.
[[nodiscard]] std::string comparison_csv(const Comparison& comparison);

// Returns an SVG with a bar for each makespan and a line at the busiest arm's work.
[[nodiscard]] std::string comparison_svg(const Comparison& comparison);

}  // namespace armloom
