#pragma once

#include <functional>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "test/scheduler/bench_cell.h"
#include "test/scheduler/crossings.h"

namespace armloom {

// How an arm carries out one motion: exactly as far as its authority, but in its own time.
struct Habits {
  Duration starts_late{};
  double speed = 1.0;  // of trajectory time
  Duration stalls_at{};
  Duration stalls_for{};
  Duration feedback_age{};  // of what it reports
  Duration brakes_for{};    // after Brake it goes on for so long, at most to its authority
};

// A Scheduler with arms that do what it tells them, and answers from a table of crossings: from one
// event to the next, by a clock of its own. A plan is the straight way to its goal (a link target's
// x is the joint's place), or none. After every step it claims what has to hold then:
//
//   Every arm may be anywhere from where it was measured to its authority, at the same time as
//   every other, and no two meet (but under timed_discrete, which promises nothing).
//   Motions of an arm begin one after the other in order of submission, where the arm stands, never
//   before those that they come after, and never on a stopped arm. Authority never shrinks, nor
//   grows while the arm brakes. What moves belongs to a job that has not ended.
//   What was measured is not beyond where the arm is, nor that beyond its authority, nor that
//   beyond its end. What moves, brakes or stands on its path is in the state that says so, and in
//   no other. What stands says what it waits for; admitted jobs that do wait in no ring.
class IdealArms : public Bench {
 public:
  using HabitsOf = std::function<Habits(JobId)>;
  IdealArms(const CellPtr& description, std::unique_ptr<const Policy> policy, Crossings table,
            HabitsOf habits_of, std::uint64_t seed = 1);

  // Does what comes next, if that is not after `until`: else false, and it is `until`.
  bool go_on(TimePoint until);
  void run_until(TimePoint until) {
    while (go_on(until)) {
    }
  }
  // Until nothing will happen without input. Fails after so many events: that is a livelock.
  void run(std::size_t events_max = 200'000);

  void input(const Input& input) { take(input); }
  // Answers the open question in this instant; false: there is none.
  bool answer_now();
  JobId submit(Submit submitted);
  [[nodiscard]] TimePoint now() const { return now_; }
  [[nodiscard]] double stands_at(ArmId arm) const { return q_[arm.index()]; }
  [[nodiscard]] Duration progress(JobId moving) const;  // as it truly is
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
    TimePoint moves_from;  // starts late, or stalls until then
    TimePoint moved_at;    // last
    TimePoint report_at;
    bool has_stalled = false;
    bool seen_to_stand = false;  // its last report was no farther than the one before
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
  void check_phase(const Job& job) const;
  void check_orders() const;
  void check_authority() const;
  void check_explained() const;
  [[nodiscard]] Moving* find_moving(JobId job);
  [[nodiscard]] std::pair<Stretch, JobId> stretch_of(ArmId arm) const;

  HabitsOf habits_of_;
  std::mt19937_64 random_;
  TimePoint now_{};
  std::vector<double> q_;  // per arm: where it rests, or did before its motion
  std::vector<Moving> moving_;
  TimePoint answer_at_ = kNever;
  std::vector<OpenPlan> plans_;
  std::map<JobId, std::vector<JobId>> after_;
  std::map<ArmId, std::vector<JobId>> of_arm_;  // of clients, in an order that has to be kept
  std::map<JobId, std::size_t> times_dispatched_, times_released_;
};

}  // namespace armloom
