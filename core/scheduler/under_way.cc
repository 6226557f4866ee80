#include "core/scheduler/under_way.h"

#include "core/scheduler/motion_questions.h"
#include "core/scheduler/waiting/capacity.h"

namespace armloom {

void put_under_way(Transitions& state, const std::vector<Motion>& motions) {
  for (const Motion& motion : motions) {
    state.add({.job = motion.step.job, .trajectory = motion.trajectory});
  }
  renew_round(state);
  std::vector<CoordinatedMotion> admitted;
  for (const Motion& motion : motions) {
    const Step& step = state->jobs.at(motion.step);
    state.measure(
        step,
        {.step = motion.step, .kind = MotionReport::Kind::progressed, .progress = motion.progress});
    admitted.push_back(as_candidate(state, step));
  }
  state.put_under_way(motions, admitted);
}

}  // namespace armloom
