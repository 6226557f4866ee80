#include <chrono>
#include <csignal>
#include <fstream>

#include "test/server/command_fixture.h"
#include "test/server/serve_process.h"
#include "test/server/wire.h"
#include "test/source_dir.h"

namespace armloom {
namespace {

using nlohmann::json;

// Returns the job when it has ended, or its state after a minute.
json ended(std::uint16_t port, const std::string& id) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  json job;
  do {
    job = test::request(port, "GET", "/api/v1/jobs/" + id, "").json();
  } while (job["result"].is_null() && std::chrono::steady_clock::now() < until);
  return job;
}

class ReplayCommand : public test::CommandFixture {
 protected:
  std::string data() const { return (folder_ / "data").string(); }
  // Runs a server with conflicting jobs, a changed priority, a goal, objects and a stop; then
  // kills it.
  void live() const {
    test::ServeProcess server({"--cell", test::kCell, "--data", data(), "--speed", "4"},
                              (folder_ / "log").string());
    const auto call = [&](const std::string& method, const std::string& path, const json& body) {
      const auto answer =
          test::request(server.port(), method, "/api/v1" + path, body.is_null() ? "" : body.dump());
      EXPECT_LT(answer.status, 300) << method << " " << path << ": " << answer.body;
      return answer;
    };
    json jobs = json::array();
    for (const char* arm : {"left", "right"}) {
      for (const bool there : {true, false}) {
        json job = test::move(arm, there ? test::kHome : test::kMiddle,
                              there ? test::kMiddle : test::kHome);
        job["id"] = std::string(arm) + (there ? "-there" : "-back");
        jobs.push_back(job);
      }
    }
    call("POST", "/batches", {{"jobs", jobs}});
    call("PATCH", "/jobs/right-there", {{"priority", 3}});
    call("POST", "/scene/objects",
         {{"name", "crate"},
          {"box", {0.1, 0.1, 0.1}},
          {"xyz", {0, 1.5, 0.1}},
          {"rpy", {0.1, 0.2, 0.3}}});
    call("POST", "/jobs", {{"id", "goal"}, {"arm", "left"}, {"move_to", {{"named", "ready"}}}});
    call("PUT", "/scene",
         {{"objects",
           {{{"name", "crate"}, {"box", {0.1, 0.1, 0.1}}, {"xyz", {0, 1.6, 0.1}}},
            {{"name", "rod"},
             {"cylinder", {0.02, 0.4}},
             {"rpy", {0.1, 0.2, 0.3}},
             {"xyz", {0, 2, 0.1}}}}}});
    call("POST", "/stop", nullptr);
    call("POST", "/resume", nullptr);
    call("PUT", "/speed", {{"speed_override", 0.7}});
    call("PUT", "/arms/left/speed", {{"speed_override", 0.6}});
    call("PUT", "/sim/speed", {{"speed", 20}});
    const json goal = ended(server.port(), "goal");
    EXPECT_EQ(goal["state"], "succeeded") << goal.dump();
    server.signal(SIGKILL);
    server.wait();
  }
};

TEST_F(ReplayCommand, ReproducesTheEventsOfAKilledServer) {
  live();
  const auto replayed = run("replay --data " + data() + " --out " + (folder_ / "again").string());
  EXPECT_EQ(replayed.exit_code, 0) << replayed.out << replayed.err;
  const json summary = replayed.last_line();
  EXPECT_EQ(summary["same"], true);
  EXPECT_GT(summary["events"], 30);
  EXPECT_GT(summary["ended_s"], 6.0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "again/events.jsonl"));
  const auto part = run("replay --recording " + data() + " --until 1.5");
  EXPECT_EQ(part.exit_code, 0) << part.out << part.err;
  EXPECT_LT(part.last_line()["events"], summary["events"]);
  EXPECT_NEAR(part.last_line()["ended_s"].get<double>(), 1.5, 0.01);
  const auto beyond = run("replay --recording " + data() + " --until 1e9");
  EXPECT_EQ(beyond.exit_code, 0) << beyond.err;
  EXPECT_EQ(beyond.last_line(), summary) << "nothing is known of what came after";
}

