#include "core/executive/observe.h"

#include <algorithm>
#include <utility>

namespace armloom {

Observation observed(const Motions& motions, const AuthorityGate& gate, std::size_t arms,
                     TimePoint now) {
  using Phase = ArmFeedback::Phase;
  Observation seen{.time = now, .measured = motions.measured(), .arms = {}};
  for (std::uint32_t a = 0; a < arms; ++a) {
    const ArmId arm{a};
    const ArmFeedback& feedback = motions.feedback(arm);
    const ArmLink& link = motions.link(arm);
    const ArmPosition& position = gate.guard().position(arm);
    const bool waits = feedback.phase == Phase::waiting;
    const bool brakes = feedback.phase == Phase::braking;
    const bool rests = !waits && !brakes && feedback.phase != Phase::moving;
    TrajectoryPtr motion = motions.trajectory(arm);
    // A finished arm's motion is released at once; a rejected one was never followed.
    if (feedback.phase == Phase::idle || feedback.phase == Phase::fault) motion = nullptr;
    seen.arms.push_back({
        .is_connected = link.state() != ArmLink::State::connecting,
        .motion = std::move(motion),
        .measured = feedback.measured_progress,
        .commanded = feedback.commanded_progress,
        // The guard raises its own value to the measured progress.
        .authority = position.at_rest ? feedback.measured_progress
                                      : std::max(motions.granted(arm), feedback.authority),
        .starts = motions.starts(arm),
        .speed = motions.speed(arm).share,
        .brake = motions.speed(arm).brake,
        .rests = rests,
        .brakes = brakes,
        .braking_since = link.braking_since(),
        .rests_at = feedback.rests_at,
        .off_path = position.off_path,
        .reported = {link.connection(), feedback.controller_time},
        .feedback_age = link.age(),
    });
  }
  return seen;
}

}  // namespace armloom
