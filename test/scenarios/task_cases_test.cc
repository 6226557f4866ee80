// Jobs with steps: motions, and actions between them.
#include <gmock/gmock.h>

#include <atomic>
#include <map>
#include <memory>

#include "test/scenarios/tasks.h"

namespace armloom {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Task, PicksAndPlaces) {
  Tasks cell;
  const JobView accepted =
      cell.submit(task("pick", {slide_to("x", 0.0), attach("x_ball"), slide_to("x", 0.5), detach(),
                                slide_to("x", -1.0)}));
  EXPECT_EQ(accepted.steps.size(), 5U);
  EXPECT_EQ(accepted.step, 0U);
  cell.run_to_the_end();
  const JobView job = cell.job("pick");
  EXPECT_EQ(job.state, JobState::succeeded) << job.detail();
  EXPECT_NEAR(cell.x_of_part(), 0.63, 1e-3);
  EXPECT_NEAR(cell.log.last[0], -1.0, 1e-3);
  EXPECT_TRUE(cell.scene().scene()->touch().empty()) << "the hand may touch it no more";
  for (const StepView& step : job.steps) EXPECT_EQ(step.state, StepState::done);
}

TEST(Task, IsOneJobForClients) {
  Tasks cell;
  cell.submit(task("pick", {slide_to("x", -0.5), set("valve", true), slide_to("x", -0.8)}));
  cell.submit(slide("x", -0.8, -1.0, 1.0, "behind"));
  cell.run_to_the_end();
  std::map<std::string, std::vector<JobState>> states;
  for (const Event& event : cell.log.events) {
    if (const auto* job = std::get_if<JobView>(&event.body)) states[job->key].push_back(job->state);
  }
  EXPECT_EQ(states.size(), 2U);
  EXPECT_EQ(std::ranges::count_if(states["pick"], is_terminal), 1) << "ends once";
  EXPECT_EQ(cell.job("behind").state, JobState::succeeded);
  EXPECT_GT(*cell.job("behind").times.started_at, *cell.job("pick").times.ended_at - 1ms);
}

TEST(Task, TellsWhatMayTouch) {
  Tasks cell;
  cell.submit(task("pick", {slide_to("x", 0.0), attach("x_ball", {"y_ball"}), slide_to("x", 0.4),
                            slide_to("x", 0.5), detach(), slide_to("x", -1.0)}));
  cell.run_to_the_end();
  std::vector<std::string> told;
  for (const Event& event : cell.log.events) {
    const auto* scene = std::get_if<SceneView>(&event.body);
    if (scene == nullptr) continue;
    std::string text;
    for (const HeldView& held : scene->held) {
      text += held.link + " holds " + held.object.name + ":";
      for (const std::string& name : held.touch) text += " " + name;
    }
    for (const TouchView& touch : scene->touch) {
      text += touch.object + ":";
      for (const std::string& name : touch.links) text += " " + name;
    }
    if (told.empty() || told.back() != text) told.push_back(text);
  }
  EXPECT_THAT(told, ElementsAre("", "part: x_ball y_ball", "x_ball holds part: y_ball",
                                "x_ball holds part:", "part: x_ball", ""));
}

// T8: the bare arms would pass each other; the held part would touch.
TEST(Task, ChecksWhatTheArmHolds) {
  for (const bool holds : {true, false}) {
    Tasks cell;
    std::vector<StepRequest> steps{slide_to("x", 0.0)};
    if (!holds) {
      ASSERT_TRUE(cell.scene().remove("part"));
    }
    if (holds) steps.push_back(attach("x_ball"));
    steps.push_back(slide_to("x", -0.28));  // the part then ends at -0.15, in the way of ball y
    cell.submit(task("pick", steps));
    while (!cell.executive().all_ended()) cell.simulation->tick();
    ASSERT_EQ(cell.job("pick").state, JobState::succeeded);
    cell.submit(slide("y", -1.0, 1.0, 2.0, "crosses"));
    cell.run_until(cell.simulation->now() + 5s);
    EXPECT_EQ(cell.job("crosses").state, holds ? JobState::backlogged : JobState::succeeded);
  }
}

TEST(Task, HandsOver) {
  Tasks cell;
  // With x at -0.26, the part touches ball y at 0. Both hold still while it changes hands.
  cell.submit(task("hand over", {slide_to("x", 0.0), attach("x_ball"), slide_to("x", -0.26),
                                 slide_to("y", 0.0), attach("y_ball"), slide_to("x", -1.0),
                                 slide_to("y", 0.8), detach(), slide_to("y", -1.0)}));
  cell.run_to_the_end();
  const JobView job = cell.job("hand over");
  EXPECT_EQ(job.state, JobState::succeeded) << job.detail();
  EXPECT_EQ(job.arms, (std::vector<std::string>{"x", "y"}));
  EXPECT_NEAR(cell.x_of_part(), -0.13, 1e-3);
}