TEST_F(ReplayCommand, ReproducesASessionThatRestoredSpeedOverrides) {
  live();
  {
    test::ServeProcess server({"--cell", test::kCell, "--data", data(), "--speed", "20"},
                              (folder_ / "log").string());
    const auto call = [&](const char* method, const std::string& path, const std::string& body) {
      return test::request(server.port(), method, "/api/v1" + path, body);
    };
    const json left = call("GET", "/arms/left", "").json();
    EXPECT_EQ(left["speed_override"], 0.6);
    EXPECT_EQ(left["effective_speed_override"], 0.7 * 0.6);
    EXPECT_EQ(call("POST", "/resume", "").status, 202);
    EXPECT_EQ(call("POST", "/jobs", R"({"id": "go", "arm": "left", "move_to": {"named": "ready"}})")
                  .status,
              202);
    EXPECT_EQ(ended(server.port(), "go")["state"], "succeeded");
    server.signal(SIGKILL);
    server.wait();
  }
  const auto replayed = run("replay --data " + data());
  EXPECT_EQ(replayed.exit_code, 0) << replayed.out << replayed.err;
  EXPECT_EQ(replayed.last_line()["same"], true);
}

// Includes meshes: the cell's original files are not needed.
TEST_F(ReplayCommand, WorksAfterTheFolderWasMoved) {
  namespace fs = std::filesystem;
  const fs::path source = source_dir(), site = folder_ / "site";
  fs::create_directories(site);
  for (const char* part : {"config", "models"})
    fs::copy(source / part, site / part, fs::copy_options::recursive);
  const json jobs =
      json::parse(read_text_file(source / "config/two_shuttles_jobs.json").value(), nullptr, true);
  {
    test::ServeProcess server(
        {"--cell", (site / "config/two_shuttles.json").string(), "--data", data(), "--speed", "20"},
        (folder_ / "log").string());
    const json first = jobs.front()["job"];
    const std::string id = "first";
    json job = first;
    job["id"] = id;
    const auto accepted = test::request(server.port(), "POST", "/api/v1/jobs", job.dump());
    ASSERT_EQ(accepted.status, 202) << accepted.body;
    const json done = ended(server.port(), "first");
    EXPECT_EQ(done["state"], "succeeded") << done.dump();
    server.signal(SIGKILL);
    server.wait();
  }
  fs::remove_all(site);
  fs::create_directories(folder_ / "elsewhere/deep");
  fs::rename(data(), folder_ / "elsewhere/deep/report");
  const auto replayed = run("replay --data " + (folder_ / "elsewhere/deep/report").string());
  EXPECT_EQ(replayed.exit_code, 0) << replayed.out << replayed.err;
  EXPECT_EQ(replayed.last_line()["same"], true);
}

TEST_F(ReplayCommand, ReportsTheFirstDifference) {
  live();
  const auto file_of = [&](const char* name) { return std::filesystem::path(data()) / name; };
  std::string events = read_text_file(file_of("events.jsonl")).value();
  const std::size_t at = events.find("\"running\"");
  ASSERT_NE(at, std::string::npos);
  std::ofstream(file_of("events.jsonl")) << events.replace(at, 9, "\"paused\"");
  const auto replayed = run("replay --data " + data());
  EXPECT_EQ(replayed.exit_code, 1);
  EXPECT_EQ(replayed.last_line()["same"], false);
  EXPECT_NE(replayed.err.find("recorded: {"), std::string::npos) << replayed.err;
}

TEST_F(ReplayCommand, ReportsTheNumberOfComparedEvents) {
  live();
  const auto file = std::filesystem::path(data()) / "events.jsonl";
  const json whole = run("replay --data " + data()).last_line();
  EXPECT_GT(whole["compared"], 30);
  std::string events = read_text_file(file).value();
  events.resize(events.find('\n', events.find('\n') + 1) + 1);
  std::ofstream(file) << events;
  const auto cut = run("replay --data " + data());
  EXPECT_EQ(cut.last_line()["compared"], 2);
  EXPECT_NE(cut.err.find("2 of "), std::string::npos) << cut.err;
  std::filesystem::remove(file);
  const auto nothing = run("replay --data " + data());
  EXPECT_EQ(nothing.exit_code, 1);
  EXPECT_TRUE(nothing.last_line()["same"].is_null()) << nothing.out;
}

TEST_F(ReplayCommand, RefusesAFolderWithoutARecording) {
  const auto none = run("replay --data " + folder_.string());
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.err.find("--data: no inputs.jsonl in " + folder_.string()), std::string::npos)
      << none.err;
}

}  // namespace
}  // namespace armloom
