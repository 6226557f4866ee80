#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/jobs/inputs.h"
#include "core/jobs/state.h"

namespace armloom {

// Owns the state and writes what belongs to no job: time, scene, policy, speed override, round,
// arms at rest, orders chosen again. Also collects the effects of the present step. Rules read the
// state through `->`.
class StateWriter {
 public:
  explicit StateWriter(State state) : state_(std::move(state)) {}
  [[nodiscard]] const State* operator->() const { return &state_; }
  operator const State&() const { return state_; }

  // Owners whose transitions have no consequences elsewhere.
  [[nodiscard]] JobBook& jobs() { return state_.jobs; }
  [[nodiscard]] Lanes& lanes() { return state_.lanes; }
  [[nodiscard]] WaysBack& ways_back() { return state_.arms.ways_back(); }

  // A step of the scheduler begins. Precondition: `now` does not decrease.
  void begin(TimePoint now) { state_.now = now; }
  void effect(Effect effect) { effects_.push_back(std::move(effect)); }
  // Announces a job that the scheduler has added.
  void announce(const YieldMove& added) { added_.push_back(added); }
  // Returns the effects since the last call. What clients see comes first, so that an event is told
  // before its consequences.
  [[nodiscard]] std::vector<Effect> take_effects();

  void change_scene();
  // Precondition: no motion is admitted.
  void change_policy(std::shared_ptr<const Policy> policy);
  void set_speed(const SetSpeed& input);
  void set_round(Round round) { state_.round = std::move(round); }
  void resume(ArmId arm) { state_.arms.resume(arm); }
  void set_unlocated(const Unlocated& input);
  // Returns the arms that the arm could have met.
  std::vector<ArmId> set_located(ArmId arm) { return state_.arms.set_located(arm); }
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
