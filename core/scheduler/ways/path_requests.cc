#include "core/scheduler/ways/path_requests.h"

#include <utility>

#include "core/scheduler/ways/detour.h"
#include "core/scheduler/ways/goals.h"
#include "core/scheduler/ways/planned_aside.h"
#include "core/scheduler/ways/replanning.h"

namespace armloom {

void send(State& state, Step& step, PathRequest& request, PlanQuestion question) {
  request.question = ++step.asking.plans;
  request.beside = question.at;
  request.asked_at = state.version();
  ++request.tries;
  state.decided.effects.push_back(PlanMotion{step.id, *request.question, std::move(question)});
}

void take_plan(State& state, const PlanMade& answer, WaitCycles& cycles) {
  Step* step = state.jobs.find(answer.step);
  if (step == nullptr || step->has_ended()) return;
  if (step->goal) {
    for (GoalWay& way : step->goal->ways) {
      if (way.request.takes(answer.question)) return take_goal_plan(state, *step, way, answer);
    }
    auto& detour = step->goal->detour;
    if (detour && detour->request.takes(answer.question)) return take_detour(state, *step, answer);
  }
  if (step->another_way && step->another_way->request.takes(answer.question)) {
    if (take_other_way(state, *step, answer)) cycles.has_opened(state, step->id.job);
    return;
  }
  for (auto& [arm, tried] : step->yields) {
    if (tried.planned.request.takes(answer.question))
      return take_way_aside(state, arm, tried, answer);
  }
}

}  // namespace armloom
