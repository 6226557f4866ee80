// What /check says of a job, and what becomes of the same job when it is submitted in the same
// instant: in the midst of random workloads of discs and of Pandas, under every policy, with stops,
// objects that come and go, `after` and priorities. ARMLOOM_SEEDS=100 looks at more states.
#include <gtest/gtest.h>

#include <deque>
#include <fstream>
#include <iostream>
#include <sstream>

#include "core/executive/known_policies.h"
#include "core/executive/own_checker.h"
#include "core/model/cell/build_cell.h"
#include "core/trajectory/joint_line.h"
#include "server/codec/cell_codec.h"
#include "test/scenarios/chain_workloads.h"
#include "test/scenarios/random_faults.h"
#include "test/scenarios/seeds.h"
#include "test/source_dir.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;

// Judges when it is told to: what a check asks for apart from the rest.
class Judges final : public JudgementService {
 public:
  void ask(Question question, PlanningScenePtr scene, std::function<void(Verdict)> done) override {
    (checking_ ? of_check_ : of_scheduler_)
        .push_back({std::move(question), std::move(scene), std::move(done)});
  }
  bool draw(Drawing, PlanningScenePtr, std::function<void(Diagram)>) override { return false; }
  void plan(PlanTask) override {}
  bool draft(PlanTask) override { return false; }

  // Everything that is asked within `begin`, and what follows from the answers.
  void check(const std::function<void()>& begin) {
    checking_ = true;
    begin();
    while (answer(of_check_)) {
    }
    checking_ = false;
  }
  bool answer_scheduler() { return answer(of_scheduler_); }

 private:
  struct Asked {
    Question question;
    PlanningScenePtr scene;
    std::function<void(Verdict)> done;
  };
  bool answer(std::deque<Asked>& asked) {
    if (asked.empty()) return false;
    const Asked first = std::move(asked.front());
    asked.pop_front();
    first.done(checker_.in(first.scene).judge(first.question));
    return true;
  }

  OwnChecker checker_;
  std::deque<Asked> of_check_, of_scheduler_;
  bool checking_ = false;
};

struct Nobody final : Observer {
  void on_event(const Event&) override {}
  void on_tick(TimePoint, const Configuration&) override {}
  void on_state(const StateFrame&) override {}
};

// A check names no job of the server's own, which does not exist yet.
std::string text(const std::vector<WaitView>& waits) {
  std::string text;
  for (const WaitView& wait : waits) {
    text += std::string(text.empty() ? "" : ", ") + to_string(wait.kind) + " " +
            (wait.job.starts_with("aside-") ? "" : wait.job) + " " + wait.arm;
  }
  return text;
}

struct Seen {
  int states = 0, free_now = 0, free_later = 0, wait = 0, fail = 0, refused = 0;
};

// An executive whose jobs are asked about before they are submitted.
class Asked {
 public:
  Asked(const CellPtr& cell, const std::string& policy, std::uint64_t seed, Seen& seen)
      : random_(seed),
        seen_(seen),
        executive_(std::move(
            *Executive::create(cell, ExecutiveOptions{.policy = policy}, judges_, nobody_))) {
    tick();
  }

  void compare(const JobRequest& request) {
    ++seen_.states;
    std::optional<Result<CheckView>> says;
    judges_.check([&] {
      executive_->check(request, [&](Result<CheckView> view) { says = std::move(view); });
    });
    ASSERT_TRUE(says) << "no answer";
    const auto accepted = executive_->submit(request);
    ASSERT_EQ(says->has_value(), accepted.has_value());
    if (!accepted) {
      ++seen_.refused;
      return;
    }
    const std::string key = accepted->key;
    while (is_open(key) && judges_.answer_scheduler()) {
    }
    compare(**says, *executive_->job(key));
  }

  // Some time, with what disturbs: none at all, a while, or until most is done.
  void go_on() {
    const std::size_t how = random_.index(4);
    const std::size_t ticks = how == 0 ? 0 : how == 1 ? random_.index(2500) : 8000;
    const std::size_t enough = how > 1 ? 1 + random_.index(2) : 0;
    for (std::size_t i = 0; i < ticks; ++i) {
      if (i % 50 == 0 && active() < enough) break;
      tick();
    }
    const std::size_t dice = random_.index(10);
    if (dice == 0) stop_all(*executive_, "operator");
    if (dice > 0 && dice < 6) resume_all(*executive_);
    if (dice == 6 && !has_object_) add_object();
    if (dice > 7 && has_object_) {
      EXPECT_TRUE(executive_->scene().remove("in the way"));
      has_object_ = false;
    }
  }
  Random& random() { return random_; }

 private:
  [[nodiscard]] std::size_t active() const {
    const QueueView queue = executive_->snapshot(0).queue;
    return queue.queued.size() + queue.backlog.size() + queue.scheduled.size() +
           queue.running.size();
  }
  [[nodiscard]] bool is_open(const std::string& key) const {
    const JobState state = executive_->job(key)->state;
    return state == JobState::queued || state == JobState::backlogged;
  }

