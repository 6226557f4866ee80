#include "core/scheduler/ways/planned_aside.h"

#include <utility>

#include "core/scheduler/motion_questions.h"

namespace armloom {
void ask_for_way_aside(State& state, const YieldTrial& move) {
  Record& record = state.jobs.at(move.blocked_job);
  YieldsTried& tried = record.yields[move.arm];
  if (tried.planned.question) return;
  tried.from = state.arms.came_by(move.arm);
  tried.next = move.index;
  tried.planned = {.question = ++record.asking.plans};
  const Job& job = record.job;
  PlanQuestion question{.goal = {.arm = move.arm, .to = ClearOf{job.trajectory, job.progress}},
                        .at = rest_after_admitted(state),
                        .seed = job.id.value()};
  state.decided.effects.push_back(
      PlanMotion{job.step(), *tried.planned.question, std::move(question)});
}

void take_way_aside(State& state, const PlanMade& answer) {
  Record* record = state.jobs.find(answer.step);
  if (record == nullptr || record->job.has_ended()) return;
  for (auto& [arm, tried] : record->yields) {
    if (tried.planned.question != answer.question) continue;
    const bool is_there_still = tried.from == state.arms.came_by(arm);
    tried.planned = {.is_answered = is_there_still, .way = answer.trajectory};
  }
}

}  // namespace armloom
