#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "server/messages/job_request.h"
#include "test/server/panda_jobs.h"

namespace armloom {
namespace {

using nlohmann::json;

double job_time_s(const json& trajectory) {
  const json& last = trajectory["points"].back()["time_from_start"];
  return last.is_number() ? last.get<double>()
                          : last["sec"].get<double>() + 1e-9 * last["nanosec"].get<double>();
}

TEST(JobCodec, ReadsOnTimeoutAndMoveToStart) {
  const auto job = read_job_text(
      R"({"on_timeout": "replan", "move_to_start": "plan",
          "trajectory": {"joint_names": ["a"], "points": [
            {"positions": [1], "velocities": [0], "time_from_start": 0}]}})");
  ASSERT_TRUE(job) << job.error().front().detail;
  EXPECT_EQ(job->terms.on_timeout, OnTimeout::replan);
  EXPECT_EQ(job->terms.move_to_start, MoveToStart::plan);
  const auto bad =
      read_job_text(R"({"on_timeout": "retry", "arm": "a", "move_to": {"named": "b"}})");
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().front().pointer, "/on_timeout");
}

TEST(JobCodec, ReadsAllMembersOfATrajectoryJob) {
  const auto job = read_job_text(R"({
    "id": "pick-7", "name": "pick 7", "priority": -3, "backlog_timeout_s": 1.5,
    "after": [], "on_timeout": "abort", "retime": false,
    "trajectory": {
      "header": {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": ""},
      "joint_names": ["a", "b"],
      "points": [
        {"positions": [1, 2], "velocities": [0, 0], "accelerations": [], "effort": [],
         "time_from_start": {"sec": 0, "nanosec": 0}},
        {"positions": [1.5, 2], "velocities": [0, 0],
         "time_from_start": {"sec": 2, "nanosec": 250000000}},
        {"positions": [1.5, 2], "time_from_start": 3.5},
        {"positions": [1.5, 2], "time_from_start": {"secs": 4, "nsecs": 5}}]}})");
  ASSERT_TRUE(job) << job.error().front().detail;
  EXPECT_EQ(job->key, "pick-7");
  EXPECT_EQ(job->name, "pick 7");
  EXPECT_EQ(job->terms.priority, -3);
  EXPECT_EQ(job->terms.backlog_timeout, std::chrono::milliseconds(1500));
  EXPECT_EQ(job->trajectory.joint_names, (std::vector<std::string>{"a", "b"}));
  ASSERT_EQ(job->trajectory.points.size(), 4U);
  EXPECT_EQ(job->trajectory.points[1].time_from_start_s, 2.25);
  EXPECT_EQ(job->trajectory.points[2].time_from_start_s, 3.5);
  EXPECT_DOUBLE_EQ(job->trajectory.points[3].time_from_start_s, 4.000000005);
  EXPECT_TRUE(job->trajectory.points[0].accelerations.empty());
}

struct BadField {
  const char* name;
  const char* at;     // JSON pointer to the value to spoil
  const char* value;  // JSON text; nullptr to remove the member
  ProblemKind kind;
  const char* says;
  const char* pointer = nullptr;  // of the problem, if different from `at`
};

void PrintTo(const BadField& bad, std::ostream* out) { *out << bad.name; }

class BadJob : public ::testing::TestWithParam<BadField> {};

TEST_P(BadJob, IsRefusedWithPointerAndValue) {
  json body = test::move("left", test::kHome, test::kMiddle);
  const json::json_pointer place(GetParam().at);
  if (GetParam().value == nullptr) {
    body[place.parent_pointer()].erase(place.back());
  } else {
    body[place] = json::parse(GetParam().value);
  }
  const auto job = read_job(body);
  ASSERT_FALSE(job);
  ASSERT_EQ(job.error().size(), 1U);
  const Problem& problem = job.error().front();
  EXPECT_EQ(problem.pointer, GetParam().pointer != nullptr ? GetParam().pointer : GetParam().at);
  EXPECT_EQ(problem.kind, GetParam().kind);
  EXPECT_NE(problem.detail.find(GetParam().says), std::string::npos) << problem.detail;
  EXPECT_EQ(std::holds_alternative<std::monostate>(problem.value), GetParam().value == nullptr);
}

constexpr auto kMalformed = ProblemKind::malformed;
constexpr auto kInvalid = ProblemKind::invalid;

