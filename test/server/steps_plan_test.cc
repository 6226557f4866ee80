// POST /plan and POST /check of jobs with steps, over HTTP.
#include <gtest/gtest.h>

#include "test/server/running_server.h"

namespace armloom {
namespace {

using nlohmann::json;
using test::RunningServer;

json move_hand(double y_m, double z_m) {
  return {{"move_to",
           {{"pose",
             {{"link", "left_panda_hand"},
              {"xyz", {-0.1, y_m, z_m}},
              {"rpy", {3.14159265, 0, 0.785}}}}}}};
}

class StepsOverHttp : public RunningServer {
 protected:
  void start_with_part() {
    start(20.0);
    const json part = {{"box", {0.04, 0.04, 0.08}}, {"xyz", {-0.1, 0.35, 0.141}}};
    ASSERT_EQ(put("/api/v1/scene/objects/part", part.dump()).status, 201);
  }
  // Returns a job that picks the part and places it. `touch`: of the detach step.
  static json pick(const json& touch) {
    const json named = {{"move_to", {{"named", "ready"}}}};
    const json attach = {
        {"attach", {{"object", "part"}, {"link", "left_panda_hand"}, {"touch", {"table"}}}}};
    return {{"id", "pick"},
            {"arm", "left"},
            {"steps",
             {move_hand(0.35, 0.25), attach, named, move_hand(-0.35, 0.25),
              json{{"detach", {{"object", "part"}, {"touch", touch}}}}, named}}};
  }
  json plan(json body, int status) { return post_to("/api/v1/plan", body, status); }
  json check(const json& body, int status = 200) { return post_to("/api/v1/check", body, status); }

 private:
  json post_to(const std::string& path, const json& body, int status) {
    const auto answer = post(path, body.dump());
    EXPECT_EQ(answer.status, status) << answer.body;
    return answer.json();
  }
};

TEST_F(StepsOverHttp, ArePlannedAsTheJobThenRuns) {
  start_with_part();
  const json before = get("/api/v1/scene").json();
  const json told = plan(pick({"table"}), 200);
  const json& steps = told["steps"];
  ASSERT_EQ(steps.size(), 6U);
  EXPECT_EQ(steps[1]["kind"], "attach");
  EXPECT_FALSE(steps[1].contains("trajectory"));
  double duration_s = 0.0;
  json stands;
  for (const std::size_t i : {0, 2, 3, 5}) {
    const json& points = steps[i]["trajectory"]["points"];
    if (!stands.is_null()) {
      for (std::size_t j = 0; j < stands.size(); ++j) {
        EXPECT_NEAR(points.front()["positions"][j], stands[j], 1e-9) << i;
      }
    }
    stands = points.back()["positions"];
    duration_s += steps[i]["duration_s"].get<double>();
  }
  EXPECT_NEAR(told["duration_s"], duration_s, 1e-9);
  EXPECT_EQ(check(pick({"table"}))["verdict"], "free");
  EXPECT_EQ(get("/api/v1/scene").json(), before);
  EXPECT_EQ(get("/api/v1/jobs").json()["jobs"].size(), 0U) << "nothing is executed";
  test::Listener listener(port());
  ASSERT_EQ(post("/api/v1/jobs", pick({"table"}).dump()).status, 202);
  const json done = until(listener, "pick", "succeeded");
  EXPECT_EQ(done["steps"].size(), 6U);
}

// The bare hand reaches the place; the part in the hand is too close to the table.
TEST_F(StepsOverHttp, NameTheStepThatCollidesOnlyWithTheHeldObject) {
  start_with_part();
  const json refused = plan(pick(json::array()), 422);
  EXPECT_EQ(refused["type"], "urn:armloom:problem:goal-in-collision");
  EXPECT_EQ(refused["pointer"], "/steps/3/move_to/pose");
  EXPECT_EQ(refused["links"], json({"part", "table"}));
  EXPECT_EQ(refused["nearest"].size(), 7U);
  ASSERT_EQ(refused["steps"].size(), 3U);
  EXPECT_TRUE(refused["steps"][2].contains("trajectory"));
  const json verdict = check(pick(json::array()));
  EXPECT_EQ(verdict["verdict"], "conflict");
  EXPECT_EQ(verdict["step"], 3);
  EXPECT_EQ(verdict["result"]["reason"], "no_plan");
  EXPECT_EQ(verdict["result"]["step"], 3);
  ASSERT_EQ(remove("/api/v1/scene/objects/part").status, 200);
  json bare = pick(json::array());
  bare["steps"].erase(4);
  bare["steps"].erase(1);
  plan(bare, 200);
  EXPECT_EQ(check(bare)["verdict"], "free");
}

TEST_F(StepsOverHttp, GetTheProblemsOfPostJobs) {
  start_with_part();
  json body = pick({"table"});
  const auto expect_same = [&](const char* pointer) {
    const auto posted = post("/api/v1/jobs", body.dump());
    EXPECT_GE(posted.status, 400) << pointer;
    EXPECT_EQ(posted.json()["pointer"], pointer);
    EXPECT_EQ(plan(body, posted.status), posted.json());
    EXPECT_EQ(check(body, posted.status), posted.json());
  };
  std::swap(body["steps"][1], body["steps"][4]);
  expect_same("/steps/1/detach/object");
  body = pick({"table"});
  body["steps"][1]["attach"]["object"] = "parts";
  expect_same("/steps/1/attach/object");
  body = pick({"table"});
  body["steps"][2] = {{"trajectory",
                       {{"joint_names", {"left_panda_joint1"}},
                        {"points", {{{"positions", {9.0}}, {"time_from_start", 1.0}}}}}}};
  expect_same("/steps/2/trajectory");
  body = pick({"table"});
  body["steps"][2] = json::object();
  expect_same("/steps/2");
}

TEST_F(StepsOverHttp, TakeSeedAndBudgetOnlyForPlans) {
  start_with_part();
  json body = pick({"table"});
  body["seed"] = 3;
  body["budget"] = 100'000;
  plan(body, 200);
  EXPECT_EQ(check(body, 422)["pointer"], "/budget");
  body["to"] = {{"named", "ready"}};
  EXPECT_EQ(plan(body, 422)["pointer"], "/to");
}

}  // namespace
}  // namespace armloom
