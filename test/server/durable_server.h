#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>

#include "test/server/failing_disk.h"
#include "test/server/panda_jobs.h"
#include "test/server/running_server.h"

namespace armloom {

// A server with a separate data folder for each test, on a disk that can be made to fail.
class Durable : public test::RunningServer {
 protected:
  void SetUp() override {
    test::FailingDisk::reset();
    data_ = std::filesystem::path(::testing::TempDir()) / "armloom-durable" /
            ::testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::remove_all(data_);
    options_.data = data_;
    options_.store.vfs = test::FailingDisk::name();
    options_.store.retry = std::chrono::milliseconds(5);
  }
  void TearDown() override {
    RunningServer::TearDown();
    test::FailingDisk::reset();
  }
  void restart(double speed = 1) {
    end();
    start(speed);
  }
  nlohmann::json swing(const std::string& id, const std::string& arm) {
    test::Pose away = test::kHome;
    away[0] += 0.3;
    nlohmann::json job = test::move(arm, test::kHome, away, 1.0);
    nlohmann::json back = test::move(arm, away, test::kHome, 1.0);
    auto& points = job["trajectory"]["points"];
    for (nlohmann::json& point : back["trajectory"]["points"]) {
      if (point["time_from_start"] == 0.0) continue;
      point["time_from_start"] = point["time_from_start"].get<double>() + 1.0;
      points.push_back(point);
    }
    job["id"] = id;
    return job;
  }
  test::Answer submit(const std::string& id, const std::string& arm = "left",
                      const nlohmann::json& more = nlohmann::json::object()) {
    nlohmann::json job = swing(id, arm);
    job.update(more);
    return post("/api/v1/jobs", job.dump());
  }
  test::Answer put_speed(const std::string& path, double share) {
    return test::request(port(), "PUT", "/api/v1" + path,
                         nlohmann::json{{"speed_override", share}}.dump());
  }
  nlohmann::json speed_of(const std::string& path) {
    return get("/api/v1" + path).json()["speed_override"];
  }
  nlohmann::json state_of(const std::string& arm) {
    return get("/api/v1/arms/" + arm).json()["state"];
  }
  nlohmann::json job(const std::string& id) { return get("/api/v1/jobs/" + id).json(); }
  void wait_for(const std::string& id, const std::string& state) {
    test::Listener listener(port());
    if (job(id)["state"] == state) return;
    until(listener, id, state);
  }
  template <class Is>
  void wait_until(Is is) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (!is()) ASSERT_LT(std::chrono::steady_clock::now(), deadline);
  }

  std::filesystem::path data_;
};

}  // namespace armloom
