#include "core/scheduler/ways/planned_aside.h"

#include "core/scheduler/motion_questions.h"
#include "core/scheduler/ways/path_requests.h"

namespace armloom {
void ask_for_way_aside(Transitions& state, const YieldTrial& move) {
  const Step& step = state->jobs.at(move.blocked_job);
  YieldsTried tried = tried_for(step, move.arm);
  if (tried.planned.request.question) return;
  tried.from = state->arms.came_by(move.arm);
  tried.next = move.index;
  tried.planned = {};
  tried.planned.request =
      send(state, step, {},
           {.goal = {.arm = move.arm, .to = ClearOf{step.trajectory, step.progress}},
            .at = rest_after_admitted(state),
            .seed = step.id.job.value()});
  state.jobs().set(step, move.arm, std::move(tried));
}

void take_way_aside(Transitions& state, const Step& step, ArmId arm, const PlanMade& answer) {
  YieldsTried tried = tried_for(step, arm);
  const bool is_there_still = tried.from == state->arms.came_by(arm);
  tried.planned = {.is_answered = is_there_still, .way = answer.trajectory};
  state.jobs().set(step, arm, std::move(tried));
}

}  // namespace armloom
