#pragma once

#include <functional>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "test/scheduler/bench_cell.h"
#include "test/scheduler/crossings.h"

namespace armloom {

// An arm executes a motion exactly to its authority, but with its own timing.
struct Habits {
  Duration starts_late{};
  double speed = 1.0;  // of trajectory time
  Duration stalls_at{};
  Duration stalls_for{};
  Duration feedback_age{};  // age of reported progress
  Duration brakes_for{};    // how long it continues after Brake, at most to its authority
};

// Runs a Scheduler on its own clock, with arms that obey it. Its questions are answered from a
// table of crossings. Plans are straight paths to the goal (a link target's x is the joint's
// position), or no path exists. Checks after every step:
// - Arms anywhere between measured position and authority do not meet (except under
//   timed_discrete).
// - Motions of an arm start in order of submission, at the arm's position, after their
//   predecessors, and never on a stopped arm.
// - Authority never shrinks, and does not grow while the arm brakes.
// - Measured progress <= actual progress <= authority <= duration.
// - Job states match whether their arms move, brake or pause.
// - A job at rest reports what it waits for. Admitted jobs form no cycle.
class IdealArms : public Bench {
 public:
  using HabitsOf = std::function<Habits(JobId)>;
  IdealArms(const CellPtr& description, std::unique_ptr<const Policy> policy, Crossings table,
            HabitsOf habits_of, std::uint64_t seed = 1);

  // Processes the next event unless it is after `until`; then advances to `until` and returns
  // false.
  bool go_on(TimePoint until);
  void run_until(TimePoint until) {
    while (go_on(until)) {
    }
  }
  // Runs until nothing happens without input; more than `events_max` events are a livelock.
  void run(std::size_t events_max = 200'000);

  void input(const Input& input) { take(input); }
  // Returns false if there is no open question.
  bool answer_now();
  JobId submit(Submit submitted);
  [[nodiscard]] TimePoint now() const { return now_; }
  [[nodiscard]] double stands_at(ArmId arm) const { return q_[arm.index()]; }
  [[nodiscard]] Duration progress(JobId moving) const;  // the actual progress
  [[nodiscard]] bool moves(JobId job) const;
  [[nodiscard]] std::size_t moving() const { return moving_.size(); }
  [[nodiscard]] std::size_t times_released(JobId job) const;
  [[nodiscard]] std::size_t times_dispatched(JobId job) const;

  Crossings crossings;

 private:
  struct OpenPlan {
    PlanMotion asked;
    TimePoint answer_at;
  };
  struct Moving {
    JobId job;
    TrajectoryPtr motion;
    Habits habits;
    Duration s, reported, authority;
    TimePoint moves_from;  // starts late, or stalls until this time
    TimePoint moved_at;    // time of the last advance
    TimePoint report_at;
    bool has_stalled = false;
    bool seen_to_stand = false;  // its last report showed no progress
    bool braking = false;
    Duration rests_at{};
  };
  static constexpr TimePoint kNever = TimePoint::max();

  void heard(const Effect& effect) override;
  void on(const Dispatch& dispatch);
  void on(const Grant& grant);
  void on(const Brake& brake);
  void on(const PlanMotion& plan);
  [[nodiscard]] PlanMade answer_to(const PlanMotion& asked) const;
  bool answer_plan_now();
  void take(const Input& input);
  void advance(Moving& arm, TimePoint to) const;
  void plan_report(Moving& arm);
  void report(std::size_t index);
  void come_to_rest(const Moving& arm, MotionReport::Kind kind);
  void check();
  void check_moving(const Moving& arm) const;
  void check_phase(const Step& step) const;
  void check_orders() const;
  void check_authority() const;
  void check_explained() const;
  [[nodiscard]] Moving* find_moving(JobId job);
  [[nodiscard]] std::pair<Stretch, JobId> stretch_of(ArmId arm) const;

  HabitsOf habits_of_;
  std::mt19937_64 random_;
  TimePoint now_{};
  std::vector<double> q_;  // per arm: where it rests, or rested before its motion
  std::vector<Moving> moving_;
  TimePoint answer_at_ = kNever;
  std::vector<OpenPlan> plans_;
  std::map<JobId, std::vector<JobId>> after_;
  std::map<ArmId, std::vector<JobId>> of_arm_;  // jobs of clients, in an order that must be kept
  std::map<JobId, std::size_t> times_dispatched_, times_released_;
};

}  // namespace armloom
