#include "core/scheduler/ways/path_requests.h"

#include <utility>

#include "core/scheduler/ways/detour.h"
#include "core/scheduler/ways/goals.h"
#include "core/scheduler/ways/replanning.h"
#include "core/scheduler/yielding/yield_moves.h"

namespace armloom {

PathRequest send(Transitions& state, const Step& step, PathRequest request, PlanQuestion question) {
  Asking asking = step.asking;
  request.question = ++asking.plans;
  state.jobs().set(step, asking);
  request.beside = question.at;
  request.asked_at = state->version();
  ++request.tries;
  state.effect(PlanMotion{step.id, *request.question, std::move(question)});
  return request;
}

void take_plan(Transitions& state, const PlanMade& answer, WaitCycles& cycles) {
  const Step* step = state->jobs.find(answer.step);
  if (step == nullptr || step->has_ended()) return;
  if (step->goal) {
    for (std::size_t k = 0; k < step->goal->ways.size(); ++k) {
      if (step->goal->ways[k].request.question == answer.question)
        return take_goal_plan(state, *step, k, answer);
    }
    const auto& detour = step->goal->detour;
    if (detour && detour->request.question == answer.question)
      return take_detour(state, *step, answer);
  }
  if (step->another_way && step->another_way->request.question == answer.question) {
    if (take_other_way(state, *step, answer)) cycles.has_opened(state, step->id.job);
    return;
  }
  for (const auto& [arm, tried] : step->yields) {
    if (tried.planned.request.question == answer.question)
      return take_way_aside(state, *step, arm, answer);
  }
}

}  // namespace armloom
