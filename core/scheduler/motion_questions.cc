#include "core/scheduler/motion_questions.h"

#include <algorithm>

#include "core/coordination/tracking_errors.h"
#include "core/jobs/pace.h"
#include "core/jobs/standing.h"
#include "core/policies/policy.h"
#include "core/trajectory/joint_line.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

// Where the job leaves this arm of its own.
const PlacePtr& end_on(const Record& record, ArmId arm) {
  const auto own = std::ranges::find(record.leg.arms, arm) - record.leg.arms.begin();
  return record.leg.to[static_cast<std::size_t>(own)];
}

// Under policies without orders nothing else tells those who are about to pass.
Motion::Stands stands_now(const State& state, const Job& job) {
  if (job.in<Held>() != nullptr) return Motion::Stands::stays;
  if (speed_wait(state, job)) return Motion::Stands::may_stay;
  if (job.in<Braking>() != nullptr) return Motion::Stands::may_stay;
  if (is_standing(*state.cell, job, state.now)) return Motion::Stands::may_stay;
  return Motion::Stands::goes_on;
}

Motion motion_now(const State& state, const Record& record) {
  const Job& job = record.job;
  return Motion{.step = job.step(),
                .trajectory = job.trajectory,
                .progress = job.progress,
                .to_come = !state.jobs.queues().is_first(job),
                .off_path = off_path_of(state, record),
                .stands = stands_now(state, job),
                .share = state.speed.effective(job.trajectory->arms())};
}

// Its own motion, or the straight way by which its arm is brought to where that begins.
TrajectoryPtr motion_of(const Passage& passage, const Cell& cell, const Record& record) {
  if (passage.from == nullptr) return record.job.trajectory;
  const WaitingLeg& leg = record.leg;
  const auto own = std::ranges::find(leg.arms, passage.from->arm) - leg.arms.begin();
  const auto& joints = cell.arm(passage.from->arm).joints;
  const auto way =
      line_or_stay(cell, joints, passage.from->q, leg.from[static_cast<std::size_t>(own)]->q);
  return way ? way : record.job.trajectory;
}

}  // namespace

double off_path_of(const State& state, const Record& record) {
  if (record.job.has_started() || record.job.in<Moving>() != nullptr) return record.off_path;
  double off = 0.0;
  for (std::size_t i = 0; i < record.leg.arms.size(); ++i) {
    const ArmId arm = record.leg.arms[i];
    const auto before = state.jobs.queues().before(record.job, arm);
    const PlacePtr& stands = before ? end_on(state.jobs.at(*before), arm) : state.arms.place(arm);
    const double off_arm = (record.leg.from[i]->q - stands->q).cwiseAbs().maxCoeff();
    if (off_arm > state.cell->execution.start_tolerance_rad) return 0.0;  // it does not begin so
    const RobotId robot = state.cell->arm(arm).robot;
    const double error = state.cell->tracking_error(robot);
    if (off_arm > error) off = std::max(off, certified_error(off_arm, error));
  }
  return off;
}

Question question_now(const State& state, const std::vector<StepId>& candidates) {
  Question question{.version = state.version,
                    .start_at = state.now,
                    .candidates = {},
                    .others = {},
                    .rest = state.arms.rest(),
                    .method = state.policy->method};
  for (StepId step : candidates) {
    Motion& candidate = question.candidates.emplace_back(motion_now(state, state.jobs.at(step)));
    if (state.jobs.at(step).job.is_waiting()) candidate.stands = Motion::Stands::goes_on;
  }
  for (const CoordinatedMotion& motion : state.graph.motions()) {
    if (std::ranges::find(candidates, motion.step) != candidates.end()) continue;
    question.others.push_back(motion_now(state, state.jobs.at(motion.step)));
  }
  return question;
}

Question question_by_itself(const State& state, const Job& job) {
  Question question = question_now(state, {});
  question.others.clear();
  question.candidates = {Motion{job.step(), job.trajectory, Duration{}}};
  question.may_part = false;
  set_joints(question.rest, *job.trajectory, job.trajectory->start());
  return question;
}

CoordinatedMotion as_candidate(const State& state, const Job& job) {
  return {.step = job.step(),
          .arms = job.trajectory->arms(),
          .duration = job.trajectory->duration(),
          .progress = job.progress,
          .authority = job.progress,
          .priority = job.terms.priority,
          .outlook = {.pace = state.speed.pace(job.trajectory->arms())}};
}

void add_passages(Question& question, const std::vector<Passage>& unknown, const State& state) {
  for (const Passage& passage : unknown) {
    const Record& record = state.jobs.at(passage.leg);
    question.passages.push_back({Motion{.step = passage.leg,
                                        .trajectory = motion_of(passage, *state.cell, record),
                                        .progress = Duration{},
                                        .to_come = true},
                                 passage.place->arm, passage.place->q});
  }
}

Configuration rest_after_admitted(const State& state, const Job* job) {
  Configuration at = state.arms.rest();
  for (std::uint32_t a = 0; a < state.cell->arms.size(); ++a) {
    const ArmId arm{a};
    const bool is_its_own = job != nullptr && job->trajectory->arms().front() == arm;
    for (StepId step : state.jobs.queues()[arm]) {
      const Job& other = state.jobs.at(step).job;
      if (&other == job || (!other.is_admitted() && !is_its_own)) break;
      follow_to_end(at, *state.cell, arm, *other.trajectory);
    }
  }
  return at;
}

}  // namespace armloom
