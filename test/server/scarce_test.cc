#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <memory>
#include <string>
#include <vector>

#include "test/server/serve_fixture.h"
#include "test/server/wire.h"

namespace armloom {
namespace {

using nlohmann::json;
using test::Serve;
using Clock = std::chrono::steady_clock;

// No file may grow beyond 5 MB, as on a full disk. The recording reaches the limit before the
// database log, because each scene event lists every object. For the store on a full disk see
// durable_disk_test.cc.
TEST_F(Serve, FullDiskIsReportedAtOnceAndAtTheEnd) {
  test::ServeProcess server({"--cell", test::kCell, "--data", data()}, log(),
                            // more than the database log ever needs
                            [] { test::set_limit(RLIMIT_FSIZE, 5'242'880); });
  const auto put = [&](const std::string& name) {
    const json box = {{"name", name}, {"box", {0.1, 0.1, 0.1}}, {"xyz", {0, 0, 3}}};
    return test::request(server.port(), "POST", "/api/v1/scene/objects", box.dump()).status;
  };
  // Each event lists the whole scene; the names are long.
  std::string clefs;
  for (int i = 0; i < 120; ++i) clefs += "\U0001d11e";
  for (int i = 0; i < 40; ++i) ASSERT_EQ(put(std::to_string(i) + clefs), 201);
  const auto deadline = Clock::now() + std::chrono::minutes(5);
  auto ready = test::request(server.port(), "GET", "/readyz");
  EXPECT_EQ(ready.status, 200);
  while (ready.status == 200) {
    ASSERT_LT(Clock::now(), deadline);
    put("box");
    test::request(server.port(), "DELETE", "/api/v1/scene/objects/box");
    ready = test::request(server.port(), "GET", "/readyz");
  }
  EXPECT_EQ(ready.status, 503);
  EXPECT_EQ(ready.json()["type"], "urn:armloom:problem:recording-lost");
  EXPECT_NE(ready.json()["detail"].get<std::string>().find("File too large"), std::string::npos);
  EXPECT_EQ(test::request(server.port(), "GET", "/healthz").status, 200);
  while (server.log().find("the recording is incomplete") == std::string::npos) {
    ASSERT_LT(Clock::now(), deadline) << server.log();
  }
  EXPECT_NE(ready.json()["detail"].get<std::string>().find("until the server is restarted"),
            std::string::npos);
  // The alert must be acknowledged by an operator.
  const auto alerts = test::request(server.port(), "GET", "/api/v1/alerts").json()["alerts"];
  const auto lost = std::ranges::find_if(alerts, [](const json& alert) {
    return alert["text"].get<std::string>().starts_with("the recording is incomplete");
  });
  ASSERT_NE(lost, alerts.end()) << alerts;
  EXPECT_EQ((*lost)["level"], "error");
  const json seen{{"ids", {(*lost)["id"]}}, {"who", "Ada"}};
  test::request(server.port(), "POST", "/api/v1/alerts/acknowledge", seen.dump());
  server.signal(SIGTERM);
  EXPECT_EQ(server.wait(), 74);
  EXPECT_NE(server.log().find("not everything was written: "), std::string::npos) << server.log();
}

TEST_F(Serve, StopIsServedWithoutFreeDescriptors) {
  test::ServeProcess server({"--cell", test::kCell}, log(),
                            [] { test::set_limit(RLIMIT_NOFILE, 64); });
  std::vector<std::unique_ptr<test::Wire>> held;
  held.reserve(150);
  for (int i = 0; i < 150; ++i) held.push_back(std::make_unique<test::Wire>(server.port()));
  EXPECT_EQ(test::request(server.port(), "GET", "/healthz").status, 503);
  EXPECT_EQ(test::request(server.port(), "POST", "/api/v1/stop").status, 202);
  EXPECT_EQ(test::request(server.port(), "POST", "/api/v1/arms/left/stop").status, 202);
  held.clear();
  const auto deadline = Clock::now() + std::chrono::seconds(20);
  while (test::request(server.port(), "GET", "/healthz").status != 200) {
    ASSERT_LT(Clock::now(), deadline);
  }
  EXPECT_EQ(test::request(server.port(), "GET", "/api/v1/queue").json()["stopped"], true);
}

TEST_F(Serve, ConnectionsAreRefusedIfDescriptorsAreFew) {
  const auto web = folder_ / "web";
  std::filesystem::create_directories(web);
  std::ofstream(web / "index.html") << "<html>";
  test::ServeProcess server({"--cell", test::kCell, "--web", web.string()}, log(),
                            [] { test::set_limit(RLIMIT_NOFILE, 64); });
  std::vector<std::unique_ptr<test::Wire>> held;
  for (int i = 0; i < 60; ++i) held.push_back(std::make_unique<test::Wire>(server.port()));
  const auto refused = test::request(server.port(), "GET", "/healthz");
  EXPECT_EQ(refused.status, 503);
  EXPECT_EQ(refused.json()["type"], "urn:armloom:problem:too-many-connections");
  held.front()->send(test::request_text("GET", "/", "", ""));
  EXPECT_EQ(test::read_answer(*held.front()).status, 200);
}

// The server has so few descriptors that less than half of them remain for connections.
TEST_F(Serve, ConnectionsAndFilesAreRefusedWithoutDescriptors) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "UBSan opens a pipe to look at a type, and ends the server where there is none";
#endif
  const auto web = folder_ / "web";
  std::filesystem::create_directories(web);
  std::ofstream(web / "index.html") << "<html>";
  test::ServeProcess server({"--cell", test::kCell, "--web", web.string()}, log(),
                            [] { test::set_limit(RLIMIT_NOFILE, 24); });
  std::vector<std::unique_ptr<test::Wire>> held;
  int status = 200;
  for (int i = 0; i < 30 && status == 200; ++i) {
    held.push_back(std::make_unique<test::Wire>(server.port()));
    held.back()->send(test::request_text("GET", "/healthz", "", ""));
    status = test::read_answer(*held.back()).status;
  }
  ASSERT_EQ(status, 503);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(test::request(server.port(), "GET", "/healthz").status, 503);
  }
  held.front()->send(test::request_text("GET", "/", "", ""));
  const int file = test::read_answer(*held.front()).status;
  EXPECT_TRUE(file == 200 || file == 503) << file;
  held.front()->send(test::request_text("GET", "/healthz", "", ""));
  EXPECT_EQ(test::read_answer(*held.front()).status, 200);
}

}  // namespace
}  // namespace armloom
