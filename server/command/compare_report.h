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
  // Planned motion of the busiest arm in succeeded jobs: a lower bound of the makespan.
  Duration least{};
  Duration wall{};  // wall time

  // Returns nullopt if no job started or the time limit was reached.
  [[nodiscard]] std::optional<Duration> makespan() const;
};

struct Comparison {
  std::string cell;
  std::vector<std::string> arms;
  std::size_t jobs = 0;  // in the file
  std::string busiest;   // arm with the most planned motion; "" without jobs
  Duration busiest_work{};
  std::uint64_t seed = 1;
  std::vector<ComparedRun> runs;
};

// Returns an aligned Markdown table, a row per policy. All but the last two columns, which are
// machine times, depend only on the seed.
[[nodiscard]] std::string comparison_markdown(const Comparison& comparison);

// Returns CSV as in RFC 4180, but with "\n". Units are at the end of column names; missing values
// are empty.
[[nodiscard]] std::string comparison_csv(const Comparison& comparison);

// Returns an SVG with a bar for each makespan and a line at the busiest arm's work.
[[nodiscard]] std::string comparison_svg(const Comparison& comparison);

}  // namespace armloom
