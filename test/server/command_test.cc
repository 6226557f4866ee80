// The binary's interface for scripts: exit codes, last line of stdout, one sentence on stderr.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "server/recording/recording.h"
#include "test/server/command_fixture.h"
#include "test/server/panda_jobs.h"
#include "test/server/wire.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::kCell;
using test::Outcome;

class Command : public test::CommandFixture {};

TEST_F(Command, NamesAnInvalidOption) {
  const std::string jobs = conflicting_jobs().string();
  const fs::path taken = file("taken", "a file where a folder should be");
  const std::string simulate = "simulate --cell " + kCell + " --jobs " + jobs;
  const struct {
    std::string arguments;
    std::string says;
  } cases[] = {
      {simulate + " --seed -1", "--seed: -1 is not an integer from 0 to 18446744073709551615"},
      {simulate + " --seed 7.5", "--seed: 7.5 is not an integer"},
      {simulate + " --seed 18446744073709551616", "--seed: 18446744073709551616 is no"},
      {simulate + " --out " + taken.string(),
       "armloom: --out: the folder " + taken.string() + " cannot be written\n"},
      {"serve --listen 127.0.0.1:0 --cell " + kCell + " --data " + taken.string(),
       "armloom: --data: the folder " + taken.string() + " cannot be written: Not a directory\n"},
      {"serve --cell " + kCell + " --listen 8080", "armloom: --listen: expected ADDRESS:PORT"},
      {"serve --cell " + kCell + " --listen 127.0.0.1:70000",
       "armloom: --listen: expected ADDRESS:PORT"},
      {"serve --cell " + kCell + " --listen elsewhere:8080",
       "armloom: --listen: cannot listen on elsewhere:8080: not an IP address; names are not "
       "resolved, use 127.0.0.1 for localhost"},
      {"serve --cell " + kCell + " --listen localhost",
       "expected ADDRESS:PORT, for example 127.0.0.1:8080 for this machine only"},
      {"history --data /nowhere --state foo", "--state: foo not in {queued,"},
      {"replay --data /nowhere --until -1", "--until: "},
      {"serve --listen 127.0.0.1:0 --cell " + kCell + " --web /nowhere",
       "armloom: --web: no such folder: /nowhere\n"},
      {"serve --listen 127.0.0.1:0 --cell " + kCell + " --allow-host a/b",
       "armloom: --allow-host: expected a host name without a port (found \"a/b\")\n"},
      {"audit --cell " + kCell + " --recording /nowhere",
       "armloom: --recording: no such folder: /nowhere\n"},
      {"arm --cell " + kCell + " --robot left --listen unix:/nowhere/left",
       "armloom: --robot: the server simulates this robot itself and never connects to a process"},
      {"validate --cell /dev/zero", "armloom: /dev/zero: it is neither a file nor a pipe\n"},
      {"serve --listen 127.0.0.1:0 --cell " + kCell + " --policy hopeful", "armloom: --policy: "},
      {simulate + " --policy hopeful", "armloom: --policy: "},
      {"check --cell " + kCell + " --jobs " + jobs + " --policy hopeful", "armloom: --policy: "},
  };
  for (const auto& bad : cases) {
    const Outcome outcome = run(bad.arguments);
    EXPECT_EQ(outcome.exit_code, 2) << bad.arguments;
    EXPECT_NE(outcome.err.find(bad.says), std::string::npos) << bad.arguments << '\n'
                                                             << outcome.err;
    EXPECT_EQ(outcome.err.find("two_pandas.json"), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(run(simulate + " --seed 18446744073709551615").exit_code, 0);
}

TEST_F(Command, ExitsWithTwoOnUsageErrors) {
  EXPECT_EQ(run("").exit_code, 2);
  EXPECT_EQ(run("fly").exit_code, 2);
  EXPECT_EQ(run("validate").exit_code, 2);
  EXPECT_EQ(run("simulate --cell " + kCell + " --jobs x --seed minus").exit_code, 2);
  EXPECT_EQ(run("--help").exit_code, 0);
}

TEST_F(Command, AuditFindsTheContactInADoctoredRecording) {
  ASSERT_EQ(run("simulate --cell " + kCell + " --jobs " + conflicting_jobs().string() + " --out " +
                folder_.string())
                .exit_code,
            0);
  // Appends a state in which both arms reach across the middle of the table, through each other.
  constexpr test::Pose kReaching{0, 0.3, 0, -1.8, 0, 2.1, 0.785};
  std::string states = read_text_file(folder_ / "states.csv").value();
  const double end_s = std::stod(states.substr(states.rfind('\n', states.size() - 2) + 1));
  states += std::to_string(end_s + 1.0);
  for (int arm = 0; arm < 2; ++arm) {
    for (const double q : kReaching) states += "," + std::to_string(q);
    states += ",0";
  }
  file("states.csv", states + "\n");
  const Outcome outcome =
      run("audit --step 0.01 --cell " + kCell + " --recording " + folder_.string());
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_EQ(outcome.last_line()["contact"]["links"].size(), 2U);

  file("states.csv", states + "\n" + std::to_string(end_s + 2.0) + ",x\n");
  const Outcome broken = run("audit --cell " + kCell + " --recording " + folder_.string());
  EXPECT_EQ(broken.exit_code, 2);
  EXPECT_NE(broken.err.find("states.csv:"), std::string::npos) << broken.err;
  EXPECT_EQ(run("audit --cell " + kCell + " --recording " + (folder_ / "no").string()).exit_code,
            2);
}

TEST_F(Command, ReportsABadJobsFileBeforeAnythingRuns) {
  json bad = test::move("left", test::kHome, test::kMiddle);
  bad["trajectory"]["joint_names"][0] = "left_panda_joint9";
  const std::string jobs =
      file("jobs.json", json::array({{{"at", 0}, {"job", bad}}}).dump()).string();
  const Outcome outcome = run("simulate --cell " + kCell + " --jobs " + jobs + " --out " +
                              (folder_ / "out-dir").string());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("jobs.json:/0/job/trajectory/joint_names/0"), std::string::npos)
      << outcome.err;
  EXPECT_FALSE(fs::exists(folder_ / "out-dir"));
  EXPECT_EQ(run("simulate --cell " + kCell + " --jobs " + file("no.json", "{").string()).exit_code,
            2);
}

TEST_F(Command, ExitsWithOneIfAJobIsRefused) {
  const json astray = test::move("left", test::kMiddle, test::kHome);  // the arm is at home
  const std::string jobs =
      file("jobs.json", json::array({{{"at", 0}, {"job", astray}}}).dump()).string();
  const Outcome outcome = run("simulate --cell " + kCell + " --jobs " + jobs);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.last_line()["jobs"]["refused"], 1);
  EXPECT_NE(outcome.err.find("jobs.json:/0/job/trajectory/points/0"), std::string::npos)
      << outcome.err;
}

