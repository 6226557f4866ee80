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

// Body of POST /comparison.
struct ComparisonInquiry {
  std::vector<std::string> policies = {};  // all if empty
  std::optional<TimePoint> since = {};     // first submission time; all jobs if nullopt
  std::uint64_t seed = 1;
};
[[nodiscard]] FormatPtr<ComparisonInquiry> comparison_inquiry_format();
// Reads the body. Problems: a malformed body; a policy that is listed twice.
[[nodiscard]] Result<ComparisonInquiry> read_comparison_inquiry(std::string_view text);

struct PolicyRun {
  std::string policy;
  std::uint64_t succeeded = 0;
  std::uint64_t expired = 0;
  std::uint64_t failed = 0;
  std::uint64_t canceled = 0;                 // by the server, interrupted jobs included
  std::uint64_t refused = 0;                  // job would not begin where its arm would be
  std::uint64_t unfinished = 0;               // not ended when the simulation stopped
  std::uint64_t backlogged = 0;               // waited in the backlog at least once
  std::optional<Duration> makespan = {};      // nullopt if a job did not end or none started
  std::optional<double> makespan_ratio = {};  // divided by the makespan of `sequential`
  Duration wait_mean{};                       // mean time from submission to start
  Duration wait_max{};
  std::optional<double> min_clearance_m = {};  // nullopt if no pair came close
  std::uint64_t monitor_stops = 0;
  std::uint64_t evaluations = 0;
  bool given_up = false;  // exceeded the limit of evaluations
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

// Answer to POST and GET /comparison.
struct ComparisonView {
  ComparisonState state = ComparisonState::running;
  std::uint64_t jobs = 0;
  TimePoint first{};  // submission, cell time
  TimePoint last{};
  std::string in_force;               // policy at the time of the request
  std::vector<std::string> policies;  // in the order of the runs
  std::vector<PolicyRun> runs = {};   // of the finished simulations
  std::string detail = {};            // reason of a failure
};
[[nodiscard]] FormatPtr<ComparisonView> comparison_format();

}  // namespace armloom
