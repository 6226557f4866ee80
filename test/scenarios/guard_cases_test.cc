// The authority guard in the executive. A faulty scheduler cannot move one arm into another, and
// the refusal is reported. The cell has two balls on rails that cross at the origin.
#include "core/executive/active_policy.h"
#include "core/policies/policy.h"
#include "test/scenarios/crossing.h"

namespace armloom {
namespace {

// A faulty policy: starts every motion without any passing order.
PassingOrders without_orders(const OrderQuestion& question) {
  const std::vector<PairRegions> none;
  return orders_apart({question.admitted, question.precedences, question.held_at,
                       question.candidates, none, question.work_behind});
}
const Policy kReckless{"reckless", armloom::Coordinated{0.001}, without_orders};

class Guard : public ::testing::Test {
 protected:
  void begin(CellDescription description = crossing_description()) {
    auto created = Simulation::create(
        *build_cell(description),
        ExecutiveOptions{.own_policy = std::make_shared<Policy>(kReckless)}, log);
    ASSERT_TRUE(created);
    simulation = std::move(*created);
    log.may_refuse = true;
    simulation->tick();
  }
  void submit(JobRequest request) {
    ASSERT_TRUE(simulation->executive().submit(std::move(request)));
  }
  [[nodiscard]] JobView job(const std::string& key) const {
    return *simulation->executive().job(key);
  }
  [[nodiscard]] std::vector<GuardEvent> refusals() const {
    std::vector<GuardEvent> all;
    for (const Event& event : log.events) {
      if (const auto* guard = std::get_if<GuardEvent>(&event.body)) all.push_back(*guard);
    }
    return all;
  }
  [[nodiscard]] bool is_told(Alert::Level level, const std::string& part) const {
    return std::ranges::any_of(log.events, [&](const Event& event) {
      const auto* alert = std::get_if<Alert>(&event.body);
      return alert != nullptr && alert->level == level && alert->text.find(part) != part.npos;
    });
  }
  void run_to_the_end() {
    while (!simulation->executive().all_ended() && simulation->now() < at(60s)) simulation->tick();
    EXPECT_TRUE(simulation->executive().all_ended());
  }

  Log log;
  std::unique_ptr<Simulation> simulation;
};

TEST_F(Guard, RefusesAConflictingMotionAndReportsIt) {
  begin();
  submit(slide("x", -1.0, 1.0, 3.0, "first"));
  simulation->run_until(at(200ms));
  submit(slide("y", -1.0, 1.0, 3.0, "second"));
  bool waits = false;
  while (!simulation->executive().all_ended() && simulation->now() < at(60s)) {
    simulation->tick();
    for (const WaitView& wait : job("second").waits_on) {
      waits = waits || (wait.kind == Wait::Kind::guard && wait.arm == "x");
    }
  }
  EXPECT_GT(log.closest_m, 0.0);
  EXPECT_TRUE(waits) << "the job says what keeps it back";
  for (const char* key : {"first", "second"}) EXPECT_EQ(job(key).state, JobState::succeeded);
  ASSERT_FALSE(refusals().empty());
  const GuardEvent event = refusals().front();
  EXPECT_EQ(event.refusal.why, GuardRefusal::Why::region);
  EXPECT_EQ(event.job, "second");
  EXPECT_EQ(event.other_job, "first");
  EXPECT_TRUE(event.refusal.region.has_value());
  EXPECT_EQ(simulation->executive().figures().guard_refusals, refusals().size());
  EXPECT_TRUE(is_told(Alert::Level::error, "job second: authority guard: y may not go"));
}

TEST_F(Guard, KeepsMotionsOutOfAnArmAtRest) {
  begin();
  submit(slide("x", -1.0, 0.0, 2.0, "into the middle"));
  run_to_the_end();
  submit(slide("y", -1.0, 1.0, 3.0, "through it"));
  simulation->run_until(simulation->now() + 5s);
  EXPECT_GT(log.closest_m, 0.0);
  EXPECT_EQ(refusals().size(), 1U) << "once for each job";
  submit(slide("x", 0.0, 1.0, 2.0, "away"));
  run_to_the_end();
  EXPECT_EQ(job("through it").state, JobState::succeeded) << "it goes on when the guard allows it";
}

TEST_F(Guard, LetsRefusedJobsBeCanceledStoppedAndResumed) {
  begin();
  submit(slide("x", -1.0, 0.0, 2.0, "into the middle"));
  run_to_the_end();
  submit(slide("y", -1.0, 1.0, 3.0, "through it"));
  simulation->run_until(simulation->now() + 3s);
  ASSERT_EQ(refusals().size(), 1U);
  stop_all(simulation->executive(), "test");
  simulation->run_until(simulation->now() + 1s);
  resume_all(simulation->executive());
  simulation->run_until(simulation->now() + 1s);
  EXPECT_FALSE(is_terminal(job("through it").state));
  ASSERT_TRUE(simulation->executive().cancel("through it"));
  run_to_the_end();
  EXPECT_EQ(job("through it").state, JobState::canceled);
  EXPECT_GT(log.closest_m, 0.0);
}

CollisionObject far_box(double x) {
  CollisionObject box{.name = "box", .shape = Box{{0.1, 0.1, 0.1}}};
  box.X_WO.translation() = Eigen::Vector3d(x, 0.8, 0.8);
  return box;
}

// Returns the time at which all jobs have ended. With `camera`, a distant object changes ten times
// a second.
TimePoint end_with_camera(bool camera, const std::string& policy) {
  Crossing cell(crossing_description(), policy);
  EXPECT_TRUE(cell.simulation->executive().scene().add(far_box(0.0)));
  cell.submit(slide("x", -1.0, 1.0, 3.0, "a"));
  cell.submit(slide("y", -1.0, -0.6, 2.0, "b"));
  for (int i = 1; !cell.simulation->executive().all_ended() && i < 200; ++i) {
    cell.run_until(cell.simulation->now() + 100ms);
    if (camera) {
      EXPECT_TRUE(cell.simulation->executive().scene().replace(far_box(0.01 * (i % 7))));
    }
  }
  EXPECT_EQ(cell.simulation->executive().figures().guard_refusals, 0U);
  return at(cell.simulation->executive().figures().last_end.time_since_epoch());
}

class GuardWithACamera : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Policies, GuardWithACamera,
                         ::testing::Values("certified", "earliest_start", "coordinated"));

TEST_P(GuardWithACamera, DistantObjectChangesDelayNoJob) {
  const TimePoint still = end_with_camera(false, GetParam());
  EXPECT_EQ(end_with_camera(true, GetParam()), still);
}

TEST(GuardUnderTimedDiscrete, IsOffAndRaisesAnAlert) {
  Crossing cell;
  cell.run_until(at(10ms));
  const auto says = [&] {
    return std::ranges::any_of(cell.log.events, [](const Event& event) {
      const auto* alert = std::get_if<Alert>(&event.body);
      return alert != nullptr && alert->text.find("no certificates") != std::string::npos;
    });
  };
  EXPECT_TRUE(says());
  cell.log.events.clear();
  ASSERT_TRUE(cell.simulation->executive().policy().change("certified"));
  cell.run_until(at(20ms));
  EXPECT_FALSE(says());
  ASSERT_TRUE(cell.simulation->executive().policy().change("timed_discrete"));
  cell.run_until(at(30ms));
  EXPECT_TRUE(says());
}

}  // namespace
}  // namespace armloom
