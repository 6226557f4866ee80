#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "core/arm/arm_controller.h"
#include "core/executive/executive.h"

namespace armloom {

// Durations of a check and of a plan in simulated time, however long they really take.
inline constexpr Duration kSimulatedJudgement = std::chrono::milliseconds(2);

inline constexpr Duration kSimulatedPlanning = std::chrono::milliseconds(20);

// The cost of all checks. Only `wall` (real time) differs between equal runs.
struct Judging {
  std::uint64_t judgements = 0;
  std::uint64_t evaluations = 0;
  Duration wall{};
};
struct Planning {
  std::uint64_t plans = 0;
  std::uint64_t evaluations = 0;
  Duration wall{};
};

// Runs the executive on simulated time, cycle by cycle as the caller requests. Deterministic for a
// seed. Single-threaded.
class Simulation {
 public:
  // Problems: those of Executive::create. `observer` outlives the simulation.
  [[nodiscard]] static Result<std::unique_ptr<Simulation>> create(CellPtr cell,
                                                                  ExecutiveOptions options,
                                                                  Observer& observer);
  ~Simulation();

  [[nodiscard]] Executive& executive() { return *executive_; }
  [[nodiscard]] TimePoint now() const { return executive_->now(); }
  [[nodiscard]] const Judging& judging() const;
  [[nodiscard]] const Planning& planning() const;

  // Returns true if nothing will happen without a further command.
  [[nodiscard]] bool settled() const;

  // Runs one control cycle; the first is at time zero.
  void tick();
  // Skips cycles in which nothing would happen, at most up to `until`.
  void pass_over_rest(TimePoint until);
  void run_until(TimePoint time);

 private:
  class Judge;
  explicit Simulation(std::unique_ptr<Judge> judge);

  std::unique_ptr<Judge> judge_;
  std::unique_ptr<Executive> executive_;
  TimePoint next_{};
};

struct TimedJob {
  TimePoint at;  // when it is submitted
  JobRequest job;
};

struct Scenario {
  std::vector<TimedJob> jobs;
  TimePoint time_limit;
  std::vector<FaultRequest> faults = {};
  // Called before each control cycle with the cost so far; returns true to end the run. May be
  // null.
  std::function<bool(const Judging&, const Planning&)> gives_up = {};
};

struct SimulationResult {
  RunFigures figures;
  Judging judging;
  Planning planning;
  std::vector<JobView> jobs;  // all accepted jobs in their final state, in order of submission
  struct Refused {
    std::size_t index;
    Problems problems;
  };
  std::vector<Refused> refused;
  bool all_ended = false;  // if false, the run was blocked, reached `time_limit` or was given up
  bool settled = false;    // nothing can happen any more
  bool given_up = false;
  TimePoint ended_at{};
  Duration wall{};  // real time; differs between equal runs
};

// Submits the jobs at their times. Runs until all have ended, until nothing can happen any more
// (for example, because no operator resumes stopped arms), or until the time limit. Problems: those
// of Executive::create; a fault of an unknown arm.
[[nodiscard]] Result<SimulationResult> simulate(CellPtr cell, ExecutiveOptions options,
                                                Scenario scenario, Observer& observer);

}  // namespace armloom
