// Trajectories as tools write them, pasted into POST /check.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "server/codec/yaml_text.h"
#include "test/server/panda_jobs.h"
#include "test/server/running_server.h"

namespace armloom {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

struct Pasted {
  const char* name;
  std::function<std::string()> body;
  int status;
  const char* pointer = "";
  const char* says = "";
  const char* content_type = "application/json";
};
void PrintTo(const Pasted& pasted, std::ostream* out) { *out << pasted.name; }

json trajectory() { return test::move("left", test::kHome, test::kMiddle)["trajectory"]; }

// Returns a job with these changes (JSON merge patch).
std::function<std::string()> with(const char* patch) {
  return [=] {
    json body{{"trajectory", trajectory()}};
    body.merge_patch(json::parse(patch));
    return body.dump();
  };
}

// Returns the trajectory inside `wrapper`, at the pointer `at`.
std::function<std::string()> wrapped(const char* wrapper, const char* at) {
  return [=] {
    json body = json::parse(wrapper);
    body[json::json_pointer(at)] = trajectory();
    return body.dump();
  };
}

std::string with_fingers_alone() {
  return R"({"trajectory": {"joint_names": ["left_panda_finger_joint1"], "points": [
    {"positions": [0], "velocities": [0], "time_from_start": 0},
    {"positions": [0.03], "velocities": [0], "time_from_start": 1}]}})";
}

// As `ros2 topic echo` prints a message.
std::string as_echoed() {
  std::string text =
      "header:\n  stamp:\n    sec: 0\n    nanosec: 0\n  frame_id: ''\njoint_names:\n";
  const json whole = trajectory();
  for (const auto& name : whole["joint_names"]) text += "- " + name.get<std::string>() + "\n";
  text += "points:\n";
  for (const auto& point : whole["points"]) {
    const char* lead = "- ";
    for (const char* member : {"positions", "velocities", "accelerations"}) {
      text += std::string(lead) + member + ":\n";
      lead = "  ";
      for (const auto& value : point[member]) text += "  - " + value.dump() + "\n";
    }
    const double time_s = point["time_from_start"];
    text += "  effort: []\n  time_from_start:\n    sec: " + std::to_string(int(time_s)) +
            "\n    nanosec: " + std::to_string(std::lround((time_s - int(time_s)) * 1e9)) + "\n";
  }
  return text + "---\n";
}

std::string shortened() { return "joint_names:\n- left_panda_joint1\n- '...'\npoints: []\n---\n"; }

class PastedTrajectory : public test::RunningServer,
                         public ::testing::WithParamInterface<Pasted> {};

TEST_P(PastedTrajectory, IsReadOrRefusedWithARemedy) {
  start(10.0);
  const auto answer = post("/api/v1/check", GetParam().body(), GetParam().content_type);
  EXPECT_EQ(answer.status, GetParam().status) << answer.body;
  if (GetParam().status == 200) return;
  EXPECT_EQ(answer.json()["pointer"], GetParam().pointer) << answer.body;
  EXPECT_THAT(answer.json()["detail"].get<std::string>(), HasSubstr(GetParam().says));
}

constexpr const char* kYaml = "application/yaml";