TEST(Task, FailsAtAKnownStep) {
  Tasks cell;
  cell.submit(task("pick", {slide_to("x", -0.5), attach("x_ball"), slide_to("x", 0.5)}));
  cell.submit(move_to("x", -1.0, "next"));
  cell.run_to_the_end();
  const JobView job = cell.job("pick");
  EXPECT_EQ(job.state, JobState::failed);
  EXPECT_EQ(job.reason(), Reason::step_failed);
  ASSERT_TRUE(job.result->step);
  EXPECT_EQ(*job.result->step, 1U);
  EXPECT_THAT(job.detail(), HasSubstr("or more from x_ball"));
  EXPECT_EQ(job.steps[2].state, StepState::waiting);
  EXPECT_EQ(cell.job("next").state, JobState::succeeded);
  EXPECT_NEAR(cell.x_of_part(), 0.13, 1e-9);
}

TEST(Task, SetsOutputsAndWaitsForInputs) {
  Tasks cell;
  auto request = task("io", {set("valve", true),
                             slide_to("x", -0.5),
                             {"", WaitIoRequest{"ready", true}},
                             slide_to("x", -1.0),
                             set("valve", false)});
  std::get<MotionStepRequest>(request.steps[1].what).triggers = {
      {0.5, "counter", std::uint16_t{7}}};
  cell.submit(request);
  EXPECT_EQ(cell.signal("valve"), SignalValue(true)) << "the first step is an action";
  EXPECT_EQ(cell.signal("counter"), SignalValue(std::uint16_t{0}));
  cell.run_until(at(5s));
  EXPECT_EQ(cell.signal("counter"), SignalValue(std::uint16_t{7}));
  EXPECT_EQ(cell.job("io").state, JobState::paused);
  EXPECT_EQ(cell.job("io").step, 2U);
  ASSERT_EQ(cell.job("io").waits_on.size(), 1U);
  EXPECT_EQ(cell.job("io").waits_on[0].kind, Wait::Kind::io);
  EXPECT_EQ(cell.job("io").waits_on[0].job, "ready");
  EXPECT_TRUE(cell.executive().signals().set("ready", true));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("io").state, JobState::succeeded);
  EXPECT_EQ(cell.signal("valve"), SignalValue(false));
}

TEST(Task, FailsWhenAnInputComesTooLate) {
  Tasks cell;
  cell.submit(task(
      "io", {slide_to("x", -0.5), {"", WaitIoRequest{"ready", true, 2s}}, slide_to("x", -1.0)}));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("io").state, JobState::failed);
  EXPECT_THAT(cell.job("io").detail(), HasSubstr("ready was not true within 2 s"));
  EXPECT_NEAR(cell.log.last[0], -0.5, 1e-3);
}

TEST(Task, DoesNothingWhileItsArmIsStopped) {
  Tasks cell;
  cell.submit(task(
      "io", {slide_to("x", -0.5), {"", WaitRequest{1s}}, set("valve", true), slide_to("x", -1.0)}));
  while (cell.job("io").step == 0U) cell.simulation->tick();
  cell.executive().stop({ArmId{0}}, "test");
  cell.run_until(cell.simulation->now() + 3s);
  EXPECT_EQ(cell.signal("valve"), SignalValue(false));
  ASSERT_EQ(cell.job("io").waits_on.size(), 1U);
  EXPECT_EQ(cell.job("io").waits_on[0].kind, Wait::Kind::stop);
  (void)cell.executive().resume({ArmId{0}});
  cell.run_to_the_end();
  EXPECT_EQ(cell.signal("valve"), SignalValue(true));
  EXPECT_EQ(cell.job("io").state, JobState::succeeded);
}

TEST(Task, IsCanceledBetweenItsMotions) {
  Tasks cell;
  cell.submit(
      task("io", {slide_to("x", -0.5), {"", WaitIoRequest{"ready", true}}, slide_to("x", -1.0)}));
  cell.submit(move_to("x", -0.9, "next"));
  cell.run_until(at(5s));
  ASSERT_TRUE(cell.executive().cancel("io"));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("io").state, JobState::canceled);
  EXPECT_EQ(cell.job("next").state, JobState::succeeded);
}

