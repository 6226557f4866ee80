#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "core/arm/arm_controller.h"
#include "core/executive/executive.h"

namespace armloom {

// A judgement takes this much simulated time, whatever it took the machine.
inline constexpr Duration kSimulatedJudgement = std::chrono::milliseconds(2);

// And a plan this much.
inline constexpr Duration kSimulatedPlanning = std::chrono::milliseconds(20);

// What deciding took: how often a question was judged, the combined states looked at for it, and
// the time of the machine. `wall` alone differs from run to run.
struct Judging {
  std::uint64_t judgements = 0;
  std::uint64_t evaluations = 0;
  Duration wall{};
};
// The same of planning: ways that were asked for, and the evaluations that each of them took.
struct Planning {
  std::uint64_t plans = 0;
  std::uint64_t evaluations = 0;
  Duration wall{};
};

// The same executive as in real time, on simulated time: the caller turns the clock. Deterministic
// for a seed. Single-threaded.
class Simulation {
 public:
  // Problems: as Executive::create. The observer outlives the simulation.
  [[nodiscard]] static Result<std::unique_ptr<Simulation>> create(CellPtr cell,
                                                                  ExecutiveOptions options,
                                                                  Observer& observer);
  ~Simulation();

  [[nodiscard]] Executive& executive() { return *executive_; }
  [[nodiscard]] TimePoint now() const { return executive_->now(); }
  [[nodiscard]] const Judging& judging() const;
  [[nodiscard]] const Planning& planning() const;

  // Nothing happens any more unless somebody asks for it.
  [[nodiscard]] bool settled() const;

  // One control cycle; the first one is at time zero.
  void tick();
  // Where nothing would happen in them, leaves out all cycles before `until`: the next one is the
  // first that is not before it, or before what happens sooner.
  void pass_over_rest(TimePoint until);
  // Cycles up to and with `time`.
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

// What a cell is put through.
struct Scenario {
  std::vector<TimedJob> jobs;
  TimePoint time_limit;
  std::vector<FaultRequest> faults = {};
  // Asked before each control cycle, with what deciding has taken so far: whether to end the run
  // there. Null: nobody asks.
  std::function<bool(const Judging&, const Planning&)> gives_up = {};
};

struct SimulationResult {
  RunFigures figures;
  Judging judging;
  Planning planning;
  std::vector<JobView> jobs;  // every job that was accepted, as it ended, in order of submission
  struct Refused {
    std::size_t index;  // into the jobs given
    Problems problems;
  };
  std::vector<Refused> refused;  // at their time
  bool all_ended = false;        // false: nothing could happen any more, or `time_limit` came first
  bool settled = false;          // false: `time_limit` came first, if not all have ended
  bool given_up = false;         // as the scenario's gives_up() said
  TimePoint ended_at{};
  Duration wall{};  // what it took the machine: differs from run to run
};

// Submits the jobs at their times and runs until all have ended, until nothing can happen any more
// (arms that are stopped, with nobody to resume them), or until the time limit. Problems: as
// create(); a fault of an unknown arm.
[[nodiscard]] Result<SimulationResult> simulate(CellPtr cell, ExecutiveOptions options,
                                                Scenario scenario, Observer& observer);

}  // namespace armloom
