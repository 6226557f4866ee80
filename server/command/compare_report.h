#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/executive/simulation.h"
#include "server/command/headless.h"

namespace armloom {

// One run of the jobs under one policy.
struct ComparedRun {
  std::string policy;
  RunSummary summary;
  RunFigures figures;
  Judging judging;
  bool all_ended = false;
  // Time in motion, as planned, of the arm that has most of it in the jobs that succeeded: no order
  // of these jobs can take less.
  Duration least{};
  Duration wall{};  // of the machine

  // Absent: no job started, or the time limit came first.
  [[nodiscard]] std::optional<Duration> makespan() const;
};

struct Comparison {
  std::string cell;
  std::vector<std::string> arms;
  std::size_t jobs = 0;     // in the file
  std::string busiest;      // the arm that has most to do in the whole file; empty: no jobs
  Duration busiest_work{};  // its time in motion, as planned
  std::uint64_t seed = 1;
  std::vector<ComparedRun> runs;
};

// One table in GitHub's Markdown, its columns aligned, a row for each run. A figure that a run does
// not have is "-". The last two columns are times of the machine, everything else is the same for
// the same seed.
[[nodiscard]] std::string comparison_markdown(const Comparison& comparison);

// The same as RFC 4180 has it, with "\n": first a line of names, units last; a figure that a run
// does not have is empty.
[[nodiscard]] std::string comparison_csv(const Comparison& comparison);

// Bars of the makespans, and the busiest arm's own work as a line, as SVG 1.1 by itself.
[[nodiscard]] std::string comparison_svg(const Comparison& comparison);

}  // namespace armloom
