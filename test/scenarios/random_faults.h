#pragma once

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "core/executive/simulation.h"

namespace armloom {

// Random numbers that depend on the seed only.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  // Returns an index from 0 to count - 1.
  std::size_t index(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(engine_);
  }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }

 private:
  std::mt19937_64 engine_;
};

// Upper bounds of random delays. Feedback freezes repeatedly, each time for up to old_s.
struct Delays {
  double late_s = 2.0;
  double slowest = 0.3;
  double stall_s = 3.0;
  double old_s = 0.0;
};
inline constexpr Delays kFarBeyond{.late_s = 10.0, .slowest = 0.1, .stall_s = 30.0, .old_s = 0.1};

// Lets the arm start late, run slowly, and stall three times within `within_s`.
inline void delay_at_random(Executive& executive, const std::string& arm, double within_s,
                            Random& random, const Delays& delays = {}) {
  const auto inject = [&](FaultRequest fault) { EXPECT_TRUE(executive.faults().inject(fault)); };
  inject({.arm = arm,
          .kind = ArmFault::Kind::late_start,
          .value = random.uniform(0.0, delays.late_s)});
  inject({.arm = arm, .kind = ArmFault::Kind::slow, .value = random.uniform(delays.slowest, 1.0)});
  for (int stall = 0; stall < 3; ++stall) {
    const Duration from = from_seconds(random.uniform(0.0, within_s));
    const Duration lasting = from_seconds(random.uniform(0.1, delays.stall_s));
    inject({.arm = arm, .kind = ArmFault::Kind::stall, .at = at(from), .lasting = lasting});
  }
  for (double from_s = 0.0; delays.old_s > 0.0 && from_s < 4 * within_s;) {
    from_s += random.uniform(0.1, 1.0);
    const Duration lasting = from_seconds(random.uniform(0.0, delays.old_s));
    inject({.arm = arm,
            .kind = ArmFault::Kind::drop_feedback,
            .at = at(from_seconds(from_s)),
            .lasting = lasting});
    from_s += delays.old_s;
  }
}

// Returns one line: how the job ended and what it waited for last.
inline std::string told(const JobView& job) {
  std::string line = job.key + " of " + job.arms.front() + " " + to_string(job.state) + " (" +
                     (job.reason() ? to_string(*job.reason()) : "-") + ") " + job.detail();
  for (const WaitView& wait : job.waits_on) {
    line += std::string("; waits on ") + to_string(wait.kind) + " " + wait.job + " " + wait.arm;
    if (wait.own_time_s) line += " at " + std::to_string(*wait.own_time_s);
    if (wait.other_time_s) line += " / " + std::to_string(*wait.other_time_s);
    if (!wait.detail.empty()) line += " [" + wait.detail + "]";
  }
  for (const std::string& key : job.cycle)
    line += (&key == &job.cycle.front() ? "; cycle " : " ") + key;
  return line;
}

// Result of a random workload.
struct DelayedRun {
  std::size_t jobs = 0;
  std::size_t succeeded = 0;
  bool all_ended = false;
  std::uint64_t monitor_stops = 0;
  std::string first_other;  // the first job that did not succeed

  void read(const Executive& executive, const std::vector<std::string>& keys) {
    jobs = keys.size();
    all_ended = executive.all_ended();
    monitor_stops = executive.figures().monitor_stops;
    for (const std::string& key : keys) {
      const JobView job = *executive.job(key);
      if (job.state == JobState::succeeded) {
        ++succeeded;
      } else if (first_other.empty()) {
        first_other = told(job);
      }
    }
  }
};

}  // namespace armloom
