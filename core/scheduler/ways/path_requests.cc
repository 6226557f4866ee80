#include "core/scheduler/ways/path_requests.h"

#include <utility>

#include "core/scheduler/ways/detour.h"
#include "core/scheduler/ways/goals.h"
#include "core/scheduler/ways/replanning.h"
#include "core/scheduler/yielding/yield_moves.h"

namespace armloom {

PathRequest send(Transitions& state, const Step& step, PlanPurpose purpose, PathRequest request,
                 PlanQuestion question) {
  request.beside = question.at;
  request.asked_at = state->version();
  ++request.tries;
  PlanRequests plans = step.plans;
  const std::uint64_t number = plans.open({purpose, question, request.asked_at});
  state.jobs().set(step, std::move(plans));
  const RefusedPlans& refused = state->around.refused_plans;
  PlanMotion asked{step.id, number, std::move(question)};
  if (const NoPlan* known = refused.find(*state->cell, asked.question)) asked.known = *known;
  asked.question.has_no_way_past = refused.has_no_way_past(*state->cell, asked.question);
  state.effect(std::move(asked));
  return request;
}

void take_plan(Transitions& state, const PlanMade& answer, WaitCycles& cycles) {
  const Step* step = state->jobs.find(answer.step);
  if (step == nullptr || step->has_ended()) return;
  PlanRequests plans = step->plans;
  const auto request = plans.close(answer.question);
  if (!request) return;
  state.jobs().set(*step, std::move(plans));
  if (request->asked_at >= state->around.scene_since) state.learn(request->question, answer);
  const PlanPurpose& purpose = request->purpose;
  if (const auto* goal = std::get_if<ForGoal>(&purpose)) {
    take_goal_plan(state, *step, goal->way, answer);
  } else if (std::holds_alternative<ForDetour>(purpose)) {
    take_detour(state, *step, answer);
  } else if (std::holds_alternative<ForReplan>(purpose)) {
    if (take_other_way(state, *step, answer)) cycles.has_opened(state, step->id.job);
  } else if (const auto* retreat = std::get_if<ForRetreat>(&purpose)) {
    take_way_aside(state, *step, retreat->arm, answer);
  }
}

}  // namespace armloom
