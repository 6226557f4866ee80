#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "test/server/panda_jobs.h"
#include "test/server/running_server.h"

namespace armloom {
namespace {

using nlohmann::json;
using test::RunningServer;

class DiagramOverHttp : public RunningServer {
 protected:
  void submit(const std::string& id, const std::string& arm, const test::Pose& to,
              double duration_s = 3.0) {
    json job = test::move(arm, test::kHome, to, duration_s);
    job["id"] = id;
    const auto answer = post("/api/v1/jobs", job.dump());
    ASSERT_EQ(answer.status, 202) << answer.body;
  }
  // The right arm's job waits for the left arm's.
  void submit_two_that_cross() {
    submit("l", "left", test::kMiddle, 3.0);
    submit("r", "right", test::kMiddle, 4.0);
  }
  void expect_problem(const std::string& target, int status, const std::string& slug,
                      const std::string& pointer) {
    const auto answer = get(target);
    EXPECT_EQ(answer.status, status) << target << ": " << answer.body;
    EXPECT_EQ(answer.json()["type"], "urn:armloom:problem:" + slug) << target;
    EXPECT_EQ(answer.json()["pointer"], pointer) << target;
  }
};

// Returns the area of each state in s^2; expects every cell to lie within the rectangle.
std::map<std::string, double> areas(const json& layer, double duration_a, double duration_b) {
  std::map<std::string, double> area;
  for (const json& cell : layer["cells"]) {
    const double a0 = cell["a_s"][0];
    const double a1 = cell["a_s"][1];
    const double b0 = cell["b_s"][0];
    const double b1 = cell["b_s"][1];
    EXPECT_TRUE(0.0 <= a0 && a0 < a1 && a1 <= duration_a) << cell;
    EXPECT_TRUE(0.0 <= b0 && b0 < b1 && b1 <= duration_b) << cell;
    area[cell["state"]] += (a1 - a0) * (b1 - b0);
  }
  return area;
}

// Returns the number of cells that contain the point, borders excluded.
int cells_at(const json& layer, double a, double b) {
  const auto within = [](const json& range, double x) { return range[0] < x && x < range[1]; };
  return static_cast<int>(std::ranges::count_if(layer["cells"], [&](const json& cell) {
    return within(cell["a_s"], a) && within(cell["b_s"], b);
  }));
}

std::string state_at(const json& layer, double a, double b) {
  for (const json& cell : layer["cells"]) {
    if (cell["a_s"][0] <= a && a <= cell["a_s"][1] && cell["b_s"][0] <= b && b <= cell["b_s"][1]) {
      return cell["state"];
    }
  }
  return "nothing";
}

TEST_F(DiagramOverHttp, ShowsFreeStartsAndConflictingEnds) {
  start(1.0);
  submit_two_that_cross();
  const auto answer = get("/api/v1/jobs/l/diagram?with=r");
  ASSERT_EQ(answer.status, 200) << answer.body;
  const json diagram = answer.json();
  EXPECT_EQ(diagram["a"]["id"], "l");
  EXPECT_EQ(diagram["b"]["id"], "r");
  EXPECT_EQ(diagram["a"]["duration_s"], 3.0);
  EXPECT_EQ(diagram["b"]["duration_s"], 4.0);
  EXPECT_GT(diagram["evaluations"], 0);
  EXPECT_EQ(diagram["scene_version"], 1);
  ASSERT_EQ(diagram["layers"].size(), 1U);
  const json& layer = diagram["layers"][0];
  EXPECT_EQ(layer["arms"], json({"left", "right"}));
  // The first contact must lie in a cell with the state that it reports. The second request is
  // answered from the cache.
  const json met = layer["first_contact"];
  EXPECT_EQ(met["state"], "conflict");
  EXPECT_EQ(state_at(layer, std::min(3.0, met["a_s"].get<double>() + 1e-6),
                     std::min(4.0, met["b_s"].get<double>() + 1e-6)),
            "conflict");
  const json again = get("/api/v1/jobs/l/diagram?with=r&cells=0").json();
  EXPECT_FALSE(again["layers"][0].contains("cells"));
  EXPECT_EQ(again["layers"][0]["first_contact"]["state"], "conflict");
  EXPECT_EQ(again["evaluations"], diagram["evaluations"]);
  auto area = areas(layer, 3.0, 4.0);
  EXPECT_GT(area["free"], 1.0);
  EXPECT_GT(area["conflict"], 0.5);
  EXPECT_EQ(state_at(layer, 0.01, 0.01), "free");
  EXPECT_EQ(state_at(layer, 2.99, 0.01), "free");
  EXPECT_EQ(state_at(layer, 0.01, 3.99), "free");
  EXPECT_EQ(state_at(layer, 2.99, 3.99), "conflict");
}

TEST_F(DiagramOverHttp, CellsTileTheRectangle) {
  start(1.0);
  submit_two_that_cross();
  const json layer = get("/api/v1/jobs/l/diagram?with=r").json()["layers"][0];
  double whole = 0.0;
  for (const auto& [state, area] : areas(layer, 3.0, 4.0)) whole += area;
  EXPECT_NEAR(whole, 3.0 * 4.0, 1e-6);
  // Irrational steps, so that no point falls on a border.
  for (double a = 0.0123457; a < 3.0; a += 0.1414213562) {
    for (double b = 0.0987653; b < 4.0; b += 0.1732050808) {
      ASSERT_EQ(cells_at(layer, a, b), 1) << a << ", " << b;
    }
  }
}

TEST_F(DiagramOverHttp, ReportsTheProgressOfBothJobs) {
  start(1.0);
  test::Listener listener(port());
  submit_two_that_cross();
  until(listener, "l", "running");
  json before = get("/api/v1/jobs/l/diagram?with=r").json();
  while (before["a"]["progress_s"] == 0.0) before = get("/api/v1/jobs/l/diagram?with=r").json();
  const json after = get("/api/v1/jobs/l/diagram?with=r").json();
  EXPECT_EQ(before["a"]["state"], "running");
  EXPECT_GT(after["a"]["progress_s"], before["a"]["progress_s"]);
  EXPECT_LE(after["a"]["progress_s"], 3.0);
  EXPECT_EQ(after["b"]["progress_s"], 0.0);
  EXPECT_GT(after["t_s"], before["t_s"]);
}

TEST_F(DiagramOverHttp, IsAvailableForEndedJobs) {
  on_idle_blocker_ = OnIdleBlocker::report;  // l stays at r's goal, so that r never moves
  start(5.0);
  test::Listener listener(port());
  submit_two_that_cross();
  until(listener, "l", "succeeded");
  ASSERT_EQ(remove("/api/v1/jobs/r").status, 202);
  until(listener, "r", "canceled");
  const json diagram = get("/api/v1/jobs/r/diagram?with=l").json();
  EXPECT_EQ(diagram["a"]["state"], "canceled");
  EXPECT_EQ(diagram["a"]["progress_s"], 0.0);
  EXPECT_EQ(diagram["b"]["state"], "succeeded");
  EXPECT_EQ(diagram["b"]["progress_s"], 3.0);
  EXPECT_GT(areas(diagram["layers"][0], 4.0, 3.0)["conflict"], 0.5);
}

TEST_F(DiagramOverHttp, ReportsInvalidRequests) {
  start(1.0);
  submit("l", "left", test::kMiddle);
  json back = test::move("left", test::kMiddle, test::kHome);
  back["id"] = "back";
  ASSERT_EQ(post("/api/v1/jobs", back.dump()).status, 202);
  const std::string diagram = "/api/v1/jobs/l/diagram";
  expect_problem(diagram, 400, "missing-parameter", "?with");
  expect_problem(diagram + "?with=", 400, "missing-parameter", "?with");
  expect_problem(diagram + "?with=nobody", 404, "no-such-job", "?with");
  expect_problem("/api/v1/jobs/nobody/diagram?with=l", 404, "no-such-job", "request target");
  expect_problem(diagram + "?with=l", 422, "same-job", "?with");
  expect_problem(diagram + "?with=back", 422, "same-arm", "?with");
  expect_problem(diagram + "?with=back&fine=1", 400, "bad-parameter", "?fine");
}

}  // namespace
}  // namespace armloom
