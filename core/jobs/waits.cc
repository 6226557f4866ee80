#include "core/jobs/waits.h"

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

Wait wait_for(const Blocker& blocker) {
  return Wait{.kind = blocker.other ? Wait::Kind::job : Wait::Kind::arm,
              .job = blocker.other,
              .arm = blocker.arm ? blocker.arm : blocker.proximity.arm_b,
              .proximity = blocker.proximity,
              .own_time = blocker.own_time,
              .other_time = blocker.other_time};
}

}  // namespace armloom
