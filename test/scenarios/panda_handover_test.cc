// Two Pandas hand a bar over. Both hold it for a while, and carry it together.
#include <gmock/gmock.h>

#include <Eigen/LU>
#include <numbers>

#include "core/executive/holding.h"
#include "core/executive/live_scene.h"
#include "core/executive/simulation.h"
#include "core/model/cell/build_cell.h"
#include "core/model/kinematics.h"
#include "core/model/xml/text_file.h"
#include "core/trajectory/set_joints.h"
#include "server/codec/cell_codec.h"
#include "server/messages/job_request.h"
#include "test/source_dir.h"

namespace armloom {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
constexpr double kLift_m = 0.08;
constexpr double kLift_s = 4.0;

struct Quiet final : Observer {
  void on_event(const Event&) override {}
  void on_state(const StateFrame&) override {}
  void on_tick(TimePoint, const Configuration& measured) override { q = measured; }
  Configuration q;
};

template <class T>
T value_of(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().front().detail);
  return *std::move(result);
}

std::string text_of_config(const char* file) {
  return value_of(read_text_file(source_dir() + "/config/" + file, "/", "file"));
}

struct Handover : ::testing::Test {
  Handover() {
    const std::string folder = source_dir() + "/config";
    cell = value_of(
        build_cell(value_of(read_cell_text(text_of_config("pick_and_place.json"), folder))));
    simulation =
        value_of(Simulation::create(cell, ExecutiveOptions{.policy = "earliest_start"}, seen));
    simulation->tick();
    for (const TimedJob& timed :
         value_of(read_jobs_text(text_of_config("pick_and_place_jobs.json")))) {
      if (timed.job.key == "hand-over-there") steps = timed.job.steps;
    }
  }
  Executive& executive() { return simulation->executive(); }
  void run(std::string key, std::vector<StepRequest> of) {
    JobRequest request{.key = key, .name = "", .trajectory = {}};
    request.steps = std::move(of);
    (void)value_of(executive().submit(std::move(request)));
    simulation->run_until(simulation->now() + std::chrono::minutes(2));
    const JobView job = *executive().job(key);
    ASSERT_EQ(job.state, JobState::succeeded) << job.detail();
  }
  // Returns the step of this name.
  [[nodiscard]] std::size_t at(const std::string& name) const {
    const auto step = std::ranges::find(steps, name, &StepRequest::name);
    return static_cast<std::size_t>(step - steps.begin());
  }
  [[nodiscard]] Eigen::Isometry3d hand(const char* link, const Configuration& q) const {
    LinkPoses X_WL;
    forward_kinematics(*cell, q, X_WL);
    return X_WL[cell->find_link(link)->index()];
  }
  [[nodiscard]] std::vector<JointId> joints(std::size_t arm) const {
    return cell->arms[arm].joints;
  }

  // Returns the left arm's joints with its hand moved by `by_m` without turning: Newton's method.
  [[nodiscard]] Eigen::VectorXd moved(const Configuration& from,
                                      const Eigen::Vector3d& by_m) const {
    Configuration q = from;
    Eigen::Isometry3d goal = hand("left_panda_hand", from);
    goal.pretranslate(by_m);
    const auto off = [&](const Configuration& at) {
      const Eigen::Isometry3d X = hand("left_panda_hand", at);
      const Eigen::AngleAxisd turn(goal.linear() * X.linear().transpose());
      Vector6 e;
      e << goal.translation() - X.translation(), turn.angle() * turn.axis();
      return e;
    };
    for (int i = 0; i < 30; ++i) {
      Eigen::Matrix<double, 6, 7> J;
      const Vector6 e = off(q);
      for (int j = 0; j < 7; ++j) {
        constexpr double kStep = 1e-6;
        Configuration next = q;
        next[joints(0)[static_cast<std::size_t>(j)].value()] += kStep;
        J.col(j) = (e - off(next)) / kStep;
      }
      const Eigen::VectorXd step = J.transpose() * (J * J.transpose()).inverse() * e;
      set_joints(q, joints(0), joints_of(q, joints(0)) + step);
    }
    return joints_of(q, joints(0));
  }
  // Returns the right arm's joints that mirror those of the left arm. The fingers of the right hand
  // are turned by a quarter.
  [[nodiscard]] static Eigen::VectorXd mirrored(Eigen::VectorXd q) {
    for (const Eigen::Index j : {0, 2, 4, 6}) q[j] = -q[j];
    q[6] += q[6] > 0.0 ? -std::numbers::pi / 2 : std::numbers::pi / 2;
    return q;
  }
  [[nodiscard]] StepRequest move(const char* arm, const Eigen::VectorXd& q) const {
    MotionStepRequest motion{.trajectory = {}, .arm = arm};
    motion.move_to = PlanGoal{.joints = std::vector(q.begin(), q.end()), .named = {}, .pose = {}};
    return {"", motion};
  }
  // Both hands go up together. Between rests, by a polynomial of the fifth degree.
  [[nodiscard]] StepRequest lift(const Configuration& from) const {
    constexpr int kPoints = 40;
    MotionStepRequest motion;
    for (const std::size_t arm : {0, 1}) {
      for (const JointId joint : joints(arm)) {
        motion.trajectory.joint_names.push_back(cell->joint(joint).name);
      }
    }
    const auto at = [&](double s) {
      s = std::clamp(s, 0.0, 1.0);
      const double height = kLift_m * s * s * s * (10.0 + s * (-15.0 + 6.0 * s));
      const Eigen::VectorXd left = moved(from, {0.0, 0.0, height});
      Eigen::VectorXd both(14);
      both << left, mirrored(left);
      return both;
    };
    constexpr double kStep = 1e-4;
    for (int i = 0; i <= kPoints; ++i) {
      const double s = static_cast<double>(i) / kPoints;
      const bool rests = i == 0 || i == kPoints;
      const Eigen::VectorXd q = at(s);
      Eigen::VectorXd v = (at(s + kStep) - at(s - kStep)) / (2 * kStep * kLift_s);
      if (rests) v.setZero();
      motion.trajectory.points.push_back(
          {{q.begin(), q.end()}, {v.begin(), v.end()}, {}, s * kLift_s});
    }
    return {"lift together", motion};
  }

