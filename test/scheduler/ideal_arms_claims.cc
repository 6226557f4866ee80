// What has to hold after every step.
#include <algorithm>

#include "test/scheduler/ideal_arms.h"

namespace armloom {

void IdealArms::check() {
  if (::testing::Test::HasFailure()) return;
  for (const Moving& arm : moving_) {
    EXPECT_FALSE(is_terminal(state(arm.job))) << "job " << arm.job.value() << " moves on";
  }
  if (scheduler.policy().name() != "timed_discrete") check_authority();
  check_explained();
}

// Where the arm may be, and for which job; that is no job where it rests.
std::pair<Stretch, JobId> IdealArms::stretch_of(ArmId arm) const {
  for (const Moving& moving : moving_) {
    const auto& arms = moving.motion->arms();
    if (std::ranges::find(arms, arm) == arms.end()) continue;
    const double now = place_of(*moving.motion, arm, moving.reported);
    const double then = place_of(*moving.motion, arm, moving.authority);
    return {{std::min(now, then), std::max(now, then)}, moving.job};
  }
  return {{q_[arm.index()], q_[arm.index()]}, JobId{0}};
}

void IdealArms::check_authority() const {
  for (std::uint32_t a = 0; a < q_.size(); ++a) {
    for (std::uint32_t b = a + 1; b < q_.size(); ++b) {
      const auto [of_a, job_a] = stretch_of(ArmId{a});
      const auto [of_b, job_b] = stretch_of(ArmId{b});
      if (job_a == job_b && job_a != JobId{0}) continue;
      EXPECT_FALSE(crossings.meet(ArmId{a}, of_a, ArmId{b}, of_b))
          << "arm " << a << " (job " << job_a.value() << ") and arm " << b << " (job "
          << job_b.value() << ") may meet at " << to_seconds(now_.time_since_epoch()) << " s";
    }
  }
}

void IdealArms::check_explained() const {
  if (question) return;  // it may be about to go
  for (const JobId id : scheduler.active()) {
    const Job& job = this->job(id);
    const bool stands = job.pausing() || !moves(id);
    EXPECT_FALSE(stands && job.waits_on.empty())
        << "job " << id.value() << " (" << to_string(job.state()) << ") does not say why it stands";
  }
}

}  // namespace armloom