TEST_F(Command, ServePrintsItsAddressAndEndsCleanlyOnSigterm) {
  int pipe_ends[2];
  ASSERT_EQ(pipe(pipe_ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    dup2(pipe_ends[1], STDOUT_FILENO);
    execl(ARMLOOM_BINARY, "armloom", "serve", "--cell", kCell.c_str(), "--listen", "127.0.0.1:0",
          "--speed", "10", "--data", (folder_ / "data").c_str(), "--record", nullptr);
    _exit(99);
  }
  close(pipe_ends[1]);
  FILE* out = fdopen(pipe_ends[0], "r");
  char line[256] = {};
  ASSERT_NE(fgets(line, sizeof line, out), nullptr);
  unsigned port = 0;
  ASSERT_EQ(std::sscanf(line, "dashboard: http://127.0.0.1:%u/", &port), 1) << line;
  EXPECT_EQ(test::request(static_cast<std::uint16_t>(port), "GET", "/readyz").status, 200);
  EXPECT_EQ(test::request(static_cast<std::uint16_t>(port), "POST", "/api/v1/jobs",
                          test::move("left", test::kHome, test::kMiddle).dump())
                .status,
            202);
  const Outcome second =
      run("serve --cell " + kCell + " --listen 127.0.0.1:" + std::to_string(port));
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_NE(second.err.find("cannot listen on 127.0.0.1:"), std::string::npos) << second.err;

  test::Listener listener(static_cast<std::uint16_t>(port));
  EXPECT_EQ(listener.next_event()["type"], "snapshot");
  kill(child, SIGTERM);
  while (listener.next()) {
  }
  EXPECT_EQ(listener.closed().code, 1001) << "going away";
  int status = 0;
  waitpid(child, &status, 0);
  fclose(out);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(json::parse(read_text_file(folder_ / "data/jobs.json").value()).size(), 1U);
  EXPECT_NE(read_text_file(folder_ / "data/events.jsonl").value().find("\"state\":\"queued\""),
            std::string::npos);
  EXPECT_EQ(run("audit --cell " + kCell + " --recording " + (folder_ / "data").string()).exit_code,
            0);
}

TEST(RecordingFolder, IsNewIfTheFolderHasARecording) {
  const fs::path folder = fs::path(::testing::TempDir()) / "armloom-recording-folder";
  fs::remove_all(folder);
  EXPECT_EQ(Recording::unused_folder(folder), folder);
  fs::create_directories(folder);
  EXPECT_EQ(Recording::unused_folder(folder), folder) << "nothing in it yet";
  std::ofstream(folder / "events.jsonl") << "{}\n";
  const fs::path second = Recording::unused_folder(folder);
  EXPECT_EQ(second.parent_path(), folder);
  fs::create_directories(second);
  const fs::path third = Recording::unused_folder(folder);
  EXPECT_NE(third, second);
  EXPECT_EQ(third.parent_path(), folder);
}

}  // namespace
}  // namespace armloom
