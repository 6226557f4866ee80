#include <gtest/gtest.h>

#include <functional>

#include "test/server/panda_jobs.h"
#include "test/server/running_server.h"

namespace armloom {
namespace {

using nlohmann::json;

struct BadJobCase {
  const char* name;
  std::function<std::string()> body;
  int status;
  const char* pointer;
  const char* says;
  const char* content_type = "application/json";
};

json good() { return test::move("left", test::kHome, test::kMiddle); }

// Returns a valid job with one value replaced.
std::function<std::string()> with(const char* pointer, json value) {
  return [=] {
    json body = good();
    body[json::json_pointer(pointer)] = value;
    return body.dump();
  };
}
void PrintTo(const BadJobCase& bad, std::ostream* out) { *out << bad.name; }

class BadJobOverHttp : public test::RunningServer,
                       public ::testing::WithParamInterface<BadJobCase> {};

TEST_P(BadJobOverHttp, IsRefusedAndLeavesNothingBehind) {
  start(10.0);
  for (const char* arm : {"left", "right"}) until_arm(arm, "link", "up");
  const json arms_before = get("/api/v1/arms").json();
  const auto answer = post("/api/v1/jobs", GetParam().body(), GetParam().content_type);
  EXPECT_EQ(answer.status, GetParam().status) << answer.body;
  EXPECT_EQ(answer.headers.at("content-type"), "application/problem+json");
  const json problem = answer.json();
  EXPECT_EQ(problem["status"], GetParam().status);
  EXPECT_EQ(problem["pointer"], GetParam().pointer) << answer.body;
  EXPECT_NE(problem["detail"].get<std::string>().find(GetParam().says), std::string::npos)
      << answer.body;
  EXPECT_EQ(get("/api/v1/jobs").json()["jobs"], json::array());
  EXPECT_EQ(get("/api/v1/arms").json(), arms_before);
}

INSTANTIATE_TEST_SUITE_P(
    Table, BadJobOverHttp,
    ::testing::Values(
        BadJobCase{"UnknownJoint", with("/trajectory/joint_names/2", "left_panda_joint9"), 422,
                   "/trajectory/joint_names/2", "left_panda_joint9"},
        BadJobCase{"BrokenJson",
                   [] { return std::string(R"({"trajectory": {"points": [{"positions": [0, 1)"); },
                   400, "/trajectory/points/0/positions/2", "ends before"},
        BadJobCase{"YamlAsJson", [] { return std::string("name: reach"); }, 400, "",
                   "for YAML, send the header Content-Type: application/yaml"},
        BadJobCase{"WrongContentType", [] { return good().dump(); }, 415, "Content-Type",
                   "text/plain", "text/plain"},
        BadJobCase{"StartElsewhere",
                   [] { return test::move("left", test::kMiddle, test::kHome).dump(); }, 422,
                   "/trajectory/points/0/positions/1", "-0.7"}),
    [](const auto& tested) { return tested.param.name; });

class BadJobs : public test::RunningServer {};

TEST_F(BadJobs, ReportUnknownAndReusedIds) {
  start(1.0);
  const auto missing = get("/api/v1/jobs/nothing");
  EXPECT_EQ(missing.status, 404);
  EXPECT_EQ(missing.json()["value"], "nothing");
  EXPECT_EQ(test::request(port(), "DELETE", "/api/v1/jobs/nothing").status, 404);
  json body = good();
  body["id"] = "once";
  EXPECT_EQ(post("/api/v1/jobs", body.dump()).status, 202);
  body["priority"] = 1;
  const auto again = post("/api/v1/jobs", body.dump());
  EXPECT_EQ(again.status, 409);
  EXPECT_EQ(again.json()["value"], "once");
}

}  // namespace
}  // namespace armloom