  CellPtr cell;
  Quiet seen;
  std::unique_ptr<Simulation> simulation;
  std::vector<StepRequest> steps;
};

TEST_F(Handover, BothHandsHoldTheBarAndCarryItTogether) {
  const auto first = steps.begin();
  run("offer", {first, first + static_cast<std::ptrdiff_t>(at("offer")) + 1});
  const Configuration offered = seen.q;
  const auto beside = [&](double up_m) { return moved(offered, {-0.05, 0.0, up_m}); };
  const std::vector<StepRequest> meet{
      {"", GripperStepRequest{"right", 0.07}},
      move("right", mirrored(beside(0.0))),
      move("right", mirrored(joints_of(offered, joints(0)))),
      {"", GripperStepRequest{"right", 0.03}},
      {"", AttachRequest{"bar", "right_panda_hand", {}, true}},
      lift(offered),
      {"", DetachRequest{"bar", {}, "left_panda_hand"}},
      {"", GripperStepRequest{"left", 0.07}},
      move("left", beside(kLift_m)),
  };
  std::vector<StepRequest> all = meet;
  all.insert(all.end(), first + static_cast<std::ptrdiff_t>(at("above the place")), steps.end());

  JobRequest request{.key = "over", .name = "", .trajectory = {}};
  request.steps = all;
  (void)value_of(executive().submit(std::move(request)));
  std::optional<Eigen::Isometry3d> X_LR;  // of the hands, when both hold the bar
  double apart_m = 0.0, lifted_m = 0.0;
  while (!executive().all_ended() && simulation->now() < armloom::at(std::chrono::minutes(4))) {
    simulation->tick();
    if (hands_at(*executive().scene().scene(), "bar").size() < 2) continue;
    const Eigen::Isometry3d X_WL = hand("left_panda_hand", seen.q);
    const Eigen::Isometry3d X = X_WL.inverse() * hand("right_panda_hand", seen.q);
    if (!X_LR) X_LR = X;
    apart_m = std::max(apart_m, (X.translation() - X_LR->translation()).norm());
    lifted_m = X_WL.translation().z() - hand("left_panda_hand", offered).translation().z();
  }
  const JobView job = *executive().job("over");
  EXPECT_EQ(job.state, JobState::succeeded) << job.detail();
  EXPECT_NEAR(lifted_m, kLift_m, 1e-3);
  EXPECT_LT(apart_m, 1e-3);
  for (const CollisionObject& object : executive().scene().objects()) {
    if (object.name != "bar") continue;
    EXPECT_NEAR((object.X_WO.translation() - Eigen::Vector3d(0.15, 0.4, 0.181)).norm(), 0.0, 3e-3);
    return;
  }
  FAIL() << "the bar is not placed";
}

// The left arm puts its part where the right arm begins, and stays there. Where the later motions
// of `a` end is not known before it holds the part. Its motion to that place seemed to block `b`,
// so that it waited for `b`, which comes after it.
TEST_F(Handover, AJobDoesNotGiveWayToOneThatComesAfterIt) {
  const auto to = [](const std::string& arm, const char* xyz) {
    return R"({"arm": ")" + arm + R"(", "move_to": {"pose": {"link": ")" + arm +
           R"(_panda_hand", "rpy": [3.14159265, 0, 0], "xyz": )" + xyz + "}}}";
  };
  const auto open = [](const char* width_m) {
    return std::string(R"({"gripper": {"arm": "left", "width_m": )") + width_m + "}}";
  };
  const std::string above_part = to("left", "[-0.1, -0.35, 0.384]");
  const std::string above_place = to("left", "[-0.1, 0.05, 0.384]");
  const std::string part = R"("object": "left_part", "touch": ["table"])";
  const std::string a = above_part + ", " + open("0.07") + ", " +
                        to("left", "[-0.1, -0.35, 0.254]") + ", " + open("0.04") +
                        R"(, {"attach": {"link": "left_panda_hand", )" + part + "}}, " +
                        above_part + ", " + above_place + ", " + to("left", "[-0.1, 0.05, 0.254]") +
                        R"(, {"detach": {)" + part + "}}, " + open("0.07") + ", " + above_place;
  const std::string jobs = R"([{"at": 0, "job": {"id": "a", "steps": [)" + a +
                           R"(]}}, {"at": 0, "job": {"id": "b", "after": ["a"], "steps": [)" +
                           to("right", "[-0.1, 0.05, 0.384]") + "]}}]";
  for (TimedJob& timed : value_of(read_jobs_text(jobs))) {
    (void)value_of(executive().submit(std::move(timed.job)));
  }
  simulation->run_until(simulation->now() + std::chrono::minutes(2));
  for (const char* key : {"a", "b"}) {
    const JobView job = *executive().job(key);
    EXPECT_EQ(job.state, JobState::succeeded) << key << ": " << job.detail();
  }
}

}  // namespace
}  // namespace armloom
