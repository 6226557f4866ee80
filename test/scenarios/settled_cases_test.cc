#include "test/scenarios/crossing.h"

namespace armloom {
namespace {

FaultRequest fault(const std::string& arm, ArmFault::Kind kind, Duration from,
                   std::optional<Duration> lasting = {}) {
  return {.arm = arm, .kind = kind, .at = at(from), .lasting = lasting, .value = 0.5};
}

class Settled : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { cell.emplace(crossing_description(), GetParam()); }
  void inject(const FaultRequest& request) {
    ASSERT_TRUE(cell->simulation->executive().faults().inject(request));
  }
  // Runs until settled, then 200 s more, longer than any timeout in the cell.
  void expect_nothing_more(TimePoint limit) {
    while (!cell->simulation->settled()) {
      cell->simulation->tick();
      ASSERT_LT(cell->simulation->now(), limit) << "it never settles";
    }
    const std::size_t told = cell->log.events.size();
    const Configuration q = cell->log.last;
    cell->run_until(cell->simulation->now() + 200s);
    EXPECT_EQ(cell->log.events.size(), told);
    EXPECT_EQ(cell->log.last, q);
    EXPECT_TRUE(cell->simulation->settled());
  }
  std::optional<Crossing> cell;
};
INSTANTIATE_TEST_SUITE_P(Policies, Settled, ::testing::ValuesIn(known_policies()));

// x has a fault in the crossing. Then y's job expires, and x's next job waits for a resume.
TEST_P(Settled, AfterAFaultAndAllTimeouts) {
  inject(fault("x", ArmFault::Kind::fault, 1s));
  cell->submit(slide("x", -1, 1, 2, "gives up"));
  cell->submit(slide("x", 1, -1, 2, "comes back"));
  cell->submit(slide("y", -1, 1, 3, "passes"));
  expect_nothing_more(at(100s));
}

TEST_P(Settled, WhileAllArmsAreStopped) {
  cell->submit(slide("x", -1, 1, 2, "one"));
  cell->submit(slide("y", -1, 1, 3, "two"));
  cell->run_until(at(500ms));
  stop_all(cell->simulation->executive(), "operator");
  expect_nothing_more(at(100s));
  EXPECT_FALSE(cell->simulation->executive().all_ended());
  resume_all(cell->simulation->executive());
  cell->run_to_the_end(at(400s));
  EXPECT_EQ(cell->job("one").state, JobState::succeeded);
  // Under `reservation` this job was in the backlog already, and has expired.
  EXPECT_EQ(cell->job("two").state,
            GetParam() == "reservation" ? JobState::expired : JobState::succeeded);
}

TEST_P(Settled, NotDuringAStallThatEnds) {
  inject(fault("x", ArmFault::Kind::stall, 500ms, 5s));
  cell->submit(slide("x", -1, 1, 2, "one"));
  cell->submit(slide("y", -1, 1, 3, "two"));
  while (!cell->simulation->executive().all_ended()) {
    EXPECT_FALSE(cell->simulation->settled()) << to_seconds(cell->simulation->now() - at(0s));
    cell->simulation->tick();
    ASSERT_LT(cell->simulation->now(), at(60s));
  }
  EXPECT_EQ(cell->job("one").state, JobState::succeeded);
  EXPECT_EQ(cell->job("two").state, JobState::succeeded);
}

TEST_P(Settled, NotBeforeASlowMotionOrALateStart) {
  inject(fault("x", ArmFault::Kind::slow, 0s));
  inject(fault("y", ArmFault::Kind::late_start, 0s));
  cell->submit(slide("x", -1, 1, 2, "one"));
  cell->submit(slide("y", -1, 1, 3, "two"));
  const auto monitor_stops = [&] { return cell->simulation->executive().figures().monitor_stops; };
  // timed_discrete promises nothing about late arms: the monitor may stop them until a resume.
  while (!cell->simulation->executive().all_ended()) {
    if (GetParam() == "timed_discrete" && monitor_stops() > 0) return;
    ASSERT_FALSE(cell->simulation->settled()) << to_seconds(cell->simulation->now() - at(0s));
    cell->simulation->tick();
    ASSERT_LT(cell->simulation->now(), at(100s));
  }
}

TEST_P(Settled, EndsASimulationBeforeItsTimeLimit) {
  CellPtr built = build_cell(crossing_description()).value();
  Log log;
  std::vector<TimedJob> jobs;
  jobs.push_back({at(0s), slide("x", -1, 1, 2, "gives up")});
  jobs.push_back({at(5s), slide("x", 1, -1, 2, "comes back")});
  ExecutiveOptions options{.policy = GetParam()};
  const auto result =
      simulate(built, options,
               {std::move(jobs), at(100'000s), {fault("x", ArmFault::Kind::fault, 1s)}}, log);
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->all_ended || result->settled);
  EXPECT_LT(result->ended_at, at(70s));
}

TEST_P(Settled, LongWaitOfABlockedJobIsSkipped) {
  struct Cycles final : Observer {
    void on_event(const Event&) override {}
    void on_state(const StateFrame&) override {}
    void on_tick(TimePoint, const Configuration&) override { ++count; }
    int count = 0;
  } cycles;
  CellDescription description = crossing_description();
  description.scheduling.on_idle_blocker = OnIdleBlocker::report;
  description.scheduling.backlog_timeout = 1'000'000s;
  std::vector<TimedJob> jobs;
  jobs.push_back({at(0s), slide("x", -1, 0, 2, "in the middle")});
  jobs.push_back({at(3s), slide("y", -1, 1, 3, "passes")});
  const auto result = simulate(build_cell(description).value(), {.policy = GetParam()},
                               {std::move(jobs), at(2'000'000s)}, cycles);
  ASSERT_TRUE(result && result->all_ended);
  EXPECT_EQ(result->jobs.back().reason(), Reason::backlog_timeout);
  EXPECT_GE(result->ended_at, at(1'000'000s));
  EXPECT_LT(cycles.count, 20'000);
}

// on_rest(true) must come when all arms have come to rest, and on_rest(false) when an arm starts to
// move. A pause on the path is a rest, too.
TEST_P(Settled, RestsAreReportedAsTheyBeginAndEnd) {
  struct Rests final : Observer {
    void on_event(const Event&) override {}
    void on_state(const StateFrame&) override {}
    void on_rest(bool now_at_rest) override { at_rest = now_at_rest; }
    void on_tick(TimePoint, const Configuration& q) override {
      if (at_rest && was_at_rest) moved_m = std::max(moved_m, (q - last).cwiseAbs().maxCoeff());
      at_rest ? ++rows_at_rest : ++rows_in_motion;
      was_at_rest = at_rest;
      last = q;
    }
    bool at_rest = false, was_at_rest = false;
    int rows_at_rest = 0, rows_in_motion = 0;
    double moved_m = 0.0;
    Configuration last;
  } rests;
  std::vector<TimedJob> jobs;
  jobs.push_back({at(1s), slide("x", -1, 1, 2)});
  jobs.push_back({at(20s), slide("y", -1, 1, 2)});
  const auto result = simulate(build_cell(crossing_description()).value(), {.policy = GetParam()},
                               {std::move(jobs), at(60s)}, rests);
  ASSERT_TRUE(result && result->all_ended);
  EXPECT_EQ(rests.moved_m, 0.0);
  EXPECT_GE(rests.rows_at_rest, 5);
  EXPECT_LT(rests.rows_at_rest, 3'000) << "cycles in which nothing happens are passed over";
  EXPECT_GT(rests.rows_in_motion, 4'000);
  EXPECT_LT(rests.rows_in_motion, 4'800) << "two motions of 2 s, and the controllers' lag";
}

}  // namespace
}  // namespace armloom
