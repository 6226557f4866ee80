#include "core/jobs/waits.h"

#include <cstdio>

namespace armloom {

Wait wait_for(const Conflict& conflict) {
  Wait wait{.kind = Wait::Kind::object,
            .proximity = conflict.proximity,
            .own_time = conflict.own_time,
            .other_time = conflict.other_time};
  wait.arm = conflict.proximity.arm_b;
  if (conflict.with == Conflict::With::motion) {
    wait.kind = Wait::Kind::job;
    if (conflict.other_step) wait.job = conflict.other_step->job;
  } else if (conflict.with == Conflict::With::rest) {
    wait.kind = Wait::Kind::arm;
  }
  return wait;
}

Wait wait_for(const Blocker& blocker) {
  return Wait{.kind = blocker.other ? Wait::Kind::job : Wait::Kind::arm,
              .job = blocker.other ? std::optional(blocker.other->job) : std::nullopt,
              .arm = blocker.arm ? blocker.arm : blocker.proximity.arm_b,
              .proximity = blocker.proximity,
              .own_time = blocker.own_time,
              .other_time = blocker.other_time};
}

std::string self_collision_text(const Conflict& conflict) {
  const double apart = conflict.proximity.clearance_m;
  char how[64] = " touch each other";
  if (apart > 0.0) std::snprintf(how, sizeof how, " come within %.4g m of each other", apart);
  char when[64];
  std::snprintf(when, sizeof when, " at %.3f s of the trajectory", to_seconds(conflict.own_time));
  return conflict.proximity.body_a + " and " + conflict.proximity.body_b + how + when;
}

std::string seconds_text(Duration duration) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g s", to_seconds(duration));
  return text;
}

}  // namespace armloom
