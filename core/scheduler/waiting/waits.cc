#include "core/scheduler/waiting/waits.h"

namespace armloom {

Wait wait_for(const Conflict& conflict) {
  Wait wait{.kind = Wait::Kind::object,
            .proximity = conflict.proximity,
            .own_time = conflict.own_time,
            .other_time = conflict.other_time};
  wait.arm = conflict.proximity.arm_b;
  if (conflict.with == Conflict::With::motion) {
    wait.kind = Wait::Kind::job;
    wait.job = conflict.other_job;
  } else if (conflict.with == Conflict::With::rest) {
    wait.kind = Wait::Kind::arm;
  }
  return wait;
}

Wait wait_for(const HeldBack& held) {
  return Wait{.kind = held.by ? Wait::Kind::job : Wait::Kind::arm,
              .job = held.by,
              .arm = held.arm ? held.arm : held.proximity.arm_b,
              .proximity = held.proximity,
              .own_time = held.own_time,
              .other_time = held.other_time};
}

Wait wait_for(const Obstacle& obstacle) {
  return wait_for(HeldBack{obstacle.other, obstacle.arm, obstacle.proximity, obstacle.own_time,
                           obstacle.other_time});
}

}  // namespace armloom
