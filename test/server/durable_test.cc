// kills.py tests kills of the server.
#include "test/server/durable_server.h"
#include "test/source_dir.h"

namespace armloom {
namespace {

using nlohmann::json;
using test::FailingDisk;

TEST_F(Durable, WaitingJobsAreRestoredUnderAStop) {
  start(1);
  ASSERT_EQ(post("/api/v1/stop", "").status, 202);
  const std::string submitted = submit("a").json()["submitted_at"];
  EXPECT_EQ(submit("b", "left", {{"after", {"a"}}, {"priority", 3}}).status, 202);
  EXPECT_EQ(submit("", "right", {{"id", "c"}, {"reorderable", true}}).status, 202);
  json nameless = swing("x", "right");
  nameless.erase("id");
  const std::string given = post("/api/v1/jobs", nameless.dump()).json()["id"];
  restart(20);
  EXPECT_TRUE(get("/api/v1/queue").json()["stopped"]);
  EXPECT_EQ(job("a")["state"], "queued");
  EXPECT_EQ(job("a")["submitted_at"], submitted);
  EXPECT_EQ(job("b")["priority"], 3);
  EXPECT_EQ(job("c")["reorderable"], true);
  EXPECT_EQ(job(given)["state"], "queued");
  std::vector<std::string> ids;
  const json page = get("/api/v1/jobs").json();
  for (const json& listed : page["jobs"]) ids.push_back(listed["id"]);
  EXPECT_EQ(ids, (std::vector<std::string>{given, "c", "b", "a"}));
  ASSERT_EQ(post("/api/v1/resume", "").status, 202);
  wait_for("b", "succeeded");
  wait_for(given, "succeeded");
  EXPECT_LE(job("a")["ended_s"].get<double>(), job("b")["started_s"].get<double>());
}

TEST_F(Durable, RequestsInYamlSurviveARestart) {
  start(1);
  ASSERT_EQ(post("/api/v1/stop", "").status, 202);
  const char* const yaml = "application/yaml";
  ASSERT_EQ(post("/api/v1/jobs", "id: pasted\narm: left\nmove_to:\n  named: home\n", yaml).status,
            202);
  const auto object = post("/api/v1/scene/objects",
                           "name: pasted\nsphere:\n- 0.05\nxyz:\n- 0\n- 0.9\n- 0.2\n", yaml);
  ASSERT_EQ(object.status, 201) << object.body;
  restart();
  EXPECT_EQ(job("pasted")["state"], "queued");
  EXPECT_NE(get("/api/v1/scene").body.find("pasted"), std::string::npos);
}

TEST_F(Durable, ChangesOfJobsSurviveARestart) {
  start(1);
  ASSERT_EQ(post("/api/v1/stop", "").status, 202);
  submit("a");
  submit("b", "right");
  const auto patch = [&](const std::string& id, const json& changes) {
    return test::request(port(), "PATCH", "/api/v1/jobs/" + id, changes.dump());
  };
  ASSERT_EQ(patch("a", {{"priority", 4}, {"on_timeout", "replan"}}).status, 200);
  ASSERT_EQ(patch("a", {{"backlog_timeout_s", 7}, {"name", "first"}}).status, 200);
  for (int run = 0; run < 2; ++run) {
    restart();
    EXPECT_EQ(job("a")["priority"], 4);
    EXPECT_EQ(job("a")["on_timeout"], "replan");
    EXPECT_EQ(job("a")["backlog_timeout_s"], 7);
    EXPECT_EQ(job("a")["name"], "first");
    EXPECT_EQ(job("b")["priority"], 0);
  }
  EXPECT_EQ(submit("a").status, 200) << "the same request, sent again";
}

TEST_F(Durable, UnwrittenChangeIsRefused) {
  start(1);
  ASSERT_EQ(post("/api/v1/stop", "").status, 202);
  submit("a");
  FailingDisk::fail(FailingDisk::Fault::broken, FailingDisk::operations() + 1);
  const auto refused = test::request(port(), "PATCH", "/api/v1/jobs/a", R"({"priority": 4})");
  EXPECT_EQ(refused.status, 503) << refused.body;
  FailingDisk::reset();
  wait_until([&] { return get("/readyz").status == 200; });
  EXPECT_EQ(test::request(port(), "PATCH", "/api/v1/jobs/a", R"({"priority": 5})").status, 200);
  restart();
  EXPECT_EQ(job("a")["priority"], 5);
}

TEST_F(Durable, RunningJobIsInterruptedAndItsSuccessorFails) {
  start(1);
  submit("ran");
  submit("after", "right", {{"after", {"ran"}}});
  submit("next");
  wait_for("ran", "running");
  restart();
  EXPECT_EQ(job("ran")["state"], "interrupted");
  EXPECT_EQ(job("ran")["result"]["reason"], "server_restart");
  EXPECT_FALSE(job("ran")["started_at"].is_null());
  EXPECT_FALSE(job("ran")["ended_at"].is_null());
  EXPECT_EQ(job("after")["result"]["reason"], "predecessor_failed");
  EXPECT_EQ(job("next")["state"], "queued");
  restart();
  EXPECT_EQ(job("ran")["state"], "interrupted") << "it is final";
  const auto again = remove("/api/v1/jobs/ran");
  EXPECT_EQ(again.status, 409);
  EXPECT_EQ(submit("ran", "right").status, 409) << "an id of a former run";
  EXPECT_EQ(submit("ran").json()["state"], "interrupted") << "sent again, and not done again";
}

TEST_F(Durable, SucceededJobsSatisfyLaterPredecessors) {
  start(20);
  submit("done");
  wait_for("done", "succeeded");
  restart(20);
  EXPECT_FALSE(get("/api/v1/queue").json()["stopped"]) << "nothing was left";
  EXPECT_EQ(submit("then", "right", {{"after", {"done"}}}).status, 202);
  wait_for("then", "succeeded");
  EXPECT_EQ(job("then")["id"], "then");
}

TEST_F(Durable, OperatorsStopSurvivesARestart) {
  start(1);
  ASSERT_EQ(post("/api/v1/arms/left/stop", "").status, 202);
  restart();
  EXPECT_EQ(get("/api/v1/arms/left").json()["state"], "stopped");
  EXPECT_EQ(get("/api/v1/arms/right").json()["state"], "idle");
}

TEST_F(Durable, ObjectsExpireAfterARestart) {
  start(1);
  const json objects = {{{"name", "a"}, {"sphere", {0.05}}, {"xyz", {0, 0.9, 0.2}}},
                        {{"name", "b"}, {"sphere", {0.05}}, {"xyz", {0, 1.1, 0.2}}}};
  const auto set = [&](double expires_in_s) {
    const json body{{"objects", objects}, {"expires_in_s", expires_in_s}, {"padding_m", 0.5}};
    ASSERT_EQ(put("/api/v1/scene", body.dump()).status, 200);
  };
  set(1000);
  const json before = get("/api/v1/scene").json();
  restart();
  const json after = get("/api/v1/scene").json();
  EXPECT_EQ(after["objects"], before["objects"]) << "with the padding";
  EXPECT_EQ(after["expiring"], json({"a", "b"}));
  EXPECT_LT(after["expires_s"], before["expires_s"]) << "the time without a server counts";
  EXPECT_GT(after["expires_s"].get<double>(), 900.0);
  const auto is_gone = [&] {
    return get("/api/v1/scene").body.find("\"name\":\"a\"") == std::string::npos;
  };
  set(0.3);
  restart();
  wait_until(is_gone);
  restart();
  EXPECT_TRUE(is_gone());
  EXPECT_FALSE(get("/api/v1/scene").json().contains("expired")) << "the store has forgotten them";
  EXPECT_EQ(get("/api/v1/queue").json()["stopped"], false);
}

TEST_F(Durable, SpeedOverridesSurviveARestart) {
  on_restart_ = OnRestart::continue_;
  start(1);
  EXPECT_EQ(put_speed("/speed", 0.5).status, 200);
  EXPECT_EQ(put_speed("/speed", 0.2).status, 200);
  EXPECT_EQ(put_speed("/arms/left/speed", 0).status, 200);
  EXPECT_EQ(submit("held").status, 202);
  for (int run = 0; run < 2; ++run) {
    restart();
    EXPECT_EQ(speed_of("/speed"), 0.2);
    EXPECT_EQ(speed_of("/arms/left"), 0);
    EXPECT_EQ(speed_of("/arms/right"), 1);
    EXPECT_EQ(get("/api/v1/arms/right").json()["effective_speed_override"], 0.2);
    EXPECT_EQ(state_of("right"), "idle");
    wait_until([&] {
      const json waits = job("held")["waits_on"];
      return !waits.empty() && waits[0]["kind"] == "speed";
    });
    EXPECT_EQ(job("held")["state"], "queued") << "it may not move before its override is restored";
  }
  EXPECT_EQ(put_speed("/arms/left/speed", 1).status, 200);
  wait_for("held", "running");
}

TEST_F(Durable, SpeedOverrideIsAcknowledgedWhenStored) {
  start(1);
  FailingDisk::fail(FailingDisk::Fault::broken, FailingDisk::operations() + 1);
  const auto warned = put_speed("/arms/left/speed", 0.3);
  EXPECT_EQ(warned.status, 503) << warned.body;
  EXPECT_NE(warned.body.find("done, but not stored"), std::string::npos);
  EXPECT_EQ(speed_of("/arms/left"), 0.3);
  FailingDisk::reset();
  wait_until([&] { return get("/readyz").status == 200; });
  restart();
  EXPECT_EQ(speed_of("/arms/left"), 0.3) << "it was written later";
}

// A job that waits for an object must not find its path free after a restart.
TEST_F(Durable, SceneChangesSurviveARestart) {
  on_restart_ = OnRestart::continue_;
  start(1);
  const std::string at = "/api/v1/scene/objects";
  const auto box = [](double z) {
    return json{{"name", "crate"}, {"box", {0.2, 0.2, 0.2}}, {"xyz", {2, 0.3, z}}}.dump();
  };
  ASSERT_EQ(post(at, box(0.4)).status, 201);
  ASSERT_EQ(test::request(port(), "PUT", at + "/crate", box(0.6)).status, 200);
  ASSERT_EQ(post(at, R"({"name": "gone", "box": [0.1, 0.1, 0.1], "xyz": [2, 2, 2]})").status, 201);
  ASSERT_EQ(remove(at + "/gone").status, 200);
  ASSERT_EQ(remove(at + "/table").status, 200);
  const json before = get("/api/v1/scene").json()["objects"];
  EXPECT_EQ(before.size(), 1U) << before;
  for (int run = 0; run < 2; ++run) {
    restart();
    EXPECT_EQ(get("/api/v1/scene").json()["objects"], before);
    EXPECT_FALSE(get("/api/v1/queue").json()["stopped"]);
  }
  const json pillar{{"name", "pillar"}, {"box", {0.2, 0.2, 0.2}}, {"xyz", {2, 2, 1}}};
  ASSERT_EQ(
      test::request(port(), "PUT", "/api/v1/scene", json{{"objects", {pillar}}}.dump()).status,
      200);
  restart();
  const json pillars = get("/api/v1/scene").json()["objects"];
  ASSERT_EQ(pillars.size(), 1U) << pillars;
  EXPECT_EQ(pillars[0]["name"], "pillar");
  ASSERT_EQ(remove(at).status, 200);
  restart();
  EXPECT_EQ(get("/api/v1/scene").json()["objects"], json::array());
}

TEST_F(Durable, SceneChangeIsAcknowledgedWhenStored) {
  start(1);
  const std::string crate = R"({"name": "crate", "box": [0.1, 0.1, 0.1], "xyz": [2, 2, 2]})";
  FailingDisk::fail(FailingDisk::Fault::broken, FailingDisk::operations() + 1);
  const auto warned = post("/api/v1/scene/objects", crate);
  EXPECT_EQ(warned.status, 503) << warned.body;
  EXPECT_NE(warned.body.find("done, but not stored"), std::string::npos);
  EXPECT_NE(get("/api/v1/scene").body.find("crate"), std::string::npos);
  EXPECT_EQ(remove("/api/v1/scene/objects/crate").status, 503);
  EXPECT_NE(get("/api/v1/scene").body.find("crate"), std::string::npos) << "as no arm is let go";
  FailingDisk::reset();
  wait_until([&] { return get("/readyz").status == 200; });
  restart();
  EXPECT_NE(get("/api/v1/scene").body.find("crate"), std::string::npos) << "it was written later";
}

TEST_F(Durable, ContinueRunsUnstartedJobsWithoutAResume) {
  on_restart_ = OnRestart::continue_;
  start(1);
  ASSERT_EQ(post("/api/v1/arms/left/stop", "").status, 202);
  submit("held");
  submit("ran", "right");
  submit("next", "right");
  wait_for("ran", "running");
  restart(20);
  wait_for("next", "succeeded");
  EXPECT_EQ(job("ran")["state"], "interrupted");
  EXPECT_EQ(job("held")["state"], "queued") << "its arm was stopped, and is";
}

TEST_F(Durable, ListsIncludeEarlierSessions) {
  start(20);
  for (int i = 0; i < 7; ++i) submit("old-" + std::to_string(i), i % 2 == 0 ? "left" : "right");
  wait_for("old-6", "succeeded");
  wait_for("old-5", "succeeded");
  restart(1);
  for (int i = 0; i < 3; ++i) submit("new-" + std::to_string(i));
  std::vector<std::string> ids;
  std::string cursor;
  for (int pages = 0; pages < 10; ++pages) {
    const json page = get("/api/v1/jobs?limit=3" + cursor).json();
    for (const json& listed : page["jobs"]) ids.push_back(listed["id"]);
    if (page["next_cursor"].is_null()) break;
    cursor = "&cursor=" + page["next_cursor"].get<std::string>();
  }
  EXPECT_EQ(ids, (std::vector<std::string>{"new-2", "new-1", "new-0", "old-6", "old-5", "old-4",
                                           "old-3", "old-2", "old-1", "old-0"}));
  EXPECT_EQ(get("/api/v1/jobs?arm=right&state=succeeded").json()["jobs"].size(), 3U);
}

TEST_F(Durable, JobThatNoLongerFitsTheCellIsInterrupted) {
  start(1);
  ASSERT_EQ(post("/api/v1/stop", "").status, 202);
  submit("gone", "right");
  submit("after", "left", {{"after", {"gone"}}});
  submit("stays", "left");
  end();
  json cell = json::parse(read_text_file(source_dir() + "/config/two_pandas.json").value(), nullptr,
                          true, true);
  for (json& robot : cell["robots"]) {
    for (const char* key : {"urdf", "srdf"}) {
      robot[key] = source_dir() + "/config/" + robot[key].get<std::string>();
    }
  }
  cell["robots"].erase(cell["robots"][0]["name"] == "right" ? 0 : 1);
  cell["allowed_collisions"] = json::array();
  const auto file = data_ / "one_panda.json";
  std::ofstream(file) << cell.dump();
  start(1, {}, file);
  wait_until([&] { return job("gone")["state"] == "interrupted"; });
  EXPECT_NE(job("gone")["result"]["detail"].get<std::string>().find("no longer fits"),
            std::string::npos);
  wait_until([&] { return job("after")["state"] == "failed"; });
  EXPECT_EQ(job("stays")["state"], "queued");
}

}  // namespace
}  // namespace armloom
