#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "test/server/panda_jobs.h"
#include "test/server/running_server.h"

namespace armloom {
namespace {

using nlohmann::json;

constexpr test::Pose kNear{0, -0.4, 0, -1.2, 0, 2.0, 0.785};  // over the middle of the table
constexpr int kTurns = 200;

// Returns a motion that approaches the other arm, turns its hand back and forth there, and returns.
// Its check takes about a second.
json long_motion() {
  json body = test::move("right", test::kHome, kNear, 4.0, 2);
  json& points = body["trajectory"]["points"];
  const auto add = [&](const test::Pose& q, double at_s) {
    points.push_back({{"positions", q}, {"velocities", test::Pose{}}, {"time_from_start", at_s}});
  };
  test::Pose turned = kNear;
  turned[6] += 1.0;
  for (int i = 1; i <= kTurns; ++i) add(i % 2 == 0 ? kNear : turned, 4.0 + 3.0 * i);
  add(test::kHome, 3.0 * kTurns + 8.0);
  for (json& point : points) point.erase("accelerations");
  return body;
}

double answered_checks(const std::string& metrics) {
  const std::string line = "armloom_http_requests_total{";
  double sum = 0;
  for (std::size_t at = metrics.find(line); at != metrics.npos; at = metrics.find(line, at + 1)) {
    const std::string text = metrics.substr(at, metrics.find('\n', at) - at);
    if (text.find("/check\"") == text.npos) continue;
    sum += std::stod(text.substr(text.rfind(' ')));
  }
  return sum;
}

class LongChecks : public test::RunningServer {};

TEST_F(LongChecks, DoNotDelayJobs) {
  ASSERT_NO_FATAL_FAILURE(start(20.0));
  test::Listener listener(port());
  json near = test::move("left", test::kHome, kNear, 4.0);
  near["id"] = "near";
  ASSERT_EQ(post("/api/v1/jobs", near.dump()).status, 202);
  until(listener, "near", "succeeded");

  const std::string check =
      test::request_text("POST", "/api/v1/check", long_motion().dump(), "application/json");
  std::vector<std::unique_ptr<test::Wire>> asking;
  for (int i = 0; i < 20; ++i) {
    asking.push_back(std::make_unique<test::Wire>(port()));
    ASSERT_TRUE(asking.back()->send(check));
  }
  const auto first = test::read_answer(*asking.front());  // the other checks are queued behind it
  ASSERT_EQ(first.status, 200) << first.body;
  EXPECT_GT(first.json()["evaluations"], 10'000) << "this is no long check";

  json back = test::move("left", kNear, test::kHome, 4.0);
  back["id"] = "back";
  ASSERT_EQ(post("/api/v1/jobs", back.dump()).status, 202);
  until(listener, "back", "running");
  const double answered = answered_checks(get("/metrics").body);
  EXPECT_GE(answered, 1) << "the figure counts what it should";
  EXPECT_LE(answered, 10) << "the job came to its turn after these checks";
}

}  // namespace
}  // namespace armloom
