#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/problem.h"
#include "core/base/time.h"
#include "server/codec/format.h"

namespace armloom {

// The body of POST /comparison.
struct ComparisonInquiry {
  std::vector<std::string> policies = {};  // none: all
  std::optional<TimePoint> since = {};     // jobs that were submitted from then on; absent: all
  std::uint64_t seed = 1;
};
[[nodiscard]] FormatPtr<ComparisonInquiry> comparison_inquiry_format();
// Problems: those of the shape; a policy that is named twice.
[[nodiscard]] Result<ComparisonInquiry> read_comparison_inquiry(std::string_view text);

// What became of the jobs under one policy, in simulation.
struct PolicyRun {
  std::string policy;
  std::uint64_t succeeded = 0;
  std::uint64_t expired = 0;
  std::uint64_t failed = 0;
  std::uint64_t canceled = 0;    // by the server: interrupted ones, too
  std::uint64_t refused = 0;     // at their time: they did not begin where their arm would stand
  std::uint64_t unfinished = 0;  // when nothing could happen any more, or the run was given up
  std::uint64_t backlogged = 0;  // waited in the backlog, at least once
  std::optional<Duration> makespan = {};      // absent: not all ended, or none started
  std::optional<double> makespan_ratio = {};  // makespan, of that of `sequential`
  Duration wait_mean{};                       // from submission to start
  Duration wait_max{};
  std::optional<double> min_clearance_m = {};  // absent: never near
  std::uint64_t monitor_stops = 0;
  std::uint64_t evaluations = 0;
  bool given_up = false;  // it took more evaluations than one run may
};

enum class ComparisonState { running, done, canceled, failed };
[[nodiscard]] constexpr const char* to_string(ComparisonState state) {
  switch (state) {
    case ComparisonState::running:
      return "running";
    case ComparisonState::done:
      return "done";
    case ComparisonState::canceled:
      return "canceled";
    case ComparisonState::failed:
      return "failed";
  }
  return nullptr;
}

// The answer to POST and GET /comparison.
struct ComparisonView {
  ComparisonState state = ComparisonState::running;
  std::uint64_t jobs = 0;
  TimePoint first{};  // submission, in the cell's time
  TimePoint last{};
  std::string in_force;               // the policy, when it was asked for
  std::vector<std::string> policies;  // in the order of the runs
  std::vector<PolicyRun> runs = {};   // that are done
  std::string detail = {};            // why it failed
};
[[nodiscard]] FormatPtr<ComparisonView> comparison_format();

}  // namespace armloom