INSTANTIATE_TEST_SUITE_P(
    Table, BadJob,
    ::testing::Values(
        BadField{"NoTrajectory", "/trajectory", nullptr, kInvalid, "missing"},
        BadField{"TrajectoryIsText", "/trajectory", "\"x\"", kMalformed, "an object"},
        BadField{"NoNames", "/trajectory/joint_names", nullptr, kInvalid, "missing"},
        BadField{"NameIsNumber", "/trajectory/joint_names/2", "7", kMalformed, "a string"},
        BadField{"PointsIsObject", "/trajectory/points", "{}", kMalformed, "an array"},
        BadField{"PositionIsText", "/trajectory/points/3/positions/2", "\"NaN\"", kMalformed,
                 "a number"},
        BadField{"PositionIsNull", "/trajectory/points/3/positions/2", "null", kMalformed,
                 "a number"},
        BadField{"TimeIsText", "/trajectory/points/4/time_from_start", "\"1\"", kMalformed, "sec"},
        BadField{"NanosecTooLarge", "/trajectory/points/4/time_from_start",
                 R"({"sec": 1, "nanosec": 1000000000})", kInvalid, "1000000000",
                 "/trajectory/points/4/time_from_start/nanosec"},
        BadField{"SecIsFraction", "/trajectory/points/4/time_from_start",
                 R"({"sec": 1.5, "nanosec": 0})", kMalformed, "an integer",
                 "/trajectory/points/4/time_from_start/sec"},
        BadField{"SecIsHuge", "/trajectory/points/4/time_from_start",
                 R"({"sec": 18446744073709551615, "nanosec": 0})", kInvalid, "not within",
                 "/trajectory/points/4/time_from_start/sec"},
        BadField{"UnknownField", "/trajectoy", "1", kInvalid, "unknown field \"trajectoy\""},
        BadField{"UnknownInPoint", "/trajectory/points/0/postions", "[]", kInvalid,
                 "unknown field"},
        BadField{"IdWithSlash", "/id", "\"a/b\"", kInvalid, "128"},
        BadField{"IdIsDots", "/id", "\"..\"", kInvalid, "128"},
        BadField{"IdEmpty", "/id", "\"\"", kInvalid, "128"},
        BadField{"NameWithNewline", "/name", "\"a\\nb\"", kInvalid, "control"},
        BadField{"PriorityIsFraction", "/priority", "1.5", kMalformed, "an integer"},
        BadField{"PriorityIsHuge", "/priority", "99999999999", kInvalid, "not within"},
        BadField{"TimeoutIsNegative", "/backlog_timeout_s", "-1", kInvalid, "not within"},
        BadField{"AfterIsText", "/after", "\"x\"", kMalformed, "an array"},
        BadField{"AfterHoldsNoId", "/after", "[\"x\", \"a b\"]", kInvalid, "128", "/after/1"},
        BadField{"FasterThanPlanned", "/velocity_scaling_factor", "2", kInvalid, "0.001..1"},
        BadField{"RetimeIsNoFlag", "/retime", "1", kMalformed, "true, false"}),
    [](const auto& tested) { return tested.param.name; });

TEST(JobCodec, ReadsPathsWithoutTimes) {
  json body = test::move("left", test::kHome, test::kMiddle);
  for (json& point : body["trajectory"]["points"]) point = {{"positions", point["positions"]}};
  body["retime"] = true;
  body["velocity_scaling_factor"] = 0.25;
  const auto job = read_job(body);
  ASSERT_TRUE(job) << job.error().front().detail;
  ASSERT_TRUE(job->trajectory.retime);
  EXPECT_EQ(job->trajectory.retime->velocity, 0.25);
  EXPECT_TRUE(std::isnan(job->trajectory.points[0].time_from_start_s));
  body["retime"] = false;
  EXPECT_FALSE(read_job(body).value().trajectory.retime);
}

TEST(JobCodec, ReadsPredecessors) {
  json body = test::move("left", test::kHome, test::kMiddle);
  body["after"] = {"place-6", "x"};
  const auto job = read_job(body);
  ASSERT_TRUE(job);
  EXPECT_EQ(job->after, (std::vector<std::string>{"place-6", "x"}));
  body["after"] = std::vector<std::string>(101, "x");
  EXPECT_EQ(read_job(body).error().front().kind, ProblemKind::too_large);
}

