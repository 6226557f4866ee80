#include <gtest/gtest.h>

#include "core/executive/own_checker.h"
#include "test/scenarios/crossing.h"

namespace armloom {
namespace {

// Answers a check when the test calls answer().
class HeldChecks final : public JudgementService {
 public:
  void ask(Question question, PlanningScenePtr scene, std::function<void(Verdict)> done) override {
    asked = std::move(question);
    scene_ = std::move(scene);
    done_ = std::move(done);
  }
  void interrupt() override { interrupted = true; }
  [[nodiscard]] std::optional<double> progress() const override { return 0.25; }
  bool draw(Drawing, PlanningScenePtr, std::function<void(Diagram)>) override { return false; }
  void plan(PlanTask) override {}
  bool draft(PlanTask) override { return false; }

  void answer() {
    const Question question = *std::exchange(asked, std::nullopt);
    MotionChecker& checker = checker_.in(scene_);
    const bool is_void = std::exchange(interrupted, false);
    std::exchange(done_,
                  nullptr)(is_void ? checker.interrupted(question) : checker.judge(question));
  }

  std::optional<Question> asked;
  bool interrupted = false;

 private:
  PlanningScenePtr scene_;
  std::function<void(Verdict)> done_;
  OwnChecker checker_;
};

class JobCheckProgress : public ::testing::Test {
 protected:
  JobCheckProgress()
      : executive_(std::move(*Executive::create(*build_cell(crossing_description()),
                                                {.policy = "earliest_start"}, checks_, log_))) {
    executive_->tick(TimePoint{});
  }

  Log log_;
  HeldChecks checks_;
  std::unique_ptr<Executive> executive_;
};

TEST_F(JobCheckProgress, IsReportedWhileTheJobIsChecked) {
  ASSERT_TRUE(executive_->submit(slide("x", -1, 1, 2, "one")));
  ASSERT_TRUE(checks_.asked);
  const JobView checked = *executive_->job("one");
  ASSERT_FALSE(checked.waits_on.empty());
  EXPECT_EQ(checked.waits_on.back().kind, Wait::Kind::check);
  EXPECT_EQ(checked.waits_on.back().progress, 0.25);
  checks_.answer();
  EXPECT_TRUE(executive_->job("one")->waits_on.empty());
}

TEST_F(JobCheckProgress, InterruptedCheckDecidesNothingAndTheNextJobIsChecked) {
  ASSERT_TRUE(executive_->submit(slide("x", -1, 1, 2, "one")));
  ASSERT_TRUE(executive_->submit(slide("y", -1, 1, 2, "two")));
  EXPECT_FALSE(checks_.interrupted);
  ASSERT_TRUE(executive_->cancel("one"));
  EXPECT_TRUE(checks_.interrupted);
  checks_.answer();
  ASSERT_TRUE(checks_.asked);
  EXPECT_EQ(checks_.asked->candidates.front().step.job, executive_->job("two")->id);
  checks_.answer();
  EXPECT_NE(executive_->job("two")->state, JobState::queued);
}

}  // namespace
}  // namespace armloom
