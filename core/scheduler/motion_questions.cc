#include "core/scheduler/motion_questions.h"

#include <algorithm>

#include "core/policies/policy.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

Motion motion_now(const State& state, const Job& job) {
  return Motion{.job = job.id,
                .trajectory = job.trajectory,
                .progress = job.progress,
                .to_come = !state.jobs.queues().is_first(job)};
}

}  // namespace

Question question_now(const State& state, const std::vector<JobId>& candidates) {
  Question question{.version = state.version,
                    .start_at = state.now,
                    .candidates = {},
                    .others = {},
                    .rest = state.arms.rest(),
                    .method = state.policy->method()};
  for (JobId id : candidates) {
    question.candidates.push_back(motion_now(state, state.jobs.at(id).job));
  }
  for (const CoordinatedMotion& motion : state.graph.motions()) {
    if (std::ranges::find(candidates, motion.job) != candidates.end()) continue;
    question.others.push_back(motion_now(state, state.jobs.at(motion.job).job));
  }
  return question;
}

Question question_by_itself(const State& state, const Job& job) {
  Question question = question_now(state, {});
  question.others.clear();
  question.candidates = {Motion{job.id, job.trajectory, Duration{}}};
  question.may_part = false;
  set_joints(question.rest, *job.trajectory, job.trajectory->start());
  return question;
}

CoordinatedMotion as_candidate(const Job& job) {
  return {.job = job.id,
          .arms = job.trajectory->arms(),
          .duration = job.trajectory->duration(),
          .progress = job.progress,
          .authority = job.progress,
          .priority = job.terms.priority};
}

void add_passages(Question& question, const std::vector<Passage>& unknown, const JobBook& jobs) {
  for (const Passage& passage : unknown) {
    question.passages.push_back({Motion{.job = passage.leg,
                                        .trajectory = jobs.at(passage.leg).job.trajectory,
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
    for (JobId id : state.jobs.queues()[arm]) {
      const Job& other = state.jobs.at(id).job;
      if (&other == job || (!other.is_admitted() && !is_its_own)) break;
      follow_to_end(at, *state.cell, arm, *other.trajectory);
    }
  }
  return at;
}

}  // namespace armloom