TEST(JobCodec, ScalesATrajectoryInTime) {
  json body = test::move("left", test::kHome, test::kMiddle);
  const TrajectoryRequest whole = read_job(body).value().trajectory;
  body["velocity_scaling_factor"] = 0.5;
  const TrajectoryRequest half = read_job(body).value().trajectory;
  ASSERT_EQ(half.points.size(), whole.points.size());
  for (std::size_t i = 0; i < whole.points.size(); ++i) {
    EXPECT_EQ(half.points[i].positions, whole.points[i].positions);
    EXPECT_EQ(half.points[i].time_from_start_s, 2 * whole.points[i].time_from_start_s);
    EXPECT_EQ(half.points[i].velocities[1], whole.points[i].velocities[1] / 2);
    EXPECT_EQ(half.points[i].accelerations[1], whole.points[i].accelerations[1] / 4);
  }
}

TEST(JobCodec, ReadsAlternatives) {
  json body = test::move("left", test::kHome, test::kMiddle);
  const json motion = body["trajectory"];
  body["alternatives"] = {motion, motion};
  const auto both = read_job_text(body.dump());
  ASSERT_FALSE(both);
  EXPECT_NE(both.error().front().detail.find("trajectory"), std::string::npos);
  body.erase("trajectory");
  body["velocity_scaling_factor"] = 0.5;
  const auto job = read_job_text(body.dump());
  ASSERT_TRUE(job) << job.error().front().detail;
  ASSERT_EQ(job->motions().size(), 2U);
  EXPECT_EQ(job->motions()[1].place, "/alternatives/1");
  EXPECT_DOUBLE_EQ(job->alternatives[1].points.back().time_from_start_s, 2.0 * job_time_s(motion));
  body["alternatives"] = {motion};
  const auto one = read_job_text(body.dump());
  ASSERT_FALSE(one);
  EXPECT_EQ(one.error().front().pointer, "/alternatives");
}

TEST(BatchCodec, AppliesReorderableToJobsWithoutIt) {
  json free = test::move("left", test::kHome, test::kMiddle);
  json given = free;
  given["reorderable"] = false;
  for (const bool atomic : {true, false}) {
    const json body = {{"jobs", {free, given}}, {"reorderable", true}, {"atomic", atomic}};
    const auto batch = read_batch_text(body.dump());
    ASSERT_TRUE(batch) << batch.error().front().detail;
    EXPECT_TRUE(batch->jobs[0].job->terms.reorderable);
    EXPECT_FALSE(batch->jobs[1].job->terms.reorderable);
    EXPECT_EQ(json::parse(batch->jobs[0].text)["reorderable"], true) << "as it is recorded";
  }
  json wrong = free;
  wrong["reorderable"] = "random";
  const auto refused = read_job_text(wrong.dump());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().pointer, "/reorderable");
}

TEST(JobCodec, ReadsMoveItsNestedTrajectoryWithCorrectPointers) {
  json body = test::move("left", test::kHome, test::kMiddle);
  const auto plain = read_job(body);
  body["trajectory"] = {
      {"joint_trajectory", body["trajectory"]},
      {"multi_dof_joint_trajectory",
       {{"header", json::object()}, {"joint_names", json::array()}, {"points", json::array()}}}};
  const auto nested = read_job(body);
  ASSERT_TRUE(nested) << nested.error().front().detail;
  EXPECT_EQ(nested->trajectory.joint_names, plain->trajectory.joint_names);
  EXPECT_EQ(nested->trajectory.points.size(), plain->trajectory.points.size());

  json moves_a_base = body;
  moves_a_base["trajectory"]["multi_dof_joint_trajectory"]["joint_names"] = {"base"};
  EXPECT_EQ(read_job(moves_a_base).error().front().pointer,
            "/trajectory/multi_dof_joint_trajectory/joint_names");
  json unreadable = body;
  unreadable["trajectory"]["joint_trajectory"]["points"][1]["positions"][0] = "x";
  EXPECT_EQ(read_job(unreadable).error().front().pointer,
            "/trajectory/joint_trajectory/points/1/positions/0");
  json twice = body;
  twice["trajectory"] = {{"joint_trajectory", body["trajectory"]}};
  EXPECT_EQ(read_job(twice).error().front().pointer, "/trajectory/joint_trajectory");
}

TEST(JobCodec, ReportsAllFaultsAtOnce) {
  json body = test::move("left", test::kHome, test::kMiddle);
  body["id"] = "a b";
  body["priority"] = "high";
  body["trajectory"]["points"][2]["positions"][0] = nullptr;
  const auto job = read_job(body);
  ASSERT_FALSE(job);
  EXPECT_EQ(job.error().size(), 3U);
}

