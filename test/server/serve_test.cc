// The server as a process: what it does when the system gives less than it wants, or asks it to
// end.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <memory>
#include <thread>

#include "test/server/command_fixture.h"
#include "test/server/serve_process.h"
#include "test/server/wire.h"

namespace armloom {
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

class Serve : public test::CommandFixture {
 protected:
  std::string log() const { return (folder_ / "log").string(); }
  std::string data() const { return (folder_ / "data").string(); }
  static json begin_job(std::uint16_t port, const std::string& id, const std::string& arm) {
    json job = test::move(arm, test::kHome, test::kMiddle);
    job["id"] = id;
    const auto answer = test::request(port, "POST", "/api/v1/jobs", job.dump());
    EXPECT_EQ(answer.status, 202) << answer.body;
    return job;
  }
  // All events of the recording; each line is whole.
  std::vector<json> events() const {
    std::vector<json> all;
    std::ifstream in(folder_ / "data/events.jsonl");
    for (std::string line; std::getline(in, line);) all.push_back(json::parse(line));
    return all;
  }
  static bool has_ended(const json& event, const std::string& id) {
    return event["type"] == "job" && event["data"]["id"] == id &&
           !event["data"]["result"].is_null();
  }
};

void wait_until_moving(std::uint16_t port) {
  const auto deadline = Clock::now() + std::chrono::seconds(10);
  while (test::request(port, "GET", "/api/v1/arms/left").json()["state"] != "moving") {
    ASSERT_LT(Clock::now(), deadline);
  }
}

TEST_F(Serve, ASignalBringsArmsToRestAndTheRecordingIsWhole) {
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

// Who ends the server knows that the arms stop with it: what there is to see to, the next one says.
TEST_F(Serve, AnEndStopsNoArmForTheNextRunAndIsNoAlert) {
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
            "stopped: left, right (the server was started again: 1 job waits; "
            "resume to go on)\nstopped: right (operator)\n");
  end(third);
}

TEST_F(Serve, AnArmThatDoesNotComeToRestHoldsNothingUp) {
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

TEST_F(Serve, EventsAreOnTheirWayToTheDiskWhenTheyAreTold) {
  test::ServeProcess server({"--cell", test::kCell, "--data", data()}, log());
  begin_job(server.port(), "go", "left");
  ASSERT_NO_FATAL_FAILURE(wait_until_moving(server.port()));
  server.signal(SIGKILL);
  EXPECT_EQ(server.wait(), -SIGKILL);
  EXPECT_FALSE(events().empty());
}

// No file may grow beyond 1 MB, as on a disk that is full. The store, which has all commands, needs
// less: an event of the scene names every object. Of the store on such a disk: Durable.
TEST_F(Serve, ADiskThatFillsUpIsSaidAtOnceAndAtTheEnd) {
  test::ServeProcess server({"--cell", test::kCell, "--data", data()}, log(),
                            // More than the database's log ever has.
                            [] { test::set_limit(RLIMIT_FSIZE, 5'242'880); });
  const auto put = [&](const std::string& name) {
    const json box = {{"name", name}, {"box", {0.1, 0.1, 0.1}}, {"xyz", {0, 0, 3}}};
    return test::request(server.port(), "POST", "/api/v1/scene/objects", box.dump()).status;
  };
  // Each event tells the whole scene, which has long names.
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
  while (server.log().find("the recording is no longer whole") == std::string::npos) {
    ASSERT_LT(Clock::now(), deadline) << server.log();
  }
  EXPECT_NE(ready.json()["detail"].get<std::string>().find("until the server is started again"),
            std::string::npos);
  // It is an alert, which somebody sees to.
  const auto alerts = test::request(server.port(), "GET", "/api/v1/alerts").json()["alerts"];
  const auto lost = std::ranges::find_if(alerts, [](const json& alert) {
    return alert["text"].get<std::string>().starts_with("the recording is no longer whole");
  });
  ASSERT_NE(lost, alerts.end()) << alerts;
  EXPECT_EQ((*lost)["level"], "error");
  const json seen{{"ids", {(*lost)["id"]}}, {"who", "Ada"}};
  test::request(server.port(), "POST", "/api/v1/alerts/acknowledge", seen.dump());
  server.signal(SIGTERM);
  EXPECT_EQ(server.wait(), 74);
  EXPECT_NE(server.log().find("not all is written: "), std::string::npos) << server.log();
}

// Whatever the process has to count with: of 64 descriptors all are taken.
TEST_F(Serve, AStopIsTakenWhenTheDescriptorsAreUsedUp) {
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

// As under a debugger: who held the button has let it go for all that the server knows.
TEST_F(Serve, AMoveByHandIsOverAfterTheProcessWasStopped) {
  test::ServeProcess server({"--cell", test::kCell, "--hold-lease", "0.3"}, log());
  const auto ask = [&](const char* method, const std::string& path, const json& body) {
    return test::request(server.port(), method, "/api/v1" + path, body.dump());
  };
  const json key{{"control", ask("POST", "/control", {{"who", "Ada"}}).json()["key"]}};
  json hold = key;
  hold["to"] = {{"named", "ready"}};
  ASSERT_EQ(ask("POST", "/arms/left/hold", hold).status, 202);
  server.signal(SIGSTOP);
  std::this_thread::sleep_for(std::chrono::milliseconds(400));
  server.signal(SIGCONT);
  const auto late = ask("PUT", "/arms/left/hold", key);
  EXPECT_EQ(late.status, 409) << late.body;
}

TEST_F(Serve, ASignalLeavesWhatHasNotBegunToTheNextServer) {
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
}

TEST_F(Serve, WithFewDescriptorsWhoComesIsToldSo) {
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

// So few that not even half of them are left for connections.
TEST_F(Serve, WithoutADescriptorWhoComesIsToldSoAndFilesSayBusy) {
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