TEST(Task, RefusesWhatCannotBeDone) {
  struct Case {
    std::vector<StepRequest> steps;
    const char* slug;
    const char* pointer;
  };
  const std::vector<Case> cases{
      {{slide_to("x", 0.0), {"", AttachRequest{"nothing", "x_ball"}}, slide_to("x", 0.5)},
       "unknown-object",
       "/steps/1/attach/object"},
      {{slide_to("x", 0.0), attach("no_link"), slide_to("x", 0.5)},
       "unknown-link",
       "/steps/1/attach/link"},
      {{slide_to("x", 0.0), attach("x_ball", {"no_body"}), slide_to("x", 0.5)},
       "unknown-name",
       "/steps/1/attach/touch/0"},
      {{slide_to("x", 0.0), detach(), slide_to("x", 0.5)}, "not-held", "/steps/1/detach/object"},
      {{slide_to("x", 0.0), attach("x_ball"), attach("x_ball"), slide_to("x", 0.5)},
       "held-twice",
       "/steps/2/attach/object"},
      {{slide_to("x", 0.0), attach("x_ball")}, "no-motion-after", "/steps/1/attach/link"},
      {{slide_to("x", 0.0), attach("x_ball"), slide_to("y", 0.5)},
       "no-motion-after",
       "/steps/1/attach/link"},
      {{set("valve", true)}, "no-motion", "/steps"},
      {{slide_to("x", 0.0), {"", WaitRequest{1s}}}, "ends-with-wait", "/steps/1"},
      {{slide_to("x", 0.0), set("no_signal", true)}, "unknown-signal", "/steps/1/set_io/name"},
      {{slide_to("x", 0.0), set("valve", std::uint16_t{3})}, "wrong-type", "/steps/1/set_io/value"},
      {{slide_to("x", 9.0)}, "limit-exceeded", "/steps/0/move_to/joints/0"},
      {{{"", GripperStepRequest{"x", 0.1}}}, "no-width", "/steps/0/gripper/width_m"},
  };
  for (const Case& one : cases) {
    Tasks cell;
    const auto answer = cell.executive().submit(task("bad", one.steps));
    ASSERT_FALSE(answer) << one.slug;
    EXPECT_EQ(answer.error().front().slug, one.slug);
    EXPECT_EQ(answer.error().front().pointer, one.pointer) << one.slug;
    EXPECT_TRUE(cell.executive().all_ended());
    std::vector<Problems> others;  // of questions about the same job
    const auto keep = [&](const auto& result) {
      ASSERT_FALSE(result) << one.slug;
      others.push_back(result.error());
    };
    cell.executive().inquiries().check(task("bad", one.steps), keep);
    cell.executive().inquiries().plan(StepsInquiry{task("bad", one.steps)},
                                      std::make_shared<std::atomic<bool>>(false), keep);
    ASSERT_EQ(others.size(), 2U);
    for (const Problems& problems : others) {
      ASSERT_EQ(problems.size(), answer.error().size());
      EXPECT_EQ(problems.front().slug, one.slug);
      EXPECT_EQ(problems.front().pointer, one.pointer);
      EXPECT_EQ(problems.front().detail, answer.error().front().detail);
    }
  }
}

// The first action waits until it is on disk that the job has begun.
TEST(Task, ActsOnlyWhenItsStartIsStored) {
  struct SlowLog final : StartLog {
    void about_to_move(JobId, std::function<void()> done) override { written = std::move(done); }
    void has_moved(JobId, const HeldView&, std::function<void()> done) override { done(); }
    std::function<void()> written;
  } starts;
  Log log;
  auto created = Simulation::create(
      *build_cell(with_io()), ExecutiveOptions{.policy = "certified", .starts = &starts}, log);
  ASSERT_TRUE(created);
  Simulation& simulation = **created;
  simulation.tick();
  ASSERT_TRUE(simulation.executive().submit(task("io", {set("valve", true), slide_to("x", -0.5)})));
  simulation.run_until(at(1s));
  EXPECT_EQ(simulation.executive().signals().views()[0].value, SignalValue(false));
  EXPECT_DOUBLE_EQ(log.last[0], -1.0);
  ASSERT_TRUE(starts.written);
  starts.written();
  simulation.run_until(at(5s));
  EXPECT_EQ(simulation.executive().signals().views()[0].value, SignalValue(true));
  EXPECT_EQ(simulation.executive().job("io")->state, JobState::succeeded);
}

TEST(Task, IsInterruptedAtItsStep) {
  Tasks cell;
  cell.submit(
      task("io", {slide_to("x", -0.5), {"", WaitIoRequest{"ready", true}}, slide_to("x", -1.0)}));
  cell.submit(task("waits", {slide_to("x", -0.5), set("valve", true)}));
  cell.run_until(at(5s));
  bool done = false;
  cell.executive().wind_down("the server ends", Executive::Waiting::is_kept, [&] { done = true; });
  cell.run_until(cell.simulation->now() + 1s);
  ASSERT_TRUE(done);
  EXPECT_EQ(cell.job("io").state, JobState::interrupted);
  EXPECT_EQ(cell.job("io").result->step, 1U);
  EXPECT_FALSE(is_terminal(cell.job("waits").state));
}

}  // namespace
}  // namespace armloom
