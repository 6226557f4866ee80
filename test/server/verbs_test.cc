// The verbs beyond jobs: batches, checks, the scene, single arms, the simulation; good and bad.
#include <gtest/gtest.h>

#include "test/server/panda_jobs.h"
#include "test/server/running_server.h"

namespace armloom {
namespace {

using nlohmann::json;

json job(const std::string& id, const test::Pose& from, const test::Pose& to,
         const std::string& arm = "left", double duration_s = 3.0) {
  json body = test::move(arm, from, to, duration_s);
  body["id"] = id;
  return body;
}

constexpr test::Pose kAside{1.2, -1.2, 0, -2.6, 0, 1.6, 0.785};  // turned away from the other

class Verbs : public test::RunningServer {
 protected:
  void expect_refused(const test::Answer& answer, int status, const std::string& pointer,
                      const json& value) {
    EXPECT_EQ(answer.status, status) << answer.body;
    EXPECT_EQ(answer.headers.at("content-type"), "application/problem+json");
    EXPECT_EQ(answer.json()["pointer"], pointer) << answer.body;
    EXPECT_EQ(answer.json()["value"], value) << answer.body;
  }
  std::size_t jobs_stored() { return get("/api/v1/jobs").json()["jobs"].size(); }
};

// ---- Batches ----

TEST_F(Verbs, ABatchRunsInItsOrder) {
  start(20.0);
  test::Listener listener(port());
  json there = job("there", test::kHome, test::kMiddle);
  json back = job("back", test::kMiddle, test::kHome);
  json other = job("other", test::kHome, kAside, "right");
  other["after"] = {"there"};
  const auto answer =
      post("/api/v1/batches", json({{"jobs", {there, back, other}}, {"atomic", true}}).dump());
  ASSERT_EQ(answer.status, 202) << answer.body;
  EXPECT_EQ(answer.json()["jobs"][2]["id"], "other");
  const json ended_there = until(listener, "there", "succeeded");
  const json begun = until(listener, "other", "running");
  EXPECT_GE(begun["started_s"], ended_there["ended_s"]);
}

TEST_F(Verbs, AnAtomicBatchWithOneBadJobStoresNothing) {
  start(1.0);
  json bad = job("bad", test::kMiddle, test::kHome);
  bad["trajectory"]["points"][3]["velocities"][1] = 3.41;
  const json batch = {{"jobs", {job("good", test::kHome, test::kMiddle), bad}}};
  expect_refused(post("/api/v1/batches", batch.dump()), 422,
                 "/jobs/1/trajectory/points/3/velocities/1", 3.41);
  bad["trajectory"] = 7;
  const json unreadable = {{"jobs", {job("good", test::kHome, test::kMiddle), bad}}};
  expect_refused(post("/api/v1/batches", unreadable.dump()), 400, "/jobs/1/trajectory", 7);
  const json twice = {
      {"jobs", {job("a", test::kHome, test::kMiddle), job("a", test::kMiddle, test::kHome)}}};
  expect_refused(post("/api/v1/batches", twice.dump()), 409, "/jobs/1/id", "a");
  EXPECT_EQ(jobs_stored(), 0U);
}

TEST_F(Verbs, ABatchThatIsNotAtomicAnswersForEachJobInItsPlace) {
  start(1.0);
  json unreadable = job("x", test::kHome, test::kMiddle);
  unreadable["priority"] = "high";
  const json batch = {{"atomic", false},
                      {"jobs",
                       {unreadable, job("a", test::kHome, test::kMiddle),
                        job("astray", test::kHome, test::kMiddle)}}};
  const auto answer = post("/api/v1/batches", batch.dump());
  ASSERT_EQ(answer.status, 207) << answer.body;
  const json results = answer.json()["results"];
  ASSERT_EQ(results.size(), 3U);
  EXPECT_EQ(results[0]["status"], 400);
  EXPECT_EQ(results[0]["problem"]["pointer"], "/priority");
  EXPECT_EQ(results[1]["status"], 202);
  EXPECT_EQ(results[1]["job"]["id"], "a");
  EXPECT_EQ(results[2]["status"], 422);  // the arm will not stand there
  EXPECT_EQ(results[2]["problem"]["value"], test::kHome[1]);
  EXPECT_EQ(jobs_stored(), 1U);
}

TEST_F(Verbs, ABatchIsBoundedAndNotEmpty) {
  start(1.0);
  expect_refused(post("/api/v1/batches", R"({"jobs": []})"), 422, "/jobs", "array of 0");
  const json many = {{"jobs", std::vector<json>(1001, json::object())}};
  expect_refused(post("/api/v1/batches", many.dump()), 413, "/jobs", "array of 1001");
  expect_refused(post("/api/v1/batches", R"({"jobs": [{}], "all": 1})"), 422, "/all", 1);
  expect_refused(post("/api/v1/batches", R"({"jobs": [{}], "atomic": 1})"), 400, "/atomic", 1);
}

// ---- Predecessors ----

TEST_F(Verbs, AfterHasToNameAJobThatCameBefore) {
  start(1.0);
  json lonely = job("a", test::kHome, test::kMiddle);
  lonely["after"] = {"nobody"};
  expect_refused(post("/api/v1/jobs", lonely.dump()), 422, "/after/0", "nobody");
  lonely["after"] = {"a"};
  expect_refused(post("/api/v1/jobs", lonely.dump()), 422, "/after/0", "a");
  // In a batch: the later one; and so no ring can be made.
  lonely["after"] = {"b"};
  json second = job("b", test::kMiddle, test::kHome);
  second["after"] = {"a"};
  expect_refused(post("/api/v1/batches", json({{"jobs", {lonely, second}}}).dump()), 422,
                 "/jobs/0/after/0", "b");
  EXPECT_EQ(jobs_stored(), 0U);
}

// ---- Checks ----

TEST_F(Verbs, ACheckIsAdmissionsOwnAnswerAndChangesNothing) {
  start(20.0);
  test::Listener listener(port());
  const json free =
      post("/api/v1/check", job("x", test::kHome, test::kMiddle, "right").dump()).json();
  EXPECT_EQ(free["verdict"], "free");
  EXPECT_EQ(free["earliest_start_s"], 0.0);
  EXPECT_EQ(free["conflicts"], json::array());
  EXPECT_GT(free["evaluations"], 0);
  EXPECT_EQ(jobs_stored(), 0U);

  ASSERT_EQ(post("/api/v1/jobs", job("l", test::kHome, test::kMiddle).dump()).status, 202);
  until(listener, "l", "succeeded");
  // The left arm rests in the way now, and would go aside for it.
  const json later =
      post("/api/v1/check", job("x", test::kHome, test::kMiddle, "right").dump()).json();
  EXPECT_EQ(later["verdict"], "free");
  EXPECT_TRUE(later["earliest_start_s"].is_number());
  ASSERT_EQ(post("/api/v1/arms/left/stop", "").status, 202);  // stopped, it stays
  const json conflict =
      post("/api/v1/check", job("x", test::kHome, test::kMiddle, "right").dump()).json();
  EXPECT_EQ(conflict["verdict"], "conflict");
  EXPECT_TRUE(conflict["earliest_start_s"].is_null());
  ASSERT_EQ(conflict["conflicts"].size(), 1U) << conflict;
  EXPECT_EQ(conflict["conflicts"][0]["kind"], "arm");
  EXPECT_EQ(conflict["conflicts"][0]["arm"], "left");
  EXPECT_EQ(conflict["conflicts"][0]["links"].size(), 2U);
  EXPECT_EQ(jobs_stored(), 1U);

  json bad = job("y", test::kHome, test::kMiddle, "right");
  bad["trajectory"]["joint_names"][2] = "elbow";
  expect_refused(post("/api/v1/check", bad.dump()), 422, "/trajectory/joint_names/2", "elbow");
}

// ---- The scene ----

TEST_F(Verbs, ObjectsComeMoveAndGoAndEveryoneIsTold) {
  start(1.0);
  test::Listener listener(port());
  const std::uint64_t version = get("/api/v1/scene").json()["version"];
  const auto added = post("/api/v1/scene/objects",
                          R"({"name": "rod 1", "cylinder": [0.01, 0.3], "xyz": [0, 0.9, 0.5]})");
  ASSERT_EQ(added.status, 201) << added.body;
  EXPECT_EQ(added.headers.at("location"), "/api/v1/scene/objects/rod%201");
  EXPECT_EQ(added.json()["version"], version + 1);
  EXPECT_EQ(added.json()["object"]["cylinder"], json({0.01, 0.3}));
  EXPECT_EQ(listener.next_of("scene")["data"]["objects"].back()["name"], "rod 1");

  const auto moved =
      put("/api/v1/scene/objects/rod%201", R"({"sphere": [0.05], "xyz": [0, 1, 0.5]})");
  EXPECT_EQ(moved.status, 200) << moved.body;
  EXPECT_EQ(get("/api/v1/scene").json()["objects"].back()["sphere"], json({0.05}));
  EXPECT_EQ(put("/api/v1/scene/objects/new", R"({"name": "new", "box": [0.1, 0.1, 0.1],
                 "xyz": [0, 1.2, 0.5]})")
                .status,
            201);
  const auto removed = remove("/api/v1/scene/objects/rod%201");
  EXPECT_EQ(removed.status, 200);
  EXPECT_EQ(removed.json()["version"], version + 4);
  expect_refused(remove("/api/v1/scene/objects/rod%201"), 404, "", "rod 1");
}

TEST_F(Verbs, ObjectsThatCannotBeAreRefusedWithPlaceAndValue) {
  start(1.0);
  const std::string objects = "/api/v1/scene/objects";
  const std::uint64_t version = get("/api/v1/scene").json()["version"];
  expect_refused(post(objects, R"({"name": "table", "sphere": [0.1], "xyz": [0, 1, 1]})"), 409,
                 "/name", "table");
  expect_refused(post(objects, R"({"name": "m", "mesh": "/etc/passwd"})"), 422, "/mesh",
                 "/etc/passwd");
  expect_refused(post(objects, R"({"name": "b", "box": [1, 0, 1]})"), 422, "/box", "array of 3");
  expect_refused(post(objects, R"({"name": "b", "box": [1, 1]})"), 422, "/box", "array of 2");
  expect_refused(post(objects, R"({"name": "b"})"), 422, "", "object");
  expect_refused(post(objects, R"({"name": "b", "box": [1, 1, 1], "sphere": [1]})"), 422, "",
                 "object");
  expect_refused(post(objects, R"({"sphere": [1]})"), 422, "/name", nullptr);
  expect_refused(post(objects, R"({"name": "a/b", "sphere": [1]})"), 422, "/name", "a/b");
  expect_refused(post(objects, R"({"name": "..", "sphere": [1]})"), 422, "/name", "..");
  expect_refused(post(objects, R"({"name": "a\u007f", "sphere": [1]})"), 422, "/name", "a\x7f");
  expect_refused(
      post(objects, R"({"name": "left_panda_link4", "sphere": [0.1], "xyz": [3, 0, 1]})"), 409,
      "/name", "left_panda_link4");
  expect_refused(put(objects + "/left", R"({"sphere": [0.1], "xyz": [3, 0, 1]})"), 409, "/name",
                 "left");
  expect_refused(post(objects, R"({"name": "f", "sphere": [1], "xyz": [0, 0, 1e300]})"), 422,
                 "/xyz", "array of 3");
  expect_refused(post(objects, R"({"name": "f", "sphere": [1], "colour": "red"})"), 422, "/colour",
                 "red");
  expect_refused(put(objects + "/a", R"({"name": "b", "sphere": [1]})"), 422, "/name", "b");
  const auto into_arm = post(objects, R"({"name": "b", "sphere": [0.3], "xyz": [-0.4, 0, 0.5]})");
  EXPECT_EQ(into_arm.status, 409) << into_arm.body;
  EXPECT_EQ(into_arm.json()["type"], "urn:armloom:problem:object-in-arm");
  EXPECT_NE(into_arm.json()["detail"].get<std::string>().find("left_panda"), std::string::npos);
  EXPECT_EQ(get("/api/v1/scene").json()["version"], version);
}

TEST_F(Verbs, AnObjectInTheWayMakesAJobWaitUntilItIsTakenAway) {
  start(20.0);
  test::Listener listener(port());
  ASSERT_EQ(
      post("/api/v1/scene/objects", R"({"name": "ball", "sphere": [0.1], "xyz": [0.05, 0, 1.0]})")
          .status,
      201);
  ASSERT_EQ(post("/api/v1/jobs", job("l", test::kHome, test::kMiddle).dump()).status, 202);
  const json waits = until(listener, "l", "backlogged")["waits_on"][0];
  EXPECT_EQ(waits["kind"], "object") << waits;
  EXPECT_EQ(waits["links"][1], "ball");
  ASSERT_EQ(remove("/api/v1/scene/objects/ball").status, 200);
  until(listener, "l", "succeeded");
}

// ---- Single arms ----

TEST_F(Verbs, OneArmStopsAndResumesAlone) {
  start(5.0);
  test::Listener listener(port());
  ASSERT_EQ(post("/api/v1/jobs", job("l", test::kHome, kAside).dump()).status, 202);
  ASSERT_EQ(post("/api/v1/jobs", job("r", test::kHome, kAside, "right").dump()).status, 202);
  until(listener, "l", "running");
  const auto stopped = post("/api/v1/arms/left/stop", "");
  EXPECT_EQ(stopped.status, 202) << stopped.body;
  EXPECT_EQ(stopped.json()["name"], "left");
  until(listener, "l", "holding");
  EXPECT_EQ(get("/api/v1/queue").json()["stopped"], false);
  until(listener, "r", "succeeded");
  EXPECT_EQ(get("/api/v1/jobs/l").json()["state"], "holding");
  EXPECT_EQ(post("/api/v1/arms/left/resume", "").status, 202);
  until(listener, "l", "succeeded");
  expect_refused(post("/api/v1/arms/middle/stop", ""), 404, "request target", "middle");
  expect_refused(post("/api/v1/arms/middle/resume", ""), 404, "request target", "middle");
}

// T6 over HTTP: the other one holds while the stall lasts, and goes on by itself.
TEST_F(Verbs, AStalledArmStopsOnlyTheOneThatItEndangers) {
  start(5.0);
  test::Listener listener(port());
  // Up in the middle and down again; the other one comes to the middle when it has left.
  const json there_and_back = {{"jobs",
                                {job("there", test::kHome, test::kMiddle),
                                 job("back", test::kMiddle, test::kHome, "left", 6.0)}}};
  ASSERT_EQ(post("/api/v1/batches", there_and_back.dump()).status, 202);
  until(listener, "back", "running");
  ASSERT_EQ(
      post("/api/v1/jobs", job("other", test::kHome, test::kMiddle, "right", 9.0).dump()).status,
      202);
  until(listener, "other", "running");
  const auto stalled =
      post("/api/v1/sim/faults", R"({"arm": "left", "kind": "stall", "for_s": 20})");
  ASSERT_EQ(stalled.status, 201) << stalled.body;
  const json holding = until(listener, "other", "holding");
  EXPECT_EQ(holding["waits_on"][0]["id"], "back") << holding;
  EXPECT_EQ(get("/api/v1/jobs/back").json()["state"], "running");  // late, not ended
  const std::string id = stalled.json()["id"];
  EXPECT_EQ(remove("/api/v1/sim/faults/" + id).status, 204);
  for (const std::string key : {"back", "other"}) {  // whichever is first
    while (get("/api/v1/jobs/" + key).json()["state"] != "succeeded") {
    }
  }
}

// T7 over HTTP.
TEST_F(Verbs, ACanceledJobIsStoppingUntilAtRestAndTheOtherArmGoesOn) {
  start(1.0);
  test::Listener listener(port());
  ASSERT_EQ(post("/api/v1/jobs", job("l", test::kHome, kAside).dump()).status, 202);
  ASSERT_EQ(post("/api/v1/jobs", job("r", test::kHome, kAside, "right").dump()).status, 202);
  until(listener, "r", "running");
  while (get("/api/v1/jobs/l").json()["progress"] < 0.3) {
  }
  const auto canceled = remove("/api/v1/jobs/l");
  EXPECT_EQ(canceled.status, 202) << canceled.body;
  EXPECT_EQ(canceled.json()["stopping"], true);
  EXPECT_TRUE(canceled.json()["result"].is_null());
  const json ended = until(listener, "l", "canceled");
  EXPECT_EQ(ended["stopping"], false);
  EXPECT_LT(ended["progress"], 1.0);
  const double q = get("/api/v1/arms/left").json()["q"][0];
  EXPECT_GT(q, 0.05);  // on its way, where it stands
  EXPECT_LT(q, kAside[0] - 0.05);
  until(listener, "r", "succeeded");
  // The reservation has shrunk to that place: the arm can be sent on from there.
  test::Pose stands = test::kHome;
  const json measured = get("/api/v1/arms/left").json()["q"];
  for (std::size_t j = 0; j < 7; ++j) stands[j] = measured[j];
  EXPECT_EQ(post("/api/v1/jobs", job("on", stands, test::kHome).dump()).status, 202);
}

// ---- The simulation ----

TEST_F(Verbs, TheSpeedChangesAndWallTimesStayRight) {
  start(1.0);
  test::Listener listener(port());
  const auto changed = put("/api/v1/sim/speed", R"({"speed": 50})");
  ASSERT_EQ(changed.status, 200) << changed.body;
  EXPECT_EQ(changed.json()["speed"], 50.0);
  EXPECT_EQ(get("/api/v1/cell").json()["speed"], 50.0);
  ASSERT_EQ(post("/api/v1/jobs", job("l", test::kHome, kAside, "left", 10.0).dump()).status, 202);
  const json ended = until(listener, "l", "succeeded");
  const auto second_of = [](const std::string& at) { return std::stod(at.substr(17, 6)); };
  double took_s = second_of(ended["ended_at"]) - second_of(ended["started_at"]);
  if (took_s < 0.0) took_s += 60.0;
  EXPECT_LT(took_s, 5.0);  // 10 s in the cell, 0.2 s on the wall; a busy machine slips
  EXPECT_GT(took_s, 0.1);
  EXPECT_EQ(get("/api/v1/jobs/l").json(), ended);
  for (const char* speed : {"0", "-1", "1000.5"}) {
    expect_refused(put("/api/v1/sim/speed", std::string(R"({"speed": )") + speed + "}"), 422,
                   "/speed", std::stod(speed));
  }
  expect_refused(put("/api/v1/sim/speed", R"({"speed": "fast"})"), 400, "/speed", "fast");
  expect_refused(put("/api/v1/sim/speed", "{}"), 422, "/speed", nullptr);
}

TEST_F(Verbs, FaultsThatCannotBeAreRefusedWithPlaceAndValue) {
  start(1.0);
  const std::string faults = "/api/v1/sim/faults";
  expect_refused(post(faults, R"({"arm": "middle", "kind": "stall"})"), 422, "/arm", "middle");
  expect_refused(post(faults, R"({"arm": "left", "kind": "runaway"})"), 422, "/kind", "runaway");
  EXPECT_EQ(post(faults, R"({"arm": "left", "kind": "runaway"})").json()["type"],
            "urn:armloom:problem:unsupported-fault");
  expect_refused(post(faults, R"({"arm": "left", "kind": "hiccup"})"), 422, "/kind", "hiccup");
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
  EXPECT_EQ(remove(slow.headers.at("location")).status, 204);
}

}  // namespace
}  // namespace armloom
