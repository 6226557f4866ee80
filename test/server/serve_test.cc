#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <memory>
#include <thread>

#include "test/server/serve_fixture.h"
#include "test/server/wire.h"

namespace armloom {
namespace {

using nlohmann::json;
using test::Serve;
using Clock = std::chrono::steady_clock;

void wait_until_moving(std::uint16_t port) {
  const auto deadline = Clock::now() + std::chrono::seconds(10);
  while (test::request(port, "GET", "/api/v1/arms/left").json()["state"] != "moving") {
    ASSERT_LT(Clock::now(), deadline);
  }
}

TEST_F(Serve, SignalStopsTheArmsAndCompletesTheRecording) {
  for (const int number : {SIGTERM, SIGHUP, SIGINT}) {
    std::filesystem::remove_all(data());
    test::ServeProcess server({"--cell", test::kCell, "--data", data(), "--record"}, log());
    begin_job(server.port(), "go", "left");
    ASSERT_NO_FATAL_FAILURE(wait_until_moving(server.port()));
    const auto before = Clock::now();
    server.signal(number);
    EXPECT_EQ(server.wait(), 0) << number;
    EXPECT_LT(Clock::now() - before, std::chrono::seconds(2)) << number;
    const auto all = events();
    ASSERT_TRUE(std::ranges::any_of(all, [](const json& e) { return has_ended(e, "go"); }))
        << number;
    for (const json& event : all) {
      if (!has_ended(event, "go")) continue;
      EXPECT_EQ(event["data"]["state"], "interrupted");
    }
    EXPECT_EQ(json::parse(read_text_file(folder_ / "data/jobs.json").value()).size(), 1U);
    EXPECT_EQ(run("audit --cell " + test::kCell + " --recording " + data()).exit_code, 0) << number;
  }
}

// The answer is sent before the stop is written to disk. Even so, a kill right after the answer
// must not lose the stop.
TEST_F(Serve, AnsweredStopSurvivesAKill) {
  for (int kill = 0; kill < 6; ++kill) {
    std::filesystem::remove_all(data());
    const std::vector<std::string> arguments{"--cell", test::kCell, "--data", data()};
    {
      test::ServeProcess server(arguments, log());
      ASSERT_EQ(test::request(server.port(), "POST", "/api/v1/arms/left/stop").status, 202);
      server.signal(SIGKILL);
      EXPECT_EQ(server.wait(), -SIGKILL);
    }
    test::ServeProcess server(arguments, log());
    const json arm = test::request(server.port(), "GET", "/api/v1/arms/left").json();
    EXPECT_EQ(arm["state"], "stopped");
  }
}

// The stop at the end of a session raises no alert. The next session reports what needs attention.
TEST_F(Serve, ShutdownIsNoStopAndNoAlertForTheNextSession) {
  const std::vector<std::string> arguments{"--cell", test::kCell, "--data", data()};
  const auto end = [](test::ServeProcess& server) {
    server.signal(SIGTERM);
    EXPECT_EQ(server.wait(), 0);
  };
  const auto ask = [](const test::ServeProcess& server, const char* method, const char* path) {
    return test::request(server.port(), method, path).json();
  };
  {
    test::ServeProcess first(arguments, log());
    EXPECT_EQ(ask(first, "GET", "/api/v1/queue")["stopped"], false);
    end(first);
  }
  {
    test::ServeProcess second(arguments, log());
    EXPECT_EQ(ask(second, "GET", "/api/v1/queue")["stopped"], false);
    EXPECT_EQ(ask(second, "GET", "/api/v1/alerts")["alerts"], json::array());
    begin_job(second.port(), "go", "left");
    ASSERT_NO_FATAL_FAILURE(wait_until_moving(second.port()));
    ask(second, "POST", "/api/v1/arms/right/stop");
    begin_job(second.port(), "waits", "right");
    end(second);
  }
  test::ServeProcess third(arguments, log());
  const auto deadline = Clock::now() + std::chrono::seconds(10);
  while (ask(third, "GET", "/api/v1/queue")["stopped"] == false) {
    ASSERT_LT(Clock::now(), deadline);
  }
  std::string told;
  const json kept = ask(third, "GET", "/api/v1/alerts");
  for (const json& alert : kept["alerts"]) {
    told += alert["text"].get<std::string>() + "\n";
  }
  EXPECT_EQ(told,
            "stopped: left, right (the server was restarted: 1 job waits; "
            "resume to continue)\nstopped: right (operator)\n");
  end(third);
}

TEST_F(Serve, SlowArmDoesNotDelayTheShutdown) {
  test::ServeProcess server({"--cell", test::kCell, "--speed", "0.01", "--data", data()}, log());
  begin_job(server.port(), "go", "left");
  ASSERT_NO_FATAL_FAILURE(wait_until_moving(server.port()));
  const auto before = Clock::now();
  server.signal(SIGTERM);
  EXPECT_EQ(server.wait(), 0);
  EXPECT_LT(Clock::now() - before, std::chrono::seconds(2));
}

TEST_F(Serve, NohupIsRespected) {
  test::ServeProcess server({"--cell", test::kCell}, log(), [] { signal(SIGHUP, SIG_IGN); });
  server.signal(SIGHUP);
  EXPECT_EQ(test::request(server.port(), "GET", "/readyz").status, 200);
  server.signal(SIGTERM);
  EXPECT_EQ(server.wait(), 0);
}

TEST_F(Serve, EventsAreWrittenWhenPublished) {
  test::ServeProcess server({"--cell", test::kCell, "--data", data()}, log());
  begin_job(server.port(), "go", "left");
  ASSERT_NO_FATAL_FAILURE(wait_until_moving(server.port()));
  server.signal(SIGKILL);
  EXPECT_EQ(server.wait(), -SIGKILL);
  EXPECT_FALSE(events().empty());
}

// As under a debugger: the lease has expired while the process was suspended.
TEST_F(Serve, JogLeaseExpiresWhileTheProcessIsSuspended) {
  test::ServeProcess server({"--cell", test::kCell, "--jog-lease", "0.3"}, log());
  const auto ask = [&](const char* method, const std::string& path, const json& body) {
    return test::request(server.port(), method, "/api/v1" + path, body.dump());
  };
  const json key{{"control", ask("POST", "/control", {{"who", "Ada"}}).json()["key"]}};
  json hold = key;
  hold["to"] = {{"named", "ready"}};
  ASSERT_EQ(ask("POST", "/arms/left/jog", hold).status, 202);
  server.signal(SIGSTOP);
  std::this_thread::sleep_for(std::chrono::milliseconds(400));
  server.signal(SIGCONT);
  const auto late = ask("PUT", "/arms/left/jog", key);
  EXPECT_EQ(late.status, 409) << late.body;
}

TEST_F(Serve, UnstartedJobsAreKeptForTheNextSession) {
  {
    test::ServeProcess server({"--cell", test::kCell, "--data", data()}, log());
    begin_job(server.port(), "go", "left");
    ASSERT_NO_FATAL_FAILURE(wait_until_moving(server.port()));
    json back = test::move("left", test::kMiddle, test::kHome);
    back["id"] = "back";
    back["name"] = "=1+1";
    EXPECT_EQ(test::request(server.port(), "POST", "/api/v1/jobs", back.dump()).status, 202);
    server.signal(SIGTERM);
    EXPECT_EQ(server.wait(), 0);
  }
  test::ServeProcess server({"--cell", test::kCell, "--data", data()}, log());
  const auto job = [&](const std::string& id) {
    return test::request(server.port(), "GET", "/api/v1/jobs/" + id).json();
  };
  EXPECT_EQ(job("go")["state"], "interrupted");
  EXPECT_EQ(job("back")["state"], "queued") << "though the arm stands elsewhere: the queue is held";
  EXPECT_EQ(test::request(server.port(), "GET", "/api/v1/queue").json()["stopped"], true);

  const auto second = run("serve --cell " + test::kCell + " --listen 127.0.0.1:0 --data " + data());
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_NE(second.err.find("is in use by process"), std::string::npos) << second.err;

  const auto lines = run("history --data " + data() + " --state interrupted");
  EXPECT_EQ(lines.last_line(), job("go"));
  const auto table = run("history --data " + data() + " --csv");
  EXPECT_NE(table.out.find("\r\ngo,,interrupted,0,"), std::string::npos) << table.out;
  EXPECT_NE(table.out.find(",left,server_restart,"), std::string::npos) << table.out;
  EXPECT_NE(table.out.find("\r\nback,'=1+1,queued,"), std::string::npos)
      << "is no formula: " << table.out;
  EXPECT_EQ(run("history --data " + folder_.string()).exit_code, 2) << "there is no store";
  const auto who = std::filesystem::status(data() + "/armloom.db").permissions();
  EXPECT_EQ(who & std::filesystem::perms::others_all, std::filesystem::perms::none);
}

}  // namespace
}  // namespace armloom
