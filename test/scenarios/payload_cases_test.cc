// Jobs whose arms hold objects with a mass.
#include <gmock/gmock.h>

#include "test/scenarios/tasks.h"

namespace armloom {
namespace {

using ::testing::HasSubstr;

// Arm x carries at most 4 kg; then it keeps a quarter of its brake, so it goes at half the speed.
CellDescription with_payload() {
  CellDescription cell = with_io();
  cell.robots.front().arms.front().payload = PayloadDescription{4.0, 0.25, 0.2};
  return cell;
}
CollisionObject heavy(double kg, double off_center_m = 0.0) {
  CollisionObject part = part_at(0.13);
  part.mass = {kg, {off_center_m, 0.0, 0.0}};
  return part;
}
ArmView x_of(Tasks& cell) { return cell.executive().arms().front(); }

// Returns how long arm x carries a part of this mass.
double time_with(double kg) {
  Tasks cell(with_payload());
  EXPECT_TRUE(cell.scene().replace(heavy(kg)));
  cell.submit(task("pick", pick_and_place()));
  std::optional<TimePoint> since;
  while (cell.simulation->now() < at(60s) && !cell.executive().all_ended()) {
    cell.simulation->tick();
    const bool holds = !cell.scene().scene()->attachments().empty();
    if (holds && !since) since = cell.simulation->now();
    if (!holds && since) return to_seconds(cell.simulation->now() - *since);
  }
  return 0.0;
}

TEST(Payload, HalvesTheSpeedAtAQuarterOfTheBrake) {
  const double light_s = time_with(0.0), heavy_s = time_with(4.0);
  ASSERT_GT(light_s, 0.3);
  EXPECT_NEAR(heavy_s / light_s, 1.85, 0.15) << "0.08 s of it do not depend on the mass";
}

TEST(Payload, EndsWithTheObject) {
  Tasks cell(with_payload());
  ASSERT_TRUE(cell.scene().replace(heavy(4.0)));
  cell.submit(task("pick", pick_and_place()));
  double slowest = 1.0;
  while (!cell.executive().all_ended() && cell.simulation->now() < at(60s)) {
    cell.simulation->tick();
    slowest = std::min(slowest, x_of(cell).effective_speed_override);
  }
  EXPECT_EQ(cell.job("pick").state, JobState::succeeded) << cell.job("pick").detail();
  EXPECT_DOUBLE_EQ(slowest, 0.5);
  EXPECT_DOUBLE_EQ(x_of(cell).effective_speed_override, 1.0);
}

TEST(Payload, AHeavyObjectIsRefusedWithTheJob) {
  Tasks cell(with_payload());
  ASSERT_TRUE(cell.scene().replace(heavy(4.5)));
  const auto refused = cell.executive().submit(task("pick", pick_and_place()));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().slug, "too-heavy");
  EXPECT_EQ(refused.error().front().pointer, "/steps/1/attach/object");
}

// Only at the object it shows how far its mass is from the hand.
TEST(Payload, AMassFarFromTheHandFailsTheStep) {
  Tasks cell(with_payload());
  ASSERT_TRUE(cell.scene().replace(heavy(3.0, 0.4)));
  cell.submit(task("pick", pick_and_place()));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("pick").reason(), Reason::step_failed);
  EXPECT_THAT(cell.job("pick").detail(), HasSubstr("its payload is 4 kg"));
  EXPECT_TRUE(cell.scene().scene()->attachments().empty());
}

TEST(Payload, AnArmThatStatesNoneHoldsNoMass) {
  Tasks cell;
  ASSERT_TRUE(cell.scene().replace(heavy(0.1)));
  const auto refused = cell.executive().submit(task("pick", pick_and_place()));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().slug, "payload-unknown");
}

// As after a restart with a cell file that permits less.
TEST(Payload, AnArmThatHoldsTooMuchDoesNotMoveUntilItLetsGo) {
  Tasks cell(with_payload());
  ASSERT_TRUE(cell.scene().hold({.object = heavy(5.0), .link = "x_ball"}));
  cell.submit(task("away", {slide_to("x", 0.5)}));
  cell.simulation->run_until(at(5s));
  EXPECT_DOUBLE_EQ(x_of(cell).effective_speed_override, 0.0);
  const JobView job = cell.job("away");
  ASSERT_EQ(job.waits_on.size(), 1U);
  EXPECT_EQ(job.waits_on.front().kind, Wait::Kind::holding);
  EXPECT_THAT(job.waits_on.front().detail, HasSubstr("x holds more than its payload permits"));
  EXPECT_FALSE(job.times.started_at);
  ASSERT_TRUE(cell.executive().detach("part"));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("away").state, JobState::succeeded) << cell.job("away").detail();
}

}  // namespace
}  // namespace armloom
