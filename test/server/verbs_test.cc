#include "test/server/verbs_fixture.h"

namespace armloom {
namespace {

using nlohmann::json;
using test::kAside;

class Verbs : public test::VerbsFixture {};

TEST_F(Verbs, OneArmStopsAndResumesAlone) {
  start(5.0);
  test::Listener listener(port());
  ASSERT_EQ(post("/api/v1/jobs", job("l", test::kHome, kAside).dump()).status, 202);
  ASSERT_EQ(post("/api/v1/jobs", job("r", test::kHome, kAside, "right").dump()).status, 202);
  until(listener, "l", "running");
  const auto stopped = post("/api/v1/arms/left/stop", "");
  EXPECT_EQ(stopped.status, 202) << stopped.body;
  EXPECT_EQ(stopped.json()["name"], "left");
  until(listener, "l", "paused");
  EXPECT_EQ(get("/api/v1/queue").json()["stopped"], false);
  until(listener, "r", "succeeded");
  EXPECT_EQ(get("/api/v1/jobs/l").json()["state"], "paused");
  const json arm = get("/api/v1/arms/left").json();
  EXPECT_EQ(arm["state"], "stopped") << "not as if it went on by itself";
  EXPECT_EQ(arm["job"], "l");
  const json leg = get("/api/v1/timeline").json()["arms"][0]["steps"][0];
  EXPECT_TRUE(leg["ends_s"].is_null()) << leg;
  EXPECT_EQ(leg["pauses"][0]["waits_on"]["kind"], "stop");
  EXPECT_EQ(post("/api/v1/arms/left/resume", "").status, 202);
  until(listener, "l", "succeeded");
  expect_refused(post("/api/v1/arms/middle/stop", ""), 404, "request target", "middle");
  expect_refused(post("/api/v1/arms/middle/resume", ""), 404, "request target", "middle");
}

TEST_F(Verbs, FaultyStopIsRefusedAndStopsAllTheSame) {
  struct Faulty {
    std::string query;
    std::string body;
    std::string pointer;
    std::string remedy;
  };
  const Faulty all[] = {
      {"?categry=0", "", "?categry", "known: category, pretty"},
      {"?category=0&category=0", "", "?category", "send it once"},
      {"?category=0&x=%1", "", "request target", "send % as %25"},
      {"?category=7", "", "?category", "within 0..2"},
      {"?category=", "", "?category", "within 0..2"},
      {"?category=0&pretty=yes", "", "?pretty", "must be 1, 0"},
      {"", R"({"category": 0})", "request body", "?category=0"},
  };
  start(1.0);
  for (const Faulty& faulty : all) {
    for (const std::string path : {"/api/v1/stop", "/api/v1/arms/left/stop"}) {
      ASSERT_EQ(post("/api/v1/resume", "").status, 202);
      const auto refused = post(path + faulty.query, faulty.body);
      EXPECT_EQ(refused.status, 400) << refused.body;
      EXPECT_EQ(refused.json()["pointer"], faulty.pointer) << refused.body;
      const std::string detail = refused.json()["detail"];
      EXPECT_NE(detail.find(faulty.remedy), std::string::npos) << detail;
      EXPECT_TRUE(detail.ends_with("stopped with category 2")) << detail;
      const json left = get("/api/v1/arms/left").json();
      EXPECT_EQ(left["state"], "stopped") << path << faulty.query;
      EXPECT_EQ(left["drives_on"], true) << "not category 0";
      EXPECT_EQ(get("/api/v1/queue").json()["stopped"], path == "/api/v1/stop");
    }
  }
}

TEST_F(Verbs, RequestWithABodyThatItDoesNotReadIsRefusedAndDoesNothing) {
  start(1.0);
  ASSERT_EQ(post("/api/v1/stop", "").status, 202);
  for (const std::string path : {"/api/v1/resume", "/api/v1/arms/left/resume"}) {
    const auto refused = post(path, R"({"arms": ["left"]})");
    expect_refused(refused, 400, "request body", nullptr);
    const std::string detail = refused.json()["detail"];
    EXPECT_TRUE(detail.starts_with("this request has no body: remove it")) << detail;
    EXPECT_EQ(get("/api/v1/queue").json()["stopped"], true) << path;
    EXPECT_EQ(get("/api/v1/arms/left").json()["state"], "stopped") << path;
  }
  EXPECT_NE(post("/api/v1/resume", "[]").body.find("/arms/{name}/resume"), std::string::npos);
  ASSERT_EQ(post("/api/v1/jobs", job("l", test::kHome, kAside).dump()).status, 202);
  expect_refused(test::request(port(), "DELETE", "/api/v1/jobs/l", "{}"), 400, "request body",
                 nullptr);
  EXPECT_EQ(get("/api/v1/jobs/l").json()["result"], nullptr) << "not canceled";
  EXPECT_EQ(post("/api/v1/resume", "").status, 202);
}

TEST_F(Verbs, SpeedChangeKeepsWallTimesRight) {
  start(1.0);
  test::Listener listener(port());
  const auto changed = put("/api/v1/sim/speed", R"({"speed": 50})");
  ASSERT_EQ(changed.status, 200) << changed.body;
  EXPECT_EQ(changed.json()["speed"], 50.0);
  EXPECT_EQ(get("/api/v1/cell").json()["speed"], 50.0);
  // The speed is sent to every client with the poses. Frames with the old speed may still arrive
  // first.
  double told = 0.0;
  for (int i = 0; i < 1000 && told != 50.0; ++i) told = listener.next_of("state")["speed"];
  EXPECT_EQ(told, 50.0);
  ASSERT_EQ(post("/api/v1/jobs", job("l", test::kHome, kAside, "left", 10.0).dump()).status, 202);
  const json ended = until(listener, "l", "succeeded");
  const auto second_of = [](const std::string& at) { return std::stod(at.substr(17, 6)); };
  double took_s = second_of(ended["ended_at"]) - second_of(ended["started_at"]);
  if (took_s < 0.0) took_s += 60.0;
  EXPECT_LT(took_s, 5.0);  // 10 s of cell time, 0.2 s of wall time, plus slips of a busy machine
  EXPECT_GT(took_s, 0.1);
  EXPECT_EQ(get("/api/v1/jobs/l").json(), ended);
  for (const char* speed : {"0", "-1", "1000.5"}) {
    expect_refused(put("/api/v1/sim/speed", std::string(R"({"speed": )") + speed + "}"), 422,
                   "/speed", std::stod(speed));
  }
  expect_refused(put("/api/v1/sim/speed", R"({"speed": "fast"})"), 400, "/speed", "fast");
  expect_refused(put("/api/v1/sim/speed", "{}"), 422, "/speed", nullptr);
}

TEST_F(Verbs, SpeedOverrideAppliesInMotion) {
  start(5.0);
  test::Listener listener(port());
  ASSERT_EQ(post("/api/v1/jobs", job("l", test::kHome, kAside).dump()).status, 202);
  until(listener, "l", "running");
  const auto cell = put("/api/v1/speed", R"({"speed_override": 0.5})");
  ASSERT_EQ(cell.status, 200) << cell.body;
  EXPECT_EQ(cell.json(), json({{"speed_override", 0.5}}));
  EXPECT_EQ(get("/api/v1/speed").json(), cell.json());
  const auto left = put("/api/v1/arms/left/speed", R"({"speed_override": 0})");
  ASSERT_EQ(left.status, 200) << left.body;
  EXPECT_EQ(left.json(),
            json({{"name", "left"}, {"speed_override", 0.0}, {"effective_speed_override", 0.0}}));
  const json paused = until(listener, "l", "paused");
  EXPECT_EQ(paused["waits_on"][0]["kind"], "speed") << paused;
  EXPECT_EQ(paused["waits_on"][0]["arm"], "left");
  EXPECT_EQ(get("/api/v1/arms/right").json()["effective_speed_override"], 0.5);
  EXPECT_EQ(get("/api/v1/queue").json()["stopped"], false);
  EXPECT_EQ(put("/api/v1/arms/left/speed", R"({"speed_override": 1})").status, 200);
  until(listener, "l", "succeeded");
  for (const char* path : {"/api/v1/speed", "/api/v1/arms/left/speed"}) {
    for (const char* share : {"-0.1", "1.5", "0.0001"}) {
      expect_refused(put(path, std::string(R"({"speed_override": )") + share + "}"), 422,
                     "/speed_override", std::stod(share));
    }
    expect_refused(put(path, "{}"), 422, "/speed_override", nullptr);
  }
  EXPECT_EQ(get("/api/v1/speed").json()["speed_override"], 0.5);
  expect_refused(put("/api/v1/arms/middle/speed", R"({"speed_override": 1})"), 404,
                 "request target", "middle");
}

TEST_F(Verbs, InvalidFaultsAreRefusedWithPlaceAndValue) {
  start(1.0);
  const std::string faults = "/api/v1/sim/faults";
  expect_refused(post(faults, R"({"arm": "middle", "kind": "stall"})"), 422, "/arm", "middle");
  expect_refused(post(faults, R"({"arm": "left", "kind": "hiccup"})"), 422, "/kind", "hiccup");
  expect_refused(post(faults, R"({"arm": "left", "kind": "loss", "value": 1.1})"), 422, "/value",
                 1.1);
  expect_refused(post(faults, R"({"arm": "left", "kind": "drift", "value": -11})"), 422, "/value",
                 -11);
  expect_refused(post(faults, R"({"arm": "left", "kind": "reject", "for_s": 1})"), 422, "/for_s",
                 1);
  expect_refused(post(faults, R"({"arm": "left", "kind": "runaway", "value": 1})"), 422, "/value",
                 1);
  expect_refused(post(faults, R"({"arm": "left", "kind": "slow"})"), 422, "/value", nullptr);
  expect_refused(post(faults, R"({"arm": "left", "kind": "slow", "value": 1.5})"), 422, "/value",
                 1.5);
  expect_refused(post(faults, R"({"arm": "left", "kind": "stall", "for_s": -1})"), 422, "/for_s",
                 -1);
  expect_refused(post(faults, R"({"arm": "left", "kind": "stall", "value": 0.5})"), 422, "/value",
                 0.5);
  expect_refused(post(faults, R"({"arm": "left", "kind": "fault", "value": 1})"), 422, "/value", 1);
  expect_refused(post(faults, R"({"arm": "left", "kind": "fault", "for_s": 1})"), 422, "/for_s", 1);
  expect_refused(post(faults, R"({"arm": "left", "kind": "stall", "when": 1})"), 422, "/when", 1);
  expect_refused(remove(faults + "/1"), 404, "request target", "1");
  expect_refused(remove(faults + "/x"), 404, "request target", "x");
  const auto slow = post(faults, R"({"arm": "left", "kind": "slow", "value": 0.5, "at_s": 1})");
  EXPECT_EQ(slow.status, 201) << slow.body;
  EXPECT_EQ(slow.json()["kind"], "slow");
  EXPECT_EQ(slow.json()["at_s"], 1.0);
  const auto drift = post(faults, R"({"arm": "left", "kind": "drift", "at_s": 1000})");
  EXPECT_EQ(drift.status, 201) << drift.body;
  EXPECT_EQ(drift.json()["value"], 0.1) << "the default";
  EXPECT_EQ(remove(slow.headers.at("location")).status, 204);
}

TEST_F(Verbs, ListsFaultsUntilTheyAreOver) {
  start(50.0);
  const std::string faults = "/api/v1/sim/faults";
  EXPECT_EQ(get(faults).json()["faults"], json::array());
  const auto add = [&](const json& fault) { ASSERT_EQ(post(faults, fault.dump()).status, 201); };
  add({{"arm", "right"}, {"kind", "delay"}, {"value", 0.01}, {"at_s", 1e5}, {"for_s", 2}});
  add({{"arm", "left"}, {"kind", "slow"}, {"value", 0.5}});
  add({{"arm", "left"}, {"kind", "noise"}, {"for_s", 1e5}});
  add({{"arm", "right"}, {"kind", "reject"}});
  add({{"arm", "right"}, {"kind", "stall"}, {"for_s", 0.01}});
  json list = get(faults).json();
  for (int i = 0; i < 1000 && list["faults"].size() > 4; ++i) list = get(faults).json();
  ASSERT_EQ(list["faults"].size(), 4U) << "fault 5 is over: " << list;
  EXPECT_EQ(list["faults"][0], json({{"id", "1"},
                                     {"arm", "right"},
                                     {"kind", "delay"},
                                     {"value", 0.01},
                                     {"at_s", 1e5},
                                     {"for_s", 2.0},
                                     {"remaining_s", 2.0}}));
  const json& slow = list["faults"][1];
  EXPECT_EQ(slow["arm"], "left");
  EXPECT_LE(slow["at_s"], list["t_s"]);
  EXPECT_TRUE(slow["for_s"].is_null() && slow["remaining_s"].is_null()) << slow;
  const json& noise = list["faults"][2];
  EXPECT_EQ(noise["value"], 0.01) << "the default";
  EXPECT_NEAR(noise["remaining_s"].get<double>(),
              noise["at_s"].get<double>() + 1e5 - list["t_s"].get<double>(), 1e-6);
  // With noise beyond the tracking error of the left arm, the guard lets no arm move beside it.
  EXPECT_EQ(remove(faults + "/3").status, 204);
  // `reject` is over when it has occurred.
  test::Listener listener(port());
  ASSERT_EQ(post("/api/v1/jobs", job("r", test::kHome, kAside, "right").dump()).status, 202);
  next_job(listener, "r", [](const json& job) { return !job["result"].is_null(); });
  EXPECT_EQ(remove(faults + "/2").status, 204);
  list = get(faults).json()["faults"];
  ASSERT_EQ(list.size(), 1U) << list;
  EXPECT_EQ(list[0]["id"], "1");
}

}  // namespace
}  // namespace armloom
