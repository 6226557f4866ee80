#include "core/scheduler/under_way.h"

#include "core/jobs/phases.h"
#include "core/scheduler/motion_questions.h"
#include "core/scheduler/waiting/capacity.h"

namespace armloom {

void put_under_way(State& state, const std::vector<Motion>& motions) {
  std::vector<CoordinatedMotion> admitted;
  for (const Motion& motion : motions) {
    const Submit job{.job = motion.step.job, .trajectory = motion.trajectory};
    add(state, step_of(state, job));
  }
  renew_round(state);
  for (const Motion& motion : motions) {
    Step& step = state.jobs.at(motion.step);
    step.progress = motion.progress;
    const bool has_moved = motion.progress > Duration{};
    if (has_moved) step.note_start(state.now);
    enter(state, step, Admitted{});
    enter(state, step,
          Moving{.overrun_at = TimePoint::max(), .moved_at = state.now, .is_under_way = has_moved});
    admitted.push_back(as_candidate(state, step));
  }
  state.graph.admit(admitted, PassingOrders{});
}

}  // namespace armloom
