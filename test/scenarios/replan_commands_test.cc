// A broken scheduler invariant throws.
#include <map>
#include <random>

#include "test/scenarios/seeds.h"
#include "test/scenarios/two_gantries.h"

namespace armloom {
namespace {

class RandomReplans : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Policies, RandomReplans, ::testing::ValuesIn(known_policies()));

class Client {
 public:
  Client(TwoGantries& cell, std::uint64_t seed) : cell_(cell), random_(seed) {}

  void act() {
    switch (below(9)) {
      case 0:
      case 1:
      case 2:
        return submit();
      case 3:
        if (!keys_.empty()) (void)cell_.executive().cancel(any_job());
        return;
      case 4:
      case 5:
        if (!keys_.empty() && cell_.executive().replan(any_job())) ++replans;
        return;
      case 6:
        return cell_.executive().stop({ArmId{below(2)}}, "operator");
      case 7:
        cell_.executive().resume({ArmId{0}, ArmId{1}});
        return;
      default:
        return change_scene();
    }
  }
  int replans = 0;
  [[nodiscard]] const std::vector<std::string>& keys() const { return keys_; }

 private:
  std::uint32_t below(std::uint32_t count) {
    return std::uniform_int_distribution<std::uint32_t>(0, count - 1)(random_);
  }
  Place_m anywhere() {
    std::uniform_real_distribution<double> at(-1.2, 1.2);
    const double x_m = at(random_);
    return {x_m, at(random_)};
  }
  std::string any_job() { return keys_[below(static_cast<std::uint32_t>(keys_.size()))]; }

  void submit() {
    const std::string arm = below(2) == 0 ? "a" : "b";
    const std::string key = arm + std::to_string(keys_.size());
    JobRequest request = go(arm, anywhere(), anywhere(), 4, key);
    if (below(3) == 0) {
      const Place_m to = anywhere();
      request = JobRequest{.key = key, .name = "", .trajectory = {}};
      request.arm = arm;
      request.move_to =
          PlanGoal{.joints = std::vector{to.first, to.second}, .named = {}, .pose = {}};
    } else {
      request.terms.move_to_start = MoveToStart::plan;
    }
    request.terms.backlog_timeout = 4s;
    if (below(2) == 0) request.terms.on_timeout = OnTimeout::replan;
    if (cell_.executive().submit(std::move(request))) keys_.push_back(key);
  }
  void change_scene() {
    if (std::exchange(has_post_, !has_post_)) {
      (void)cell_.executive().scene().remove("post");
      return;
    }
    CollisionObject post{.name = "post", .shape = Box{{0.1, 0.1, 0.1}}};
    const auto [x_m, y_m] = anywhere();
    post.X_WO.translation() = Eigen::Vector3d(x_m, y_m, 0.0);
    has_post_ = cell_.executive().scene().add(std::move(post)).has_value();
  }

  TwoGantries& cell_;
  std::mt19937_64 random_;
  std::vector<std::string> keys_;
  bool has_post_ = false;
};

TEST_P(RandomReplans, EveryJobEndsOnceAndNothingTouches) {
  int replans = 0, succeeded = 0;
  for (std::uint64_t seed = 1; seed <= seed_count(4); ++seed) {
    SCOPED_TRACE(seed);
    const auto how = seed % 2 == 0 ? OnIdleBlocker::replan : OnIdleBlocker::park;
    TwoGantries cell(gantries(how), GetParam());
    Client client(cell, seed);
    for (int i = 1; i <= 60; ++i) {
      client.act();
      cell.run_until(at(i * 700ms));
    }
    cell.executive().resume({ArmId{0}, ArmId{1}});
    cell.run_to_the_end(at(600s));
    if (GetParam() != "timed_discrete") {  // timed_discrete promises nothing about stopped arms
      EXPECT_GT(cell.closest_m(), 0.019);
    }
    replans += client.replans;
    for (const std::string& key : client.keys()) {
      succeeded += cell.job(key).state == JobState::succeeded ? 1 : 0;
    }
    std::map<std::string, int> ends;
    for (const Event& event : cell.events()) {
      const auto* job = std::get_if<JobView>(&event.body);
      if (job != nullptr && is_terminal(job->state)) ++ends[job->key];
    }
    for (const auto& [key, times] : ends) EXPECT_EQ(times, 1) << key;
  }
  EXPECT_GT(replans, 5) << "replans";
  EXPECT_GT(succeeded, 5) << "succeeded";
}

}  // namespace
}  // namespace armloom