INSTANTIATE_TEST_SUITE_P(
    Table, PastedTrajectory,
    ::testing::Values(
        Pasted{"Bare", [] { return trajectory().dump(); }, 200},
        Pasted{"BareRobotTrajectory",
               wrapped(R"({"multi_dof_joint_trajectory": {"joint_names": [], "points": []}})",
                       "/joint_trajectory"),
               200},
        Pasted{"DisplayTrajectory",
               wrapped(R"({"model_id": "panda", "trajectory": [{}], "trajectory_start": {}})",
                       "/trajectory/0/joint_trajectory"),
               200},
        Pasted{"TwoTrajectories",
               [] {
                 return json{{"trajectory", {{}, {}}}}.dump();
               },
               422, "/trajectory", "POST /batches"},
        Pasted{"ActionGoal",
               wrapped(R"({"goal_id": {"stamp": 0, "id": ""}, "goal": {}})", "/goal/trajectory"),
               200},
        Pasted{"RosbridgeGoal",
               wrapped(R"({"op": "send_action_goal", "id": "g1", "action": "/left/follow",
                           "action_type": "control_msgs/action/FollowJointTrajectory"})",
                       "/args/trajectory"),
               200},
        Pasted{"PlaceInAnActionGoal",
               [] {
                 json goal = trajectory();
                 for (json& point : goal["points"]) point["positions"][0] = 1.0;
                 return json{{"goal", {{"trajectory", goal}}}}.dump();
               },
               422, "/goal/trajectory/points/0/positions/0", "will be at 0 rad"},
        Pasted{"StartElsewhereThatIsAlsoTooFast",
               with(R"({"trajectory": {"joint_names": ["left_panda_joint1", "left_panda_joint2",
                 "left_panda_joint3", "left_panda_joint4", "left_panda_joint5", "left_panda_joint6",
                 "left_panda_joint7"], "points": [
                 {"positions": [1, -1.2, 0, -2.6, 0, 1.6, 0.785], "time_from_start": 0},
                 {"positions": [0, -1.2, 0, -2.6, 0, 1.6, 0.785], "time_from_start": 0.1}]}})"),
               422, "/trajectory/points/0/positions/0", "move_to_start"},
        Pasted{"GripperElsewhere",
               [] {
                 json body = json::parse(with_fingers_alone());
                 body["trajectory"]["points"][0]["positions"][0] = 0.02;
                 body["move_to_start"] = "plan";
                 return body.dump();
               },
               422, "/trajectory/points/0/positions/0", "move the gripper there first"},
        Pasted{"SubTrajectoryOfATask",
               wrapped(R"({"info": {}, "execution_info": {}, "scene_diff": {}})", "/trajectory"),
               422, "/scene_diff", "leave this out"},
        Pasted{"ActionGoalOfRos2",
               wrapped(R"({"goal_id": {"uuid": [1, 2]}, "goal": {}})", "/goal/trajectory"), 200},
        Pasted{"NoTolerance", with(R"({"goal_tolerance": [{"name": "a", "position": 0}],
                                       "goal_time_tolerance": {"sec": 0, "nanosec": 0}})"),
               200},
        Pasted{"Tolerance", with(R"({"path_tolerance": [{"name": "a", "position": 0.01}]})"), 422,
               "/path_tolerance/0/position", "leave it out"},
        Pasted{"TimeTolerance", with(R"({"goal_time_tolerance": {"sec": 1, "nanosec": 0}})"), 422,
               "/goal_time_tolerance", "leave it out"},
        Pasted{"StampZero", with(R"({"trajectory": {"header": {"stamp": {"sec": 0, "nanosec": 0},
                                     "frame_id": "world"}}})"),
               200},
        Pasted{"Stamp", with(R"({"trajectory": {"header": {"stamp": {"sec": 9, "nanosec": 0}}}})"),
               422, "/trajectory/header/stamp", "give the stamp 0"},
        Pasted{"TaskSolution", [] { return std::string(R"({"sub_trajectory": []})"); }, 422,
               "/sub_trajectory", "POST /batches"},
        Pasted{"FingersAlone", with_fingers_alone, 200},
        Pasted{"FingersByName",
               [] {
                 return std::string(
                     R"({"arm": "left", "move_to": {"joints": {"panda_finger_joint1": 0.03}}})");
               },
               200},
        Pasted{"NoFinger",
               [] {
                 return std::string(
                     R"({"arm": "left", "move_to": {"joints": {"left_panda_joint1": 0.03}}})");
               },
               422, "/move_to/joints/left_panda_joint1", "left_panda_finger_joint1"},
        Pasted{"FingersAsList",
               [] { return std::string(R"({"arm": "left", "move_to": {"joints": [0.03]}})"); }, 422,
               "/move_to/joints", "{\"left_panda_finger_joint1\": ...}"},
        Pasted{"FollowingFinger",
               [] {
                 return std::string(
                     R"({"arm": "left", "move_to": {"joints": {"panda_finger_joint2": 0.03}}})");
               },
               422, "/move_to/joints/panda_finger_joint2", "leave it out"},
        Pasted{"Yaml", as_echoed, 200, "", "", kYaml},
        Pasted{"YamlWithTheArm",
               [] { return as_echoed().erase(as_echoed().size() - 4) + "arm: left\n"; }, 200, "",
               "", kYaml},
        Pasted{"ShortenedYaml", shortened, 400, "/joint_names/1", "--full-length", kYaml},
        Pasted{"BrokenYaml", [] { return std::string("points: [1, 2\n"); }, 400, "", "line 2",
               kYaml},
        Pasted{"TwoDocuments", [] { return std::string("a: 1\n---\nb: 2\n"); }, 400, "",
               "several documents", kYaml}),
    [](const auto& tested) { return tested.param.name; });

class PastedJob : public test::RunningServer {};

TEST_F(PastedJob, MovesAGripperWhileItsArmRests) {
  start(10.0);
  test::Listener listener(port());
  const auto answer = post("/api/v1/jobs",
                           R"({"id": "open", "arm": "left",
                               "move_to": {"joints": {"left_panda_finger_joint1": 0.03}}})");
  ASSERT_EQ(answer.status, 202) << answer.body;
  until(listener, "open", "succeeded");
  const auto closed = post("/api/v1/check", with_fingers_alone());  // begins at 0
  EXPECT_EQ(closed.status, 422);
  EXPECT_EQ(closed.json()["value"], 0);
  EXPECT_THAT(closed.json()["detail"].get<std::string>(), HasSubstr("will be at 0.03 m"));
}

TEST(YamlText, KeepsTheTypesOfScalars) {
  const auto json_text = json_of_yaml("a: [1, -2.5, '3', \"4\", true, ~, 1e-3, text, 0x1F]\n");
  ASSERT_TRUE(json_text) << json_text.error().front().detail;
  EXPECT_EQ(*json_text, R"({"a":[1,-2.5,"3","4",true,null,0.001,"text","0x1F"]})");
}

TEST(YamlText, CountsWhatAliasesRepeat) {
  std::string bomb = "a: &a [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (char name = 'b'; name <= 'h'; ++name) {
    const std::string before = "*" + std::string(1, static_cast<char>(name - 1));
    bomb += std::string(1, name) + ": &" + name + " [";
    for (int i = 0; i < 10; ++i) bomb += (i > 0 ? ", " : "") + before;
    bomb += "]\n";
  }
  const auto refused = json_of_yaml(bomb);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().kind, ProblemKind::too_large);
  EXPECT_FALSE(json_of_yaml(std::string(100'000, '[')));
}

}  // namespace
}  // namespace armloom
