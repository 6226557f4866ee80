#include <gtest/gtest.h>

#include <map>
#include <regex>

#include "test/server/panda_jobs.h"
#include "test/server/running_server.h"
#include "test/source_dir.h"

namespace armloom {
namespace {

using nlohmann::json;

class MetricsRoute : public test::RunningServer {
 protected:
  // Returns the values by name and labels, as printed.
  std::map<std::string, double> figures() {
    const auto answer = get("/metrics");
    EXPECT_EQ(answer.status, 200);
    EXPECT_EQ(answer.headers.at("content-type"), "text/plain; version=0.0.4; charset=utf-8");
    std::map<std::string, double> values;
    std::istringstream lines(answer.body);
    for (std::string line; std::getline(lines, line);) {
      if (line.empty() || line.front() == '#') continue;
      const std::size_t space = line.rfind(' ');
      values[line.substr(0, space)] = std::stod(line.substr(space + 1));
    }
    return values;
  }
};

TEST_F(MetricsRoute, CountsJobsWaitsAndDecisions) {
  start(20.0);
  auto before = figures();
  EXPECT_EQ(before.at("armloom_jobs_total{outcome=\"succeeded\"}"), 0);
  EXPECT_EQ(before.at("armloom_job_waits_total{reason=\"job\"}"), 0);
  test::Listener listener(port());
  for (const char* arm : {"left", "right"}) {
    json job = test::move(arm, test::kHome, test::kMiddle);
    job["id"] = arm;
    ASSERT_EQ(post("/api/v1/jobs", job.dump()).status, 202);
  }
  until(listener, "left", "succeeded");
  EXPECT_EQ(remove("/api/v1/jobs/right").status, 202);
  next_job(listener, "right", [](const json& job) { return !job["result"].is_null(); });
  const auto after = figures();
  EXPECT_EQ(after.at("armloom_jobs_total{outcome=\"succeeded\"}"), 1);
  EXPECT_EQ(after.at("armloom_jobs_total{outcome=\"canceled\"}"), 1);
  EXPECT_GE(after.at("armloom_decision_seconds_count"),
            2);  // the waiting job is checked again
  EXPECT_EQ(before.at("armloom_evaluations_total"), 0);
  EXPECT_GT(after.at("armloom_evaluations_total"), 0);
  double waits = 0;
  for (const auto& [name, value] : after) {
    if (name.starts_with("armloom_job_waits_total")) waits += value;
  }
  EXPECT_GE(waits, 1);
  EXPECT_EQ(after.at("armloom_event_subscribers"), 1);
}

TEST_F(MetricsRoute, ReportsLoopsClearanceAndStops) {
  start(1.0);
  test::Listener listener(port());
  for (int frames = 0; frames < 3; ++frames) (void)listener.next_of("state");
  ASSERT_EQ(post("/api/v1/stop", "").status, 202);
  const auto values = figures();
  EXPECT_GT(values.at("armloom_period_seconds_count{loop=\"control\"}"), 0);
  EXPECT_GT(values.at("armloom_period_seconds_count{loop=\"monitor\"}"), 0);
  EXPECT_GT(values.at("armloom_monitor_late_seconds_count"), 0);
  EXPECT_GE(values.at("armloom_overruns_total{loop=\"control\"}"), 0);
  EXPECT_GT(values.at("armloom_period_worst_seconds{loop=\"control\"}"), 0.0009);
  EXPECT_EQ(values.at("armloom_stop_latency_seconds_count"), 1);
  EXPECT_GT(values.at("armloom_clearance_metres{a=\"left\",b=\"right\"}"), 0.05);
  EXPECT_GE(values.at("armloom_clearance_metres{a=\"left\",b=\"right\"}"),
            values.at("armloom_clearance_min_metres{a=\"left\",b=\"right\"}"));
  EXPECT_EQ(values.at("armloom_recording_lost"), 0);
  EXPECT_EQ(values.at("armloom_storage_failed"), 0);
}

TEST_F(MetricsRoute, CountsResponsesByRouteAndStatusWithoutClientData) {
  start(1.0);
  EXPECT_EQ(get("/api/v1/jobs/nothing").status, 404);
  EXPECT_EQ(get("/api/v1/jobs/nobody").status, 404);
  EXPECT_EQ(get("/api/v1/jobs?limit=0").status, 422);
  EXPECT_EQ(get("/whatever").status, 404);
  EXPECT_EQ(test::request(port(), "INVENTED", "/api/v1/elsewhere").status, 404);
  const auto values = figures();
  const auto count = [&](const std::string& labels) {
    return values.at("armloom_http_requests_total{" + labels + "}");
  };
  EXPECT_EQ(count(R"(method="GET",route="/api/v1/jobs/{id}",status="404")"), 2);
  EXPECT_EQ(count(R"(method="GET",route="/api/v1/jobs",status="422")"), 1);
  EXPECT_EQ(count(R"(method="any",route="other",status="404")"), 2);
  EXPECT_EQ(values.at(R"(armloom_http_seconds_count{method="GET",route="/api/v1/jobs/{id}"})"), 2);
  for (const auto& [name, value] : values) {
    EXPECT_EQ(name.find("nothing"), std::string::npos) << name;
    EXPECT_EQ(name.find("INVENTED"), std::string::npos) << name;
  }
}

TEST_F(MetricsRoute, ReportsDatabaseLatency) {
  options_.data = std::filesystem::path(::testing::TempDir()) / "armloom-metrics-data";
  std::filesystem::remove_all(*options_.data);
  start(1.0);
  const double before = figures().at("armloom_database_seconds_count");
  const json job = test::move("left", test::kHome, test::kMiddle);
  ASSERT_EQ(post("/api/v1/jobs", job.dump()).status, 202);
  const auto after = figures();
  EXPECT_GT(after.at("armloom_database_seconds_count"), before)
      << "it was on disk when it was answered";
  EXPECT_GT(after.at("armloom_database_seconds_sum"), 0);
}

TEST_F(MetricsRoute, HasEveryMetricOfTheGrafanaDashboard) {
  start(1.0);
  test::Listener listener(port());
  (void)listener.next_of("state");
  (void)get("/healthz");
  const std::string body = get("/metrics").body;
  const auto text =
      read_text_file(std::filesystem::path(source_dir()) / "config/grafana/armloom.json");
  ASSERT_TRUE(text);
  const json dashboard = json::parse(*text);
  const std::regex name("armloom_[a-z_]+");
  std::size_t asked = 0;
  for (const json& panel : dashboard["panels"]) {
    for (const json& target : panel["targets"]) {
      const std::string query = target["expr"];
      for (std::sregex_iterator it(query.begin(), query.end(), name), end; it != end; ++it) {
        ++asked;
        const std::string figure = it->str();
        const bool there = body.find("\n" + figure + " ") != body.npos ||
                           body.find("\n" + figure + "{") != body.npos;
        EXPECT_TRUE(there) << figure;
      }
    }
  }
  EXPECT_GE(asked, 15U);
}

}  // namespace
}  // namespace armloom