  void tick() {
    executive_->tick(next_);
    next_ += kControlPeriod;
    if (random_.chance(0.5)) (void)judges_.answer_scheduler();
  }

  void add_object() {
    CollisionObject object{.name = "in the way", .shape = Sphere{0.02}};
    object.X_WO.translation() << random_.uniform(-0.6, 0.6), random_.uniform(-0.6, 0.6), 0.4;
    has_object_ = executive_->scene().add(object).has_value();  // not where an arm is
  }

  void compare(const CheckView& says, const JobView& job) {
    const bool is_free = job.state == JobState::scheduled || job.state == JobState::running;
    const std::string what = told(job) + "; said: " + text(says.waits_on);
    ASSERT_EQ(says.kind == Verdict::Kind::free, is_free) << what;
    if (is_free) {
      const Duration until = *job.times.scheduled_at - executive_->now();
      ASSERT_TRUE(says.earliest_start_s);
      ASSERT_NEAR(*says.earliest_start_s, std::max(0.0, to_seconds(until)), 1e-9) << what;
      ASSERT_EQ(text(says.waits_on), text(job.waits_on)) << what;
      ASSERT_TRUE(says.conflicts.empty()) << what;
      ++(until > Duration{} ? seen_.free_later : seen_.free_now);
    } else if (is_terminal(job.state)) {
      ++seen_.fail;
    } else {
      ++seen_.wait;
      ASSERT_EQ(text(says.waits_on), text(job.waits_on)) << what;
      ASSERT_EQ(says.conflicts.size(), says.waits_on.size()) << what;
    }
  }

  Random random_;
  Seen& seen_;
  Judges judges_;
  Nobody nobody_;
  std::unique_ptr<Executive> executive_;
  TimePoint next_{};
  bool has_object_ = false;
};

class Checks : public ::testing::TestWithParam<std::string> {
 protected:
  void TearDown() override {
    std::cout << GetParam() << ": " << seen.states << " states: free now " << seen.free_now
              << ", later " << seen.free_later << ", waits " << seen.wait << ", fails " << seen.fail
              << ", refused " << seen.refused << "\n";
    EXPECT_GT(8 * (seen.free_now + seen.free_later), seen.states);
    EXPECT_GT(6 * seen.wait, seen.states);
  }
  Seen seen;
};
INSTANTIATE_TEST_SUITE_P(Policies, Checks, ::testing::ValuesIn(known_policies()));

TEST_P(Checks, OfDiscsSayWhatThenHappens) {
  for (std::uint64_t seed = 1; seed <= seed_count(3); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const CrowdedWorkload load = make_chain(2 + seed % 3, 20, seed % 2 == 0, seed);
    CellDescription description = load.cell();
    description.scheduling.on_idle_blocker =
        seed % 4 < 2 ? OnIdleBlocker::park : OnIdleBlocker::report;
    Asked asked(*build_cell(description), GetParam(), seed, seen);
    for (TimedJob& timed : load.jobs()) {
      timed.job.terms.priority = static_cast<int>(asked.random().index(3));
      asked.compare(timed.job);
      if (HasFatalFailure()) return;
      asked.go_on();
    }
  }
}

// Random poses around home, from one to the next.
TEST_P(Checks, OfPandasSayWhatThenHappens) {
  std::ifstream file(source_dir() + "/config/two_pandas.json");
  std::ostringstream text;
  text << file.rdbuf();
  CellDescription description = *read_cell_text(text.str(), source_dir() + "/config");
  description.scheduling.horizon_legs = 1;  // so that some wait
  const CellPtr cell = *build_cell(description);
  for (std::uint64_t seed = 1; seed <= seed_count(1); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Asked asked(cell, GetParam(), seed, seen);
    std::vector<Eigen::VectorXd> stands;
    for (const Arm& arm : cell->arms) stands.push_back(arm.home);
    for (int n = 0; n < 20;) {
      const std::size_t i = asked.random().index(2);
      const Arm& arm = cell->arms[i];
      Eigen::VectorXd to = arm.home;
      for (double& q : to) q += asked.random().uniform(-0.9, 0.9);
      const auto line = joint_line(*cell, arm.joints, stands[i], to);
      if (!line) continue;  // outside of a limit
      ++n;
      JobRequest job{.key = "", .name = "", .trajectory = {}};
      for (const JointId id : arm.joints) {
        job.trajectory.joint_names.push_back(cell->joint(id).name);
      }
      const std::vector<double> rest(arm.joints.size(), 0.0);
      job.trajectory.points = {
          {{stands[i].begin(), stands[i].end()}, rest, rest, 0.0},
          {{to.begin(), to.end()}, rest, rest, 2.0 * to_seconds((*line)->duration())}};
      asked.compare(job);
      if (HasFatalFailure()) return;
      stands[i] = to;
      asked.go_on();
    }
  }
}

}  // namespace
}  // namespace armloom
