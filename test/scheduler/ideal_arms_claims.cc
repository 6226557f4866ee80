#include <algorithm>

#include "test/scheduler/ideal_arms.h"

namespace armloom {

void IdealArms::check() {
  if (::testing::Test::HasFailure()) return;
  for (const Moving& arm : moving_) check_moving(arm);
  for (const JobId id : scheduler.active()) check_phase(job(id));
  check_orders();
  if (scheduler.policy().name != "timed_discrete") check_authority();
  check_explained();
}

void IdealArms::check_moving(const Moving& arm) const {
  const Step& step = this->job(arm.job);
  const std::string what =
      "job " + std::to_string(arm.job.value()) + ", " + to_string(step.state());
  EXPECT_FALSE(is_terminal(step.state())) << what << " moves on";
  EXPECT_TRUE(step.state() == JobState::scheduled || step.state() == JobState::running ||
              step.stopping())
      << what << " moves";
  EXPECT_EQ(step.progress, arm.reported) << what;
  EXPECT_LE(arm.reported, arm.s) << what;
  EXPECT_LE(arm.s, arm.authority) << what;
  EXPECT_LE(arm.authority, arm.motion->duration()) << what;
  for (const ArmId moved : arm.motion->arms()) EXPECT_EQ(scheduler.occupant(moved), arm.job);
}

void IdealArms::check_phase(const Step& step) const {
  const std::string what =
      "job " + std::to_string(step.id.job.value()) + ", " + to_string(step.state());
  const bool admitted = step.state() == JobState::scheduled || step.state() == JobState::running;
  EXPECT_FALSE(step.ended_at() || step.reason()) << what << " has ended";
  EXPECT_TRUE(!admitted || step.times.scheduled_at) << what;
  EXPECT_TRUE(step.state() != JobState::backlogged || step.times.backlogged_at) << what;
  EXPECT_TRUE(step.state() != JobState::running || moves(step.id.job)) << what << " does not move";
  EXPECT_TRUE(step.state() != JobState::paused || step.stopping() || !moves(step.id.job)) << what;
  EXPECT_TRUE(!step.stopping() || moves(step.id.job)) << what << " brakes";
  const bool on_its_way = step.state() == JobState::running || step.state() == JobState::paused;
  EXPECT_TRUE(!on_its_way || step.times.started_at) << what << " has not begun";
  const bool in_queue = step.state() == JobState::queued || step.state() == JobState::backlogged;
  EXPECT_FALSE(in_queue && (step.times.started_at || step.times.scheduled_at || step.pausing()))
      << what;
}

// Checks that no admitted job at rest waits for itself, directly or through other jobs.
void IdealArms::check_orders() const {
  const auto next = [this](JobId id) -> std::optional<JobId> {
    const Step& step = this->job(id);
    const bool admitted = step.state() == JobState::scheduled || step.state() == JobState::running;
    const auto moving = std::ranges::find(moving_, id, &Moving::job);
    const bool may_go_on = moving != moving_.end() && moving->authority > moving->reported;
    const bool stands = admitted && !may_go_on;
    return stands && !step.waits_on.empty() ? step.waits_on.front().job : std::nullopt;
  };
  const std::vector<JobId> active = scheduler.active();
  for (const JobId id : active) {
    std::optional<JobId> before = next(id);
    for (std::size_t n = 0; before && n <= active.size(); ++n) {
      ASSERT_NE(before, id) << "admitted jobs wait for each other in a ring";
      before = next(*before);
    }
  }
}

// Returns where the arm may be, and the job that moves it (0 if the arm rests).
std::pair<Stretch, JobId> IdealArms::stretch_of(ArmId arm) const {
  for (const Moving& moving : moving_) {
    const auto& arms = moving.motion->arms();
    if (std::ranges::find(arms, arm) == arms.end()) continue;
    const double now = place_of(*moving.motion, arm, moving.reported);
    Stretch stretch{now, now};
    const auto comes_to = [&](Duration progress) {
      const double place = place_of(*moving.motion, arm, progress);
      stretch = {std::min(stretch.from, place), std::max(stretch.to, place)};
    };
    for (const Segment& line : moving.motion->segments()) {
      if (line.start > moving.reported && line.start < moving.authority) comes_to(line.start);
    }
    comes_to(moving.authority);
    return {stretch, moving.job};
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
  for (const JobId id : scheduler.active()) {
    for (const Wait& wait : job(id).waits_on) {
      EXPECT_TRUE(wait.kind != Wait::Kind::stop || scheduler.stopped(*wait.arm))
          << "job " << id.value() << " waits for a stop, and the arm is not stopped";
    }
  }
  if (question) return;  // the job may be about to start
  for (const JobId id : scheduler.active()) {
    const Step& step = this->job(id);
    const bool stands = step.pausing() || !moves(id);
    EXPECT_FALSE(stands && step.waits_on.empty())
        << "job " << id.value() << " (" << to_string(step.state())
        << ") does not say why it stands";
  }
}

}  // namespace armloom
