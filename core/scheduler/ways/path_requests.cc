#include "core/scheduler/ways/path_requests.h"

#include <utility>

#include "core/scheduler/ways/detour.h"
#include "core/scheduler/ways/goals.h"
#include "core/scheduler/ways/planned_aside.h"
#include "core/scheduler/ways/replanning.h"

namespace armloom {

void send(State& state, Record& record, PathRequest& request, PlanQuestion question) {
  request.question = ++record.asking.plans;
  request.beside = question.at;
  request.asked_at = state.version;
  ++request.tries;
  state.decided.effects.push_back(
      PlanMotion{record.job.step(), *request.question, std::move(question)});
}

void take_plan(State& state, const PlanMade& answer, WaitCycles& cycles) {
  Record* record = state.jobs.find(answer.step);
  if (record == nullptr || record->job.has_ended()) return;
  Job& job = record->job;
  if (job.goal) {
    for (GoalWay& way : job.goal->ways) {
      if (way.request.takes(answer.question)) return take_goal_plan(state, *record, way, answer);
    }
    auto& detour = job.goal->detour;
    if (detour && detour->request.takes(answer.question))
      return take_detour(state, *record, answer);
  }
  if (job.another_way && job.another_way->request.takes(answer.question)) {
    if (take_other_way(state, *record, answer)) cycles.has_opened(state, job.id);
    return;
  }
  for (auto& [arm, tried] : record->yields) {
    if (tried.planned.request.takes(answer.question))
      return take_way_aside(state, arm, tried, answer);
  }
}

}  // namespace armloom
