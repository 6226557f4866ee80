#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <thread>

#include "core/model/cell/build_cell.h"
#include "server/codec/cell_codec.h"
#include "server/recording/recording.h"
#include "server/service/service.h"
#include "test/server/wire.h"
#include "test/source_dir.h"

namespace armloom::test {

// The real server on a free loopback port, with the two-Panda cell (or the cell of `file`); a new
// one for each test.
class RunningServer : public ::testing::Test {
 protected:
  void start(double speed, std::filesystem::path web = {}, std::filesystem::path file = {}) {
    if (file.empty()) file = std::filesystem::path(source_dir()) / "config/two_pandas.json";
    const auto text = read_text_file(file);
    ASSERT_TRUE(text);
    auto description = read_cell_text(*text, file.parent_path());
    ASSERT_TRUE(description);
    if (on_idle_blocker_) description->scheduling.on_idle_blocker = *on_idle_blocker_;
    if (on_restart_) description->scheduling.on_restart = *on_restart_;
    const auto cell = build_cell(*description);
    ASSERT_TRUE(cell);
    options_.port = 0;
    options_.speed = speed;
    options_.web = std::move(web);
    auto service = Service::start(*cell, {file, *text}, options_);
    ASSERT_TRUE(service) << service.error().front().detail;
    service_ = std::move(*service);
    thread_ = std::thread([this] { service_->run(false); });
  }
  void TearDown() override { end(); }
  // Ends the server like a kill, without a graceful shutdown.
  void end() {
    if (!service_) return;
    service_->stop();
    thread_.join();
    service_.reset();
  }

  std::uint16_t port() const { return service_->port(); }
  Answer get(const std::string& target) { return request(port(), "GET", target); }
  Answer put(const std::string& target, const std::string& body) {
    return request(port(), "PUT", target, body);
  }
  Answer remove(const std::string& target) { return request(port(), "DELETE", target); }
  // Returns the next published view of the job for which `is` returns true.
  template <class Is>
  static nlohmann::json next_job(Listener& listener, const std::string& id, Is is) {
    for (;;) {
      const nlohmann::json job = listener.next_of("job")["data"];
      if (job["id"] == id && is(job)) return job;
    }
  }
  static nlohmann::json until(Listener& listener, const std::string& id, const std::string& state) {
    return next_job(listener, id, [&](const auto& job) {
      if (job["state"] != state && !job["result"].is_null()) {
        throw std::runtime_error("ended instead: " + job.dump());
      }
      return job["state"] == state;
    });
  }
  // Waits, for a bounded time, until a member of the arm has the value.
  void until_arm(const std::string& arm, const char* member, const char* value) {
    for (int i = 0; i < 10'000 && get("/api/v1/arms/" + arm).json()[member] != value; ++i) {
    }
  }
  Answer post(const std::string& target, const std::string& body,
              const std::string& type = "application/json") {
    return request(port(), "POST", target, body, type);
  }

  ServiceOptions options_;                        // for start(), which sets port, speed and web
  std::optional<OnIdleBlocker> on_idle_blocker_;  // for start(); default: as in the file
  std::optional<OnRestart> on_restart_;           // for start(); default: as in the file

 private:
  std::unique_ptr<Service> service_;
  std::thread thread_;
};

}  // namespace armloom::test
