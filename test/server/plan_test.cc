#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <thread>

#include "server/http/http_server.h"
#include "test/server/panda_jobs.h"
#include "test/server/running_server.h"

namespace armloom {
namespace {

using nlohmann::json;
using test::RunningServer;

class PlanOverHttp : public RunningServer {
 protected:
  test::Answer plan(const json& body) { return post("/api/v1/plan", body.dump()); }
  json planned(const json& body) {
    const auto answer = plan(body);
    EXPECT_EQ(answer.status, 200) << answer.body;
    return answer.json();
  }
};

TEST_F(PlanOverHttp, ReturnsATrajectoryThatPostJobsAccepts) {
  start(20.0);
  const json plan = planned({{"arm", "left"}, {"to", {{"named", "ready"}}}});
  EXPECT_EQ(plan["verdict"]["verdict"], "free") << plan["verdict"];
  EXPECT_GE(plan["length"].get<double>(), plan["straight_line_length"].get<double>() - 1e-9);
  EXPECT_GT(plan["evaluations"], 0);
  EXPECT_EQ(get("/api/v1/jobs").json()["jobs"].size(), 0U) << "it is not executed";
  test::Listener listener(port());
  const json job = {{"id", "planned"}, {"trajectory", plan["trajectory"]}};
  ASSERT_EQ(post("/api/v1/jobs", job.dump()).status, 202);
  const json done = until(listener, "planned", "succeeded");
  EXPECT_NEAR(done["duration_s"], plan["duration_s"], 1e-6);
}

TEST_F(PlanOverHttp, StartsWhereAcceptedJobsWillLeaveTheArm) {
  start(1.0);
  const json first = planned({{"arm", "left"}, {"to", {{"named", "ready"}}}});
  const json job = {{"id", "first"}, {"trajectory", first["trajectory"]}};
  ASSERT_EQ(post("/api/v1/jobs", job.dump()).status, 202);
  const json next = planned({{"arm", "left"}, {"to", {{"named", "home"}}}});
  const auto& ends = first["trajectory"]["points"].back()["positions"];
  const auto& begins = next["trajectory"]["points"].front()["positions"];
  for (std::size_t j = 0; j < ends.size(); ++j) EXPECT_NEAR(ends[j], begins[j], 1e-9);
}

TEST_F(PlanOverHttp, ReportsThatAnotherStartIsNotChecked) {
  start(1.0);
  const json plan =
      planned({{"arm", "left"}, {"to", {{"named", "home"}}}, {"start", {{"named", "ready"}}}});
  EXPECT_FALSE(plan.contains("verdict"));
  EXPECT_EQ(plan["not_checked_reason"]["type"], "urn:armloom:problem:start-mismatch");
}

TEST_F(PlanOverHttp, ReportsTheFaultyMemberAndTheNearestValidGoal) {
  start(1.0);
  const json beyond = {0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0};
  const json table = {0.0, 1.7, 0.0, -1.0, 0.0, 1.0, 0.0};
  const json outside = plan({{"arm", "left"}, {"to", {{"joints", beyond}}}}).json();
  EXPECT_EQ(outside["type"], "urn:armloom:problem:outside-limits");
  EXPECT_EQ(outside["pointer"], "/to/joints/3");
  EXPECT_EQ(outside["value"], 1.0);
  EXPECT_EQ(outside["nearest"].size(), 7U);
  const json begins =
      plan({{"arm", "left"}, {"to", {{"named", "ready"}}}, {"start", {{"joints", beyond}}}}).json();
  EXPECT_EQ(begins["pointer"], "/start/joints/3");
  const json collides = plan({{"arm", "left"}, {"to", {{"joints", table}}}}).json();
  EXPECT_EQ(collides["pointer"], "/to/joints");
  EXPECT_EQ(collides["required_clearance_m"], 0.02);
  const json nearest = collides["nearest"];
  ASSERT_EQ(nearest.size(), 7U) << collides;
  EXPECT_EQ(plan({{"arm", "left"}, {"to", {{"joints", nearest}}}}).status, 200);
  const json stands =
      plan({{"arms", {"right", "left"}}, {"to", {{"pose", {{"xyz", {3, 0, 0.5}}}}}}}).json();
  EXPECT_EQ(stands["pointer"], "/to/pose");
  EXPECT_EQ(stands["links"], json({"right_panda_link7"}));
}

TEST_F(PlanOverHttp, RefusesABudgetOutOfRange) {
  start(1.0);
  json body = {{"arm", "left"}, {"to", {{"named", "extended"}}}, {"budget", 0}};
  EXPECT_EQ(plan(body).json()["pointer"], "/budget");
  body["budget"] = 4'000'001;
  EXPECT_EQ(plan(body).json()["pointer"], "/budget");
  body["budget"] = 100'000;
  EXPECT_EQ(plan(body).status, 200);
}

TEST_F(PlanOverHttp, SelectsTheFirstArmAndReportsTheOthers) {
  start(20.0);
  const json beside_left = {
      {"pose", {{"link", "panda_link8"}, {"xyz", {-0.6, 0.4, 0.5}}, {"rpy", {3.14, 0, 0}}}}};
  const json plan = planned({{"arms", {"right", "left"}}, {"to", beside_left}});
  EXPECT_EQ(plan["arm"], "left");
  ASSERT_EQ(plan["others"].size(), 1U);
  EXPECT_EQ(plan["others"][0]["arm"], "right");
  const json body = {{"arms", {"right", "left"}}, {"move_to", beside_left}, {"id", "either"}};
  const json said = post("/api/v1/check", body.dump()).json();
  EXPECT_EQ(said["verdict"], "free") << said;
  EXPECT_EQ(said["choice"]["selected"], "left") << said;
  test::Listener listener(port());
  ASSERT_EQ(post("/api/v1/jobs", body.dump()).status, 202);
  const json done = until(listener, "either", "succeeded");
  EXPECT_EQ(done["arms"], json({"left"}));
  EXPECT_EQ(done["alternatives"], json({"right", "left"}));
  EXPECT_EQ(done["choice"]["selected"], "left");
  const json nowhere = {{"pose", {{"xyz", {3, 0, 0.5}}}}};
  const auto none = this->plan({{"arms", {"right", "left"}}, {"to", nowhere}});
  EXPECT_EQ(none.status, 422);
  EXPECT_NE(none.json()["detail"].get<std::string>().find("; left: "), std::string::npos);
}

TEST_F(PlanOverHttp, RefusesUnknownNamesWithTheirPointer) {
  start(1.0);
  const json arm = plan({{"arm", "lft"}, {"to", {{"named", "ready"}}}}).json();
  EXPECT_EQ(arm["pointer"], "/arm");
  const json state = plan({{"arm", "left"}, {"to", {{"named", "redy"}}}}).json();
  EXPECT_EQ(state["pointer"], "/to/named");
  EXPECT_EQ(state["status"], 422);
  const json pose = plan({{"arm", "left"},
                          {"to", {{"named", "ready"}}},
                          {"start", {{"pose", {{"xyz", {0, 0, 1}}}}}}})
                        .json();
  EXPECT_EQ(pose["pointer"], "/start/pose");
  const json nowhere = plan({{"arm", "left"}, {"to", {{"pose", {{"rpy", {3.14, 0, 0}}}}}}}).json();
  EXPECT_EQ(nowhere["pointer"], "/to/pose/xyz") << "not the world's origin";
}

class GoalsOverHttp : public RunningServer {};

TEST_F(GoalsOverHttp, JobWithANamedGoalIsPlannedAndDone) {
  start(20.0);
  test::Listener listener(port());
  const json body = {{"id", "go"},
                     {"arm", "left"},
                     {"move_to", {{"named", "ready"}}},
                     {"velocity_scaling_factor", 0.1}};
  const auto accepted = post("/api/v1/jobs", body.dump());
  ASSERT_EQ(accepted.status, 202) << accepted.body;
  EXPECT_EQ(accepted.json()["planned"], false);
  EXPECT_EQ(accepted.json()["arms"], json::array({"left"}));
  const json waits =
      next_job(listener, "go", [](const json& job) { return job["planned"] == false; });
  EXPECT_EQ(waits["waits_on"][0]["kind"], "plan");
  const json planned =
      next_job(listener, "go", [](const json& job) { return job["planned"] == true; });
  EXPECT_TRUE(planned["result"].is_null());
  EXPECT_EQ(until(listener, "go", "succeeded")["result"]["reason"], "completed");
  const json full = post("/api/v1/plan",
                         R"({"arm": "left", "start": {"named": "home"}, "to": {"named": "ready"}})")
                        .json();
  EXPECT_GT(planned["duration_s"], 1.5 * full["duration_s"].get<double>()) << "slowly";
}

TEST_F(GoalsOverHttp, EitherGoalOrTrajectoryIsRequired) {
  start(1.0);
  json both = test::move("left", test::kHome, test::kMiddle);
  both["move_to"] = {{"named", "ready"}};
  EXPECT_EQ(post("/api/v1/jobs", both.dump()).status, 422);
  const json no_arm = {{"move_to", {{"named", "ready"}}}};
  const json refused = post("/api/v1/jobs", no_arm.dump()).json();
  EXPECT_EQ(refused["pointer"], "/arm");
  EXPECT_EQ(refused["type"], "urn:armloom:problem:no-arm");
  const json foreign = {
      {"arm", "left"},
      {"move_to", {{"pose", {{"link", "right_panda_link8"}, {"xyz", {0, 0, 1}}}}}}};
  const auto answer = post("/api/v1/jobs", foreign.dump());
  EXPECT_EQ(answer.status, 422);
  EXPECT_EQ(answer.json()["pointer"], "/move_to/pose/link");
}

TEST_F(PlanOverHttp, RefusesAStraightLineThatBreaks) {
  start(1.0);
  const auto to_y = [&](double y_m) {
    const json pose = {
        {"link", "left_panda_link8"}, {"xyz", {0.1, y_m, 0.6}}, {"rpy", {3.14, 0, 0}}};
    return plan({{"arm", "left"}, {"to", {{"pose", pose}, {"cartesian", true}}}});
  };
  const json broken = to_y(3.0).json();
  EXPECT_EQ(broken["type"], "urn:armloom:problem:line-broken") << broken;
  EXPECT_NE(broken["detail"].get<std::string>().find("of the straight line"), std::string::npos);
  const auto joints = plan({{"arm", "left"}, {"to", {{"named", "ready"}, {"cartesian", true}}}});
  EXPECT_EQ(joints.status, 422) << joints.body;
}

TEST_F(GoalsOverHttp, ReplanKeepsTheJobId) {
  start(20.0);
  test::Listener listener(port());
  const json body = {{"id", "go"},
                     {"arm", "left"},
                     {"move_to", {{"named", "extended"}}},
                     {"velocity_scaling_factor", 0.1}};
  ASSERT_EQ(post("/api/v1/jobs", body.dump()).status, 202);
  until(listener, "go", "running");
  const auto asked = post("/api/v1/jobs/go/replan", "");
  ASSERT_EQ(asked.status, 202) << asked.body;
  EXPECT_EQ(asked.json()["replan"]["planning"], true);
  EXPECT_EQ(asked.json()["replan"]["cause"], "client");
  const json done = until(listener, "go", "succeeded");
  EXPECT_EQ(done["replan"]["done"], 1) << done;
  EXPECT_EQ(post("/api/v1/jobs/go/replan", "").status, 409);
  EXPECT_EQ(post("/api/v1/jobs/nobody/replan", "").status, 404);
}

TEST(Http, RequestIsMarkedWhenItsClientDisconnects) {
  auto http = HttpServer::listen("127.0.0.1", 0, 4);
  ASSERT_TRUE(http);
  std::promise<std::shared_ptr<std::atomic<bool>>> asked;
  Site site;
  site.handle = [&](const Request& request, const Respond&) { asked.set_value(request.gone); };
  site.refuse_unread = [](const Request&) { return std::nullopt; };
  site.is_stop = [](const Request&) { return false; };
  std::thread server([&] { (*http)->run(site, false); });
  std::shared_ptr<std::atomic<bool>> gone;
  {
    test::Wire wire((*http)->port());
    ASSERT_TRUE(wire.send(test::request_text("GET", "/", "", "application/json")));
    auto is_asked = asked.get_future();
    if (is_asked.wait_for(std::chrono::seconds(10)) == std::future_status::ready) {
      gone = is_asked.get();
      EXPECT_FALSE(*gone);
    }
  }
  EXPECT_TRUE(gone) << "it was not handed over";
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (gone && !*gone && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
  EXPECT_TRUE(gone && *gone);
  (*http)->stop();
  server.join();
}

}  // namespace
}  // namespace armloom
