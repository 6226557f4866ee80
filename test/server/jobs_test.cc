#include <gtest/gtest.h>

#include <array>
#include <set>
#include <thread>

#include "test/server/panda_jobs.h"
#include "test/server/running_server.h"

namespace armloom {
namespace {

using nlohmann::json;

class Jobs : public test::RunningServer {
 protected:
  static std::string body(const std::string& id, const test::Pose& from, const test::Pose& to,
                          const std::string& arm = "left") {
    json job = test::move(arm, from, to);
    job["id"] = id;
    return job.dump();
  }
  // Follows the events until all of these have ended; their last views by id.
  static std::map<std::string, json> until_ended(test::Listener& listener,
                                                 std::set<std::string> ids) {
    std::map<std::string, json> ended;
    while (!ids.empty()) {
      const json job = listener.next_of("job")["data"];
      if (job["result"].is_null() || ids.erase(job["id"]) == 0) continue;
      ended[job["id"]] = job;
    }
    return ended;
  }
};

TEST_F(Jobs, RunFromPostToSuccess) {
  start(20.0);
  test::Listener listener(port());
  const auto posted = post("/api/v1/jobs", body("go", test::kHome, test::kMiddle));
  ASSERT_EQ(posted.status, 202) << posted.body;
  EXPECT_EQ(posted.headers.at("location"), "/api/v1/jobs/go");
  EXPECT_EQ(posted.json()["duration_s"], 3.0);
  const json ended = until_ended(listener, {"go"})["go"];
  EXPECT_EQ(ended["state"], "succeeded") << ended;
  EXPECT_EQ(ended["result"]["reason"], "completed");
  EXPECT_EQ(ended["progress"], 1.0);
  EXPECT_GT(ended["ended_s"], ended["started_s"]);
  EXPECT_TRUE(ended["ended_at"].get<std::string>().ends_with("Z"));
  EXPECT_EQ(get("/api/v1/jobs/go").json(), ended);
  const json q = get("/api/v1/arms/left").json()["q"];
  for (std::size_t j = 0; j < 7; ++j) EXPECT_NEAR(q[j].get<double>(), test::kMiddle[j], 1e-3);
}

// T1: two conflicting trajectories in the same instant, over HTTP.
TEST_F(Jobs, OfTwoInConflictPostedAtOnceOneRunsAndTheOtherWaitsForIt) {
  on_idle_blocker_ = OnIdleBlocker::report;  // the winner stays where it is until it is sent home
  start(20.0);
  test::Listener listener(port());
  const std::array<std::string, 2> bodies = {body("l", test::kHome, test::kMiddle, "left"),
                                             body("r", test::kHome, test::kMiddle, "right")};
  // Both requests but their last byte lie ready; then two threads send these.
  test::Wire first(port());
  test::Wire second(port());
  const std::array<test::Wire*, 2> wires = {&first, &second};
  std::array<std::string, 2> texts;
  for (std::size_t i = 0; i < 2; ++i) {
    texts[i] = test::request_text("POST", "/api/v1/jobs", bodies[i], "application/json");
    wires[i]->send(std::string_view(texts[i]).substr(0, texts[i].size() - 1));
  }
  std::thread other([&] { second.send("}"); });
  first.send("}");
  other.join();
  EXPECT_EQ(test::read_answer(first).status, 202);
  EXPECT_EQ(test::read_answer(second).status, 202);

  std::string waited;
  std::map<std::string, json> ended;
  while (ended.size() < 1) {
    const json job = listener.next_of("job")["data"];
    if (job["state"] == "backlogged") {
      waited = job["id"];
      const std::string other_id = waited == "l" ? "r" : "l";
      ASSERT_FALSE(job["waits_on"].empty()) << job;
      EXPECT_EQ(job["waits_on"][0]["id"], other_id) << job;
      EXPECT_EQ(job["waits_on"][0]["links"].size(), 2U);
    }
    if (job["state"] == "running") {
      EXPECT_NE(job["id"], waited);
    }
    if (!job["result"].is_null()) ended[job["id"]] = job;
  }
  ASSERT_FALSE(waited.empty()) << "both ran";
  EXPECT_EQ(ended.count(waited), 0U);
  const std::string winner = ended.begin()->first;
  EXPECT_EQ(ended[winner]["state"], "succeeded");

  // The winner rests in the middle; when it goes home, the other gets its turn.
  EXPECT_EQ(post("/api/v1/jobs",
                 body("home", test::kMiddle, test::kHome, winner == "l" ? "left" : "right"))
                .status,
            202);
  const auto rest = until_ended(listener, {waited, "home"});
  EXPECT_EQ(rest.at("home")["state"], "succeeded");
  EXPECT_EQ(rest.at(waited)["state"], "succeeded");
}

// The finger joint is in no group: it is the gripper joint of the arm above it.
TEST_F(Jobs, MoveArmAndGripperInOneTrajectory) {
  start(5.0);
  const auto with_finger = [](json job, double from_m, double to_m) {
    job["trajectory"]["joint_names"].push_back("left_panda_finger_joint1");
    const auto& arm = job["trajectory"]["points"];
    const double begins = arm.front()["positions"][1], ends = arm.back()["positions"][1];
    for (json& point : job["trajectory"]["points"]) {  // in step with joint 2
      const double scale = (to_m - from_m) / (ends - begins);
      const double position = from_m + (point["positions"][1].get<double>() - begins) * scale;
      point["velocities"].push_back(point["velocities"][1].get<double>() * scale);
      point["accelerations"].push_back(point["accelerations"][1].get<double>() * scale);
      point["positions"].push_back(position);
    }
    return job;
  };
  test::Listener listener(port());
  const auto finger_m = [&] {
    return listener.next_of("state")["q"]["left_panda_finger_joint1"].get<double>();
  };
  EXPECT_EQ(finger_m(), 0.0);
  json open = with_finger(test::move("left", test::kHome, test::kMiddle), 0.0, 0.035);
  open["id"] = "open";
  ASSERT_EQ(post("/api/v1/jobs", open.dump()).status, 202);
  next_job(listener, "open", [](const json& job) { return job["state"] == "running"; });
  bool between = false;
  for (double last = 0.0; last < 0.03;) {
    const double now = finger_m();
    EXPECT_GE(now, last - 1e-6);
    between = between || (now > 0.002 && now < 0.033);
    last = now;
  }
  EXPECT_TRUE(between) << "it must move, not jump";
  EXPECT_EQ(until_ended(listener, {"open"})["open"]["result"]["reason"], "completed");
  const json q = listener.next_of("state")["q"];
  EXPECT_NEAR(q["left_panda_finger_joint1"].get<double>(), 0.035, 1e-4);
  EXPECT_EQ(q["right_panda_finger_joint1"], 0.0);
  for (std::size_t j = 0; j < 7; ++j) {
    EXPECT_NEAR(q["left_panda_joint" + std::to_string(j + 1)].get<double>(), test::kMiddle[j],
                1e-3);
  }

  // From here the finger is open: a job that believes it closed is refused, with what was found.
  const json back = test::move("left", test::kMiddle, test::kHome);
  const auto refused = post("/api/v1/jobs", with_finger(back, 0.0, 0.035).dump());
  EXPECT_EQ(refused.status, 422);
  EXPECT_EQ(refused.json()["pointer"], "/trajectory/points/0/positions/7");
  // An arm's own joints may move without it; the finger stays.
  json arm_alone = back;
  arm_alone["id"] = "back";
  ASSERT_EQ(post("/api/v1/jobs", arm_alone.dump()).status, 202);
  EXPECT_EQ(until_ended(listener, {"back"})["back"]["result"]["reason"], "completed");
  EXPECT_NEAR(finger_m(), 0.035, 1e-4);
}

TEST_F(Jobs, ACanceledJobBrakesOnItsPathAndSaysSo) {
  start(1.0);
  test::Listener listener(port());
  ASSERT_EQ(post("/api/v1/jobs", body("long", test::kHome, test::kMiddle)).status, 202);
  while (listener.next_of("job")["data"]["state"] != "running") {
  }
  const auto canceled = test::request(port(), "DELETE", "/api/v1/jobs/long");
  EXPECT_EQ(canceled.status, 202) << canceled.body;
  const json ended = until_ended(listener, {"long"})["long"];
  EXPECT_EQ(ended["state"], "canceled");
  EXPECT_EQ(ended["result"]["reason"], "canceled_by_client");
  EXPECT_LT(ended["progress"], 1.0);
  EXPECT_EQ(test::request(port(), "DELETE", "/api/v1/jobs/long").status, 409);
}

TEST_F(Jobs, StopHoldsThemAndResumeLetsThemEnd) {
  start(5.0);
  test::Listener listener(port());
  ASSERT_EQ(post("/api/v1/jobs", body("go", test::kHome, test::kMiddle)).status, 202);
  while (listener.next_of("job")["data"]["state"] != "running") {
  }
  const auto stopped = post("/api/v1/stop", "");
  EXPECT_EQ(stopped.status, 202);
  EXPECT_EQ(stopped.json()["stopped"], true);
  while (listener.next_of("job")["data"]["state"] != "holding") {
  }
  EXPECT_EQ(get("/api/v1/queue").json()["stopped"], true);
  EXPECT_EQ(get("/api/v1/queue").json()["running"][0]["id"], "go");
  EXPECT_EQ(post("/api/v1/resume", "").json()["stopped"], false);
  EXPECT_EQ(until_ended(listener, {"go"})["go"]["state"], "succeeded");
}

TEST_F(Jobs, AreListedNewestFirstInPages) {
  start(1.0);
  test::Pose from = test::kHome;
  test::Pose to = test::kMiddle;
  for (int i = 0; i < 5; ++i) {
    ASSERT_EQ(post("/api/v1/jobs", body("j" + std::to_string(i), from, to)).status, 202);
    std::swap(from, to);
  }
  const json first = get("/api/v1/jobs?limit=2&arm=left").json();
  EXPECT_EQ(first["jobs"][0]["id"], "j4");
  EXPECT_EQ(first["jobs"][1]["id"], "j3");
  const json second =
      get("/api/v1/jobs?limit=3&cursor=" + first["next_cursor"].get<std::string>()).json();
  EXPECT_EQ(second["jobs"][0]["id"], "j2");
  EXPECT_EQ(second["jobs"].size(), 3U);
  EXPECT_TRUE(second["next_cursor"].is_null());
  EXPECT_EQ(get("/api/v1/jobs?arm=right").json()["jobs"], json::array());
  EXPECT_EQ(get("/api/v1/jobs?state=succeeded").json()["jobs"], json::array());
}

}  // namespace
}  // namespace armloom
