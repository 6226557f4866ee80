#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/executive/simulation.h"
#include "server/command/headless.h"

namespace armloom {

// A simulation of the jobs under one policy.
struct ComparedRun {
  std::string policy;
  RunSummary summary;
  RunFigures figures;
  Judging judging;
  bool all_ended = false;
  // Planned time in motion of the busiest arm in the jobs that succeeded: a lower bound of the
  // makespan of these jobs.
  Duration least{};
  Duration wall{};  // wall time

  // Returns nullopt if no job started, or if the time limit was reached.
  [[nodiscard]] std::optional<Duration> makespan() const;
};

struct Comparison {
  std::string cell;
  std::vector<std::string> arms;
  std::size_t jobs = 0;  // in the file
  std::string busiest;   // arm with the most planned motion in the whole file; empty without jobs
  Duration busiest_work{};  // planned time in motion of `busiest`
  std::uint64_t seed = 1;
  std::vector<ComparedRun> runs;
};

// Returns an aligned Markdown table with a row per policy; "-" for missing values. Everything but
// the last two columns, which are machine times, depends only on the seed.
[[nodiscard]] std::string comparison_markdown(const Comparison& comparison);

// Returns the table as CSV (RFC 4180, with "\n"). The first line has the column names, units last;
// missing values are empty.
[[nodiscard]] std::string comparison_csv(const Comparison& comparison);

// Returns an SVG 1.1 picture: a bar for each makespan, and a line at the busiest arm's own work.
[[nodiscard]] std::string comparison_svg(const Comparison& comparison);

}  // namespace armloom
