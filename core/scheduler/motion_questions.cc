#include "core/scheduler/motion_questions.h"

#include <algorithm>

#include "core/coordination/tracking_errors.h"
#include "core/jobs/standing.h"
#include "core/policies/policy.h"
#include "core/trajectory/joint_line.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

// Returns where the job leaves this arm, which it moves.
const PlacePtr& end_on(const Step& step, ArmId arm) {
  const auto own = std::ranges::find(step.leg.arms, arm) - step.leg.arms.begin();
  return step.leg.to[static_cast<std::size_t>(own)];
}

Motion::Stands stands_now(const State& state, const Step& step) {
  if (step.in<Held>() != nullptr) return Motion::Stands::stays;
  if (speed_wait(state, step)) return Motion::Stands::may_stay;
  if (step.in<Braking>() != nullptr) return Motion::Stands::may_stay;
  if (is_standing(*state.cell, step, state.now)) return Motion::Stands::may_stay;
  return Motion::Stands::goes_on;
}

Motion motion_now(const State& state, const Step& step) {
  return Motion{.step = step.id,
                .trajectory = step.trajectory,
                .progress = step.progress,
                .to_come = !state.jobs.queues().is_first(step),
                .off_path = off_path_of(state, step),
                .stands = stands_now(state, step),
                .share = state.speed.effective(step.trajectory->arms())};
}

// Returns the step's motion; for a passage to its start, the straight line to there.
TrajectoryPtr motion_of(const Passage& passage, const Cell& cell, const Step& step) {
  if (passage.from == nullptr) return step.trajectory;
  const WaitingLeg& leg = step.leg;
  const auto own = std::ranges::find(leg.arms, passage.from->arm) - leg.arms.begin();
  const auto& joints = cell.arm(passage.from->arm).joints;
  const auto way =
      line_or_stay(cell, joints, passage.from->q, leg.from[static_cast<std::size_t>(own)]->q);
  return way ? way : step.trajectory;
}

}  // namespace

double off_path_of(const State& state, const Step& step) {
  if (step.has_started() || step.in<Moving>() != nullptr) return step.off_path;
  double off = 0.0;
  for (std::size_t i = 0; i < step.leg.arms.size(); ++i) {
    const ArmId arm = step.leg.arms[i];
    const auto before = state.jobs.queues().before(step, arm);
    const PlacePtr& stands = before ? end_on(state.jobs.at(*before), arm) : state.arms.place(arm);
    const double off_arm = (step.leg.from[i]->q - stands->q).cwiseAbs().maxCoeff();
    if (off_arm > state.cell->execution.start_tolerance_rad) return 0.0;  // it cannot begin there
    const RobotId robot = state.cell->arm(arm).robot;
    const double error = state.cell->tracking_error(robot);
    if (off_arm > error) off = std::max(off, certified_error(off_arm, error));
  }
  return off;
}

Question question_now(const State& state, const std::vector<StepId>& candidates) {
  Question question{.version = state.version(),
                    .start_at = state.now,
                    .candidates = {},
                    .others = {},
                    .rest = state.arms.rest(),
                    .method = state.policy->method};
  for (StepId step : candidates) {
    Motion& candidate = question.candidates.emplace_back(motion_now(state, state.jobs.at(step)));
    if (state.jobs.at(step).is_waiting()) candidate.stands = Motion::Stands::goes_on;
  }
  for (const CoordinatedMotion& motion : state.graph.motions()) {
    if (std::ranges::find(candidates, motion.step) != candidates.end()) continue;
    question.others.push_back(motion_now(state, state.jobs.at(motion.step)));
  }
  return question;
}

Question question_by_itself(const State& state, const Step& step) {
  Question question = question_now(state, {});
  question.others.clear();
  question.candidates = {Motion{step.id, step.trajectory, Duration{}}};
  question.may_part = false;
  set_joints(question.rest, *step.trajectory, step.trajectory->start());
  return question;
}

CoordinatedMotion as_candidate(const State& state, const Step& step) {
  return {.step = step.id,
          .arms = step.trajectory->arms(),
          .duration = step.trajectory->duration(),
          .progress = step.progress,
          .authority = std::max(step.progress, step.farthest),  // of a team's foremost arm
          .priority = step.job->terms.priority,
          .outlook = {.pace = state.speed.pace(step.trajectory->arms())}};
}

void add_passages(Question& question, const std::vector<Passage>& unknown, const State& state) {
  for (const Passage& passage : unknown) {
    const Step& step = state.jobs.at(passage.leg);
    question.passages.push_back({Motion{.step = passage.leg,
                                        .trajectory = motion_of(passage, *state.cell, step),
                                        .progress = Duration{},
                                        .to_come = true},
                                 passage.place->arm, passage.place->q});
  }
}

Configuration rest_after_admitted(const State& state, const Step* step) {
  Configuration at = state.arms.rest();
  for (std::uint32_t a = 0; a < state.cell->arms.size(); ++a) {
    const ArmId arm{a};
    const bool is_its_own = step != nullptr && step->trajectory->arms().front() == arm;
    for (const Step& other : state.jobs.of(state.jobs.queues()[arm])) {
      if (&other == step || (!other.is_admitted() && !is_its_own)) break;
      follow_to_end(at, *state.cell, arm, *other.trajectory);
    }
  }
  return at;
}

}  // namespace armloom
