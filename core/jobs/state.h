#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/jobs/arm_rests.h"
#include "core/jobs/expectation.h"
#include "core/jobs/inputs.h"
#include "core/jobs/job_book.h"
#include "core/jobs/lanes.h"
#include "core/jobs/refused_plans.h"
#include "core/jobs/shared_hold.h"
#include "core/jobs/speed_override.h"
#include "core/model/cell.h"
#include "core/precedence/precedence_graph.h"
#include "core/precedence/prediction.h"

namespace armloom {

struct Policy;

// The jobs of the present round; empty under policies without rounds.
struct Round {
  std::set<JobId> jobs = {};
  bool has_begun = false;  // one of them has moved
};

// The known state of the cell's surroundings.
struct Surroundings {
  std::map<std::string, SignalChanged> signals = {};  // the last of each, by name
  Version scene_since = 0;          // the version since which the scene is unchanged
  RefusedPlans refused_plans = {};  // in this scene
  std::vector<SharedHold> shared_holds = {};
};

// The state that all modules of the scheduler read. Only StateWriter and Transitions write it. A
// copy is independent of the original; Trial works on such a copy.
struct State {
  CellPtr cell;
  std::shared_ptr<const Policy> policy;
  JobBook jobs;
  ArmRests arms;
  SpeedOverride speed;
  Lanes lanes;
  PrecedenceGraph graph;      // all admitted motions, with their orders
  Expectation expected = {};  // of the admitted motions
  Round round = {};
  Surroundings around = {};
  TimePoint now{};  // of the present step

  State(CellPtr description, std::shared_ptr<const Policy> chosen, Configuration rest, JobId first)
      : cell(std::move(description)),
        policy(std::move(chosen)),
        jobs(cell->arms.size(), first),
        arms(*cell, std::move(rest)),
        speed(cell->arms.size()),
        lanes(cell->execution.start_tolerance_rad + Places::kRounding),
        graph(cell->arms.size()) {}

  // Grows when the admitted motions, the arms' rests, the waiting jobs' paths, the scene, the
  // policy or the speed override change. Each owner counts its own changes.
  [[nodiscard]] Version version() const { return 1 + jobs.changes() + arms.changes() + changes_; }

  // Returns the motion clock at `now`.
  [[nodiscard]] TimePoint clock() const { return speed.clock(now); }
  // Returns true if the job has waited for scheduling.aging by the motion clock.
  [[nodiscard]] bool has_aged(const Step& step) const {
    return step.ages_from && clock() - step.ages_from->clock >= cell->scheduling.aging;
  }
  // Returns the cell time that the whole motion is predicted to take.
  [[nodiscard]] Duration time_for(const Trajectory& motion) const {
    return paced(motion.duration(), speed.pace(motion.arms()));
  }

  // Returns true if the job's last check still applies. Precondition: the job is waiting.
  [[nodiscard]] bool is_judged(const Step& step) const {
    const Judgement& found = step.judgement();
    if (found.at != version()) return false;
    return !found.in_turn || (lanes.newest() == found.in_turn->newest &&
                              lanes.goes_before(found.in_turn->after, step.id));
  }

 private:
  friend class StateWriter;
  Version changes_ = 0;  // of the scene, the policy and the speed override
};

// Owns the state and writes what belongs to no job: time, scene, policy, speed override, round,
// arms at rest, orders chosen again. Also collects the effects of the present step. Rules read the
// state through `->`.
class StateWriter {
 public:
  explicit StateWriter(State state) : state_(std::move(state)) {}
  [[nodiscard]] const State* operator->() const { return &state_; }
  operator const State&() const { return state_; }

  // Owners, to be changed by their own transitions. What has consequences for other facts is done
  // by Transitions.
  [[nodiscard]] JobBook& jobs() { return state_.jobs; }
  [[nodiscard]] Lanes& lanes() { return state_.lanes; }
  [[nodiscard]] ArmRests& arms() { return state_.arms; }

  // A step of the scheduler begins. Precondition: `now` does not decrease.
  void begin(TimePoint now) { state_.now = now; }
  void effect(Effect effect) { effects_.push_back(std::move(effect)); }
  // Announces a job that the scheduler has added.
  void announce(const YieldMove& added) { added_.push_back(added); }
  // Returns the jobs whose wait explanation is out of date, once.
  [[nodiscard]] std::set<JobId> take_unexplained() {
    return state_.jobs.updates_.take_unexplained();
  }
  // Returns the effects since the last call. What clients see comes first, so that an event is told
  // before its consequences.
  [[nodiscard]] std::vector<Effect> take_effects();

  void change_scene(std::vector<SharedHold> shared_holds);
  // Keeps what the answer says about paths that do not exist.
  void learn(const PlanQuestion& question, const PlanMade& answer) {
    state_.around.refused_plans.learn(*state_.cell, question, answer);
  }
  // Precondition: no motion is admitted.
  void change_policy(std::shared_ptr<const Policy> policy);
  void set_speed(const SetSpeed& input);
  void set_brake(const SetBrake& input);
  // Makes open answers stale if a job may start now, or may start no longer.
  void set_signal(const SignalChanged& input);
  void set_round(Round round) { state_.round = std::move(round); }
  void locate(const Located& input);
  // Replaces what the choice of orders knows about the admitted motion, and about other work.
  void set_outlook(StepId step, const Outlook& outlook) { state_.graph.set_outlook(step, outlook); }
  void set_work_behind(std::vector<Duration> work) {
    state_.graph.set_work_behind(std::move(work));
  }
  // Takes orders that were chosen again. If none were found, the present orders stay.
  void renew_orders(const PassingOrders& orders);

 protected:
  State state_;

 private:
  std::vector<YieldMove> added_;
  std::vector<Effect> effects_;
};

}  // namespace armloom
