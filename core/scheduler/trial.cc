#include "core/scheduler/trial.h"

#include <algorithm>
#include <utility>

#include "core/jobs/waits.h"
#include "core/trajectory/set_joints.h"

namespace armloom {

Trial::Trial(Scheduler scheduler, Open open, const std::vector<Submit>& jobs, JobId asked,
             TimePoint now, std::vector<Submit> behind)
    : scheduler_(std::move(scheduler)), job_(asked), now_(now), open_(std::move(open)) {
  for (const Submit& job : jobs) step(job);
  for (JobId before = asked; Submit & motion : behind) {
    motion.job = scheduler_.next_job();
    motion.after = {std::exchange(before, motion.job)};
    motion.task = asked;
    step(motion);
  }
}

void Trial::step(const Input& input) {
  for (Effect& effect : scheduler_.step(input, now_)) {
    if (auto* judge = std::get_if<Judge>(&effect)) open_.question = std::move(judge->question);
    if (auto* plan = std::get_if<PlanMotion>(&effect)) open_.plans.push_back(std::move(*plan));
    const auto* sent = std::get_if<YieldMove>(&effect);
    if (sent == nullptr) continue;
    added_.insert(sent->job);
    if (sent->to_start && sent->blocked_job == job_) approaches_.push_back(sent->job);
  }
  const Step* own = scheduler_.find(job_);
  if (own == nullptr) return;  // this was an earlier job
  if (!own->waits_on.empty()) waits_ = own->waits_on;
  const auto wake = scheduler_.wakes_at();
  if (!is_in_ring() || !wake || *wake - now_ > kAfterRingWasTold) return;
  now_ = *wake;  // its cycle has been published
  step(Wake{});
}

// Ignores deadlock cycles of other jobs.
bool Trial::is_in_ring() const {
  const auto in_ring = [&](JobId id) { return !scheduler_.find(id)->job->ring.empty(); };
  return in_ring(job_) || std::ranges::any_of(approaches_, in_ring);
}

// Returns true if all moves to its start are under way or done.
bool Trial::is_on_its_way() const {
  const auto goes = [this](JobId id) {
    const Step& approach = *scheduler_.find(id);
    return approach.has_authority() || approach.state() == JobState::succeeded;
  };
  return !approaches_.empty() && std::ranges::all_of(approaches_, goes);
}

bool Trial::is_decided() const {
  const JobState state = scheduler_.find(job_)->state();
  return (state != JobState::queued && state != JobState::backlogged) ||
         judgements_ >= kJudgementsMax;
}

std::optional<Question> Trial::next() const { return is_decided() ? std::nullopt : open_.question; }

std::optional<PlanMotion> Trial::next_plan() const {
  if (is_decided() || open_.plans.empty() || plans_ >= kPlansMax) return std::nullopt;
  return open_.plans.front();
}

void Trial::answer(const PlanMade& made) {
  open_.plans.erase(open_.plans.begin());
  ++plans_;
  step(made);
}

void Trial::answer(Verdict verdict) {
  const Question question = *std::exchange(open_.question, std::nullopt);
  ++judgements_;
  // Ignores questions in which an arm has retreated.
  const bool as_arms_stand = question.rest == scheduler_.state().arms.rest();
  const bool of_it = std::ranges::any_of(question.candidates, [this](const Motion& motion) {
    const JobId job = motion.step.job;
    return job == job_ || std::ranges::find(approaches_, job) != approaches_.end();
  });
  if (of_it && as_arms_stand) {
    evaluations_ += verdict.evaluations;
    by_clock_ = scheduler_.earliest_start(question, verdict);
    last_ = verdict;
    last_->regions.clear();
  }
  step(Judged{std::move(verdict)});
}

// Returns the time from now until the last move to its start ends.
Duration Trial::approach_ends() const {
  Duration last{};
  for (JobId id : approaches_) {
    const Step& approach = *scheduler_.find(id);
    if (!approach.times.scheduled_at) continue;
    last = std::max(last, *approach.times.scheduled_at - now_ +
                              scheduler_.state().time_for(*approach.trajectory));
  }
  return last;
}

// Replaces waits for the job's own moves to its start by the waits of these moves, which clients do
// not know.
std::vector<Wait> Trial::waits() const {
  std::vector<Wait> waits;
  for (const Wait& wait : waits_) {
    const bool is_own = wait.job && std::ranges::find(approaches_, *wait.job) != approaches_.end();
    const Step* approach = is_own ? scheduler_.find(*wait.job) : nullptr;
    if (approach != nullptr && !approach->waits_on.empty()) {
      waits.insert(waits.end(), approach->waits_on.begin(), approach->waits_on.end());
    } else {
      waits.push_back(wait);
    }
  }
  return waits;
}

Trial::Outcome Trial::outcome() const {
  const Step& step = *scheduler_.find(job_);
  Outcome outcome{.kind = Verdict::Kind::conflict, .evaluations = evaluations_, .added = added_};
  outcome.step = step;
  if (is_on_its_way()) outcome.approach = approach_ends();
  if (step.has_authority() || is_on_its_way()) {
    outcome.kind = Verdict::Kind::free;
    outcome.waits = step.waits_on;
    const bool is_itself = step.has_authority();
    const Duration begins = is_itself ? *step.times.scheduled_at - now_ : approach_ends();
    outcome.starts_in = std::max(Duration{}, begins);
    if (last_) outcome.clearance_bound = last_->clearance_bound;
    return outcome;
  }
  outcome.starts_in = by_clock_;
  outcome.waits = waits();
  if (step.has_ended()) outcome.waits.clear();
  if (step.has_ended() && last_) {
    for (const Conflict& conflict : last_->conflicts) outcome.waits.push_back(wait_for(conflict));
  }
  if (last_ && last_->kind == Verdict::Kind::undecided) outcome.kind = Verdict::Kind::undecided;
  return outcome;
}

Scheduler with_arms_at(const Scheduler& present, const CellPtr& cell,
                       const std::vector<ArmId>& arms, const Configuration& at, TimePoint now) {
  Configuration rest = present.state().arms.rest();
  std::vector<Motion> under_way;
  std::vector<ArmId> taken = arms;
  for (const JobId id : present.active()) {
    const Step& step = *present.find(id);
    if (!step.has_authority()) continue;
    const std::vector<ArmId>& moved = step.trajectory->arms();
    if (std::ranges::find_first_of(moved, arms) != moved.end()) {
      set_joints(rest, *step.trajectory, step.trajectory->goal());
    } else if (std::ranges::find_first_of(moved, taken) == moved.end()) {
      taken.insert(taken.end(), moved.begin(), moved.end());
      under_way.push_back({step.id, step.trajectory, step.progress});
    }
  }
  for (const ArmId arm : arms) {
    const std::vector<JointId> joints = joints_and_gripper(cell->arm(arm));
    set_joints(rest, joints, joints_of(at, joints));
  }
  std::ranges::sort(under_way, {}, [](const Motion& motion) { return motion.step.job; });
  Scheduler scheduler(cell, present.state().policy, std::move(rest), under_way, now);
  const SpeedOverride& speed = present.state().speed;
  (void)scheduler.step(SetSpeed{std::nullopt, speed.cell()}, now);
  for (std::uint32_t a = 0; a < cell->arms.size(); ++a) {
    const ArmId arm{a};
    if (speed.arm(arm) != 1.0) (void)scheduler.step(SetSpeed{arm, speed.arm(arm)}, now);
    if (speed.brake(arm) != 1.0) (void)scheduler.step(SetBrake{arm, speed.brake(arm)}, now);
    if (const auto& stop = present.state().arms.stop_of(arm)) {
      (void)scheduler.step(Stop({{arm, stop->cause, stop->until_connected}}), now);
    }
  }
  return scheduler;
}

}  // namespace armloom
