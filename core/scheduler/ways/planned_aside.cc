#include "core/scheduler/ways/planned_aside.h"

#include "core/scheduler/motion_questions.h"
#include "core/scheduler/ways/path_requests.h"

namespace armloom {
void ask_for_way_aside(State& state, const YieldTrial& move) {
  Step& step = state.jobs.at(move.blocked_job);
  YieldsTried& tried = step.yields[move.arm];
  if (tried.planned.request.question) return;
  tried.from = state.arms.came_by(move.arm);
  tried.next = move.index;
  tried.planned = {};
  send(state, step, tried.planned.request,
       {.goal = {.arm = move.arm, .to = ClearOf{step.trajectory, step.progress}},
        .at = rest_after_admitted(state),
        .seed = step.id.job.value()});
}

void take_way_aside(const State& state, ArmId arm, YieldsTried& tried, const PlanMade& answer) {
  const bool is_there_still = tried.from == state.arms.came_by(arm);
  tried.planned = {.is_answered = is_there_still, .way = answer.trajectory};
}

}  // namespace armloom