TEST(JobCodec, BoundsTheListOfFaults) {
  json body = test::move("left", test::kHome, test::kMiddle);
  body["trajectory"]["points"][0]["positions"] = std::vector<std::string>(1000, "x");
  const auto job = read_job(body);
  ASSERT_FALSE(job);
  EXPECT_EQ(job.error().size(), 20U);
}

TEST(Steps, AreReadInOrder) {
  const auto job = read_job(json::parse(R"({"steps": [
      {"move_to": {"named": "ready"}, "arm": "left", "name": "down",
       "triggers": [{"at": 0.9, "set_io": {"name": "b", "value": 2}},
                    {"at": 0.5, "set_io": {"name": "a", "value": true}}]},
      {"gripper": {"arm": "left", "width_m": 0.04}},
      {"attach": {"object": "rod", "link": "left_panda_hand", "touch": ["table"]}},
      {"wait_s": 0.5}, {"set_io": {"name": "a", "value": false}},
      {"wait_io": {"name": "b", "value": 3, "timeout_s": 2}},
      {"detach": {"object": "rod"}}]})"));
  ASSERT_TRUE(job);
  std::string kinds;
  for (const StepRequest& step : job->steps) kinds += std::string(kind_of(step)) + " ";
  EXPECT_EQ(kinds, "move_to gripper attach wait_s set_io wait_io detach ");
  EXPECT_EQ(job->steps[0].name, "down");
  const auto& triggers = std::get<MotionStepRequest>(job->steps[0].what).triggers;
  ASSERT_EQ(triggers.size(), 2U);
  EXPECT_EQ(triggers[0].signal, "a") << "in order of their shares";
  EXPECT_EQ(std::get<WaitIoRequest>(job->steps[5].what).timeout, std::chrono::seconds(2));
}

TEST(Steps, AreRefusedWithPointers) {
  const std::pair<const char*, const char*> cases[] = {
      {R"({})", "/steps/0"},
      {R"({"wait_s": 1, "detach": {"object": "rod"}})", "/steps/0/wait_s"},
      {R"({"wait_s": -1})", "/steps/0/wait_s"},
      {R"({"wait_s": 1, "arm": "left"})", "/steps/0/arm"},
      {R"({"attach": {"object": "rod"}})", "/steps/0/attach/link"},
      {R"({"wait_s": 1, "retry": 2})", "/steps/0/retry"},
      {R"({"move_to": {"named": "ready"}, "arm": "left",
           "triggers": [{"at": 1.5, "set_io": {"name": "a", "value": true}}]})",
       "/steps/0/triggers/0/at"},
  };
  for (const auto& [text, pointer] : cases) {
    const auto job = read_job(json{{"steps", json::array({json::parse(text)})}});
    ASSERT_FALSE(job) << text;
    EXPECT_EQ(job.error().front().pointer, pointer) << text << job.error().front().detail;
  }
  EXPECT_FALSE(read_job(json{{"steps", json::array()}}));
}

TEST(JobCodec, RefusesTooManyWaypointsBeforeReadingThem) {
  json body = test::move("left", test::kHome, test::kMiddle);
  body["trajectory"]["points"] = std::vector<int>(kWaypointsMax + 1, 0);
  const auto job = read_job(body);
  ASSERT_FALSE(job);
  EXPECT_EQ(job.error().front().kind, ProblemKind::too_large);
  EXPECT_EQ(job.error().size(), 1U);
}

TEST(JobsFile, ReadsTimesAndReportsPointersIntoTheFile) {
  const json job = test::move("left", test::kHome, test::kMiddle);
  const auto jobs = read_jobs_text(json::array({{{"at", 0.25}, {"job", job}}}).dump());
  ASSERT_TRUE(jobs);
  EXPECT_EQ(jobs->front().at, at(std::chrono::milliseconds(250)));

  json bad = job;
  bad["trajectory"]["points"][1]["positions"][4] = "x";
  const auto refused =
      read_jobs_text(json::array({{{"at", 0}, {"job", job}}, {{"at", -1}, {"job", bad}}}).dump());
  ASSERT_FALSE(refused);
  ASSERT_EQ(refused.error().size(), 2U);
  EXPECT_EQ(refused.error()[0].pointer, "/1/at");
  EXPECT_EQ(refused.error()[1].pointer, "/1/job/trajectory/points/1/positions/4");
}

}  // namespace
}  // namespace armloom
