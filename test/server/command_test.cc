// The binary as outside tools call it: exit codes, the last line of stdout, one sentence on stderr.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "server/recording/recording.h"
#include "test/server/command_fixture.h"
#include "test/server/panda_jobs.h"
#include "test/server/wire.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::kCell;
using test::kSource;
using test::Outcome;

class Command : public test::CommandFixture {};

TEST_F(Command, ValidatePrintsWhatACellHolds) {
  const Outcome outcome = run("validate --cell " + kCell);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("left_panda_joint4"), std::string::npos);
  EXPECT_NE(outcome.out.find("home clearance"), std::string::npos);
  EXPECT_NE(outcome.out.find("\ntable   "), std::string::npos) << "among the shapes";
  EXPECT_EQ(outcome.err, "");
}

TEST_F(Command, ValidateMarksTheLimitsThatAreDefaults) {
  const fs::path cell =
      changed_cell("/robots/0/arms/0/limits",
                   {{"panda_joint1", {{"acceleration_rad_s2", 5}, {"jerk_rad_s3", 900}}}});
  const Outcome outcome = run("validate --cell " + cell.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto limits = [&](const std::string& joint) {  // without the spaces between
    std::istringstream line(outcome.out.substr(outcome.out.find("    " + joint) + 4));
    std::string text, word;
    for (int i = 0; i < 8 && line >> word; ++i) text += (i > 0 ? " " : "") + word;
    return text;
  };
  EXPECT_EQ(limits("left_panda_joint1"), "left_panda_joint1 -2.8973 2.8973 2.175 5 900 10* rad");
  EXPECT_EQ(limits("left_panda_joint2"),
            "left_panda_joint2 -1.7628 1.7628 2.175 3.75* 7500* 7.5* rad");
  EXPECT_EQ(limits("left_panda_finger_joint1"),
            "left_panda_finger_joint1 0 0.04 0.2 3.75* 7500* 7.5* m");
  EXPECT_NE(outcome.out.find("* a default: velocity 1, acceleration 3.75, jerk 7500, brake twice"),
            std::string::npos);
  EXPECT_EQ(outcome.err, "");
}

TEST_F(Command, ValidateWarnsOfABrakeWeakerThanTheAcceleration) {
  const fs::path cell =
      changed_cell("/robots/1/arms/0/limits", {{"panda_joint1", {{"brake_rad_s2", 1.5}}},
                                               {"panda_joint2", {{"brake_rad_s2", 3.75}}},
                                               {"panda_finger_joint1", {{"brake_m_s2", 0.5}}}});
  const Outcome outcome = run("validate --cell " + cell.string());
  EXPECT_EQ(outcome.exit_code, 0) << "no fault";
  const std::string limits = cell.string() + ":/robots/1/arms/0/limits/";
  EXPECT_EQ(outcome.err,
            "armloom: warning: " + limits +
                "panda_finger_joint1/brake_m_s2: joint right_panda_finger_joint1: brake_m_s2 is "
                "0.5, less than its acceleration_m_s2 of 3.75: a stop takes longer than the motion "
                "took to begin\n"
                "armloom: warning: " +
                limits +
                "panda_joint1/brake_rad_s2: joint right_panda_joint1: brake_rad_s2 is 1.5, less "
                "than its acceleration_rad_s2 of 3.75: a stop takes longer than the motion took to "
                "begin\n");
}

TEST_F(Command, NothingIsPrintedAsMinusZero) {
  const fs::path cell =
      changed_cell("/robots/0/arms/0/home", {-0.0, -1.2, -0.0, -2.6, 0.0, 1.6, 0.785});
  const Outcome outcome = run("validate --cell " + cell.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::istringstream words(outcome.out);
  for (std::string word; words >> word;) {
    EXPECT_FALSE(word == "-0" || word == "-0," || word == "-0;") << outcome.out;
  }
  EXPECT_NE(outcome.out.find("home 0, -1.2, 0, -2.6, 0, 1.6, 0.785"), std::string::npos);
}

TEST_F(Command, AnOptionThatCannotBeFollowedIsNamed) {
  const std::string jobs = conflicting_jobs().string();
  const fs::path taken = file("taken", "a file where a folder should be");
  const std::string simulate = "simulate --cell " + kCell + " --jobs " + jobs;
  const struct {
    std::string arguments;
    std::string says;
  } cases[] = {
      {simulate + " --seed -1", "--seed: -1 is no whole number from 0 to 18446744073709551615"},
      {simulate + " --seed 7.5", "--seed: 7.5 is no whole number"},
      {simulate + " --seed 18446744073709551616", "--seed: 18446744073709551616 is no"},
      {simulate + " --out " + taken.string(),
       "armloom: --out: the folder " + taken.string() + " cannot be written\n"},
      {"serve --listen 127.0.0.1:0 --cell " + kCell + " --data " + taken.string(),
       "armloom: --data: the folder " + taken.string() + " cannot be written: Not a directory\n"},
      {"serve --cell " + kCell + " --listen 8080", "armloom: --listen: expected ADDRESS:PORT"},
      {"serve --cell " + kCell + " --listen 127.0.0.1:70000",
       "armloom: --listen: expected ADDRESS:PORT"},
      {"serve --cell " + kCell + " --listen elsewhere:8080",
       "armloom: --listen: cannot listen on elsewhere:8080: not an IP address"},
      {"serve --listen 127.0.0.1:0 --cell " + kCell + " --web /nowhere",
       "armloom: --web: there is no folder /nowhere\n"},
      {"serve --listen 127.0.0.1:0 --cell " + kCell + " --allow-host a/b",
       "armloom: --allow-host: expected a host's name without a port (found \"a/b\")\n"},
      {"audit --cell " + kCell + " --recording /nowhere",
       "armloom: --recording: there is no folder /nowhere\n"},
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

TEST_F(Command, BadCellsAreNamedWithFilePlaceAndValue) {
  const struct {
    const char* pointer;
    json value;
    const char* says;
  } cases[] = {
      {"/robots/0/urdf", "missing.urdf", "missing.urdf"},
      {"/robots/0/urdf", file("broken.urdf", "<robot name='x'><link").string(), "broken.urdf"},
      {"/robots/1/arms/0/group", "no_such_group", "no_such_group"},
      {"/robots/1/prefix", "left_", "left_"},
      {"/clearance_m", "wide", "/clearance_m"},
      {"/unknown", 1, "/unknown"},
      {"/robots/1/base/xyz", {-0.3, 0, 0.1}, "/home"},  // on top of the other
      {"/scheduling/policy", "hopeful", "hopeful"},
  };
  for (const auto& bad : cases) {
    const fs::path cell = changed_cell(bad.pointer, bad.value);
    const Outcome outcome = run("validate --cell " + cell.string());
    EXPECT_EQ(outcome.exit_code, 2) << bad.pointer << outcome.out;
    EXPECT_NE(outcome.err.find(bad.says), std::string::npos) << outcome.err;
    EXPECT_EQ(run("simulate --cell " + cell.string() + " --jobs " + conflicting_jobs().string())
                  .exit_code,
              2);
  }
  EXPECT_EQ(run("validate --cell " + (folder_ / "nothing.json").string()).exit_code, 2);
  EXPECT_EQ(run("validate --cell " + file("cut.json", "{\"name\": ").string()).exit_code, 2);
}

TEST_F(Command, UsageErrorsEndWithTwo) {
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
  // A state more: both arms reach across the middle of the table, through each other.
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

TEST_F(Command, BadJobsFilesAreNamedBeforeAnythingRuns) {
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

TEST_F(Command, AJobRefusedAtItsTimeCountsAndEndsWithOne) {
  const json astray = test::move("left", test::kMiddle, test::kHome);  // the arm stands at home
  const std::string jobs =
      file("jobs.json", json::array({{{"at", 0}, {"job", astray}}}).dump()).string();
  const Outcome outcome = run("simulate --cell " + kCell + " --jobs " + jobs);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.last_line()["jobs"]["refused"], 1);
  EXPECT_NE(outcome.err.find("jobs.json:/0/job/trajectory/points/0"), std::string::npos)
      << outcome.err;
}

TEST_F(Command, CheckJudgesJobsAgainstEachOtherWithoutRunningThem) {
  const Outcome outcome = run("check --cell " + kCell + " --jobs " + conflicting_jobs().string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::vector<json> verdicts;
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) verdicts.push_back(json::parse(line));
  ASSERT_EQ(verdicts.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(verdicts[i]["id"], "j" + std::to_string(i));
  EXPECT_EQ(verdicts[0]["verdict"], "free");
  EXPECT_EQ(verdicts[0]["earliest_start_s"], 0.0);
  EXPECT_EQ(verdicts[2]["verdict"], "conflict");
  EXPECT_EQ(verdicts[2]["conflicts"][0]["id"], "j0");
  EXPECT_GT(verdicts[2]["evaluations"], 0);
  EXPECT_TRUE(verdicts[2]["earliest_start_s"].is_null());

  json one_arm = json::parse(read_text_file(conflicting_jobs()).value());
  one_arm.erase(3);
  one_arm.erase(2);
  const Outcome in_order =
      run("check --cell " + kCell + " --jobs " + file("one_arm.json", one_arm.dump()).string());
  EXPECT_EQ(in_order.last_line()["verdict"], "free");
  EXPECT_EQ(in_order.last_line()["earliest_start_s"], 3.0);  // when j0 has ended

  const Outcome sequential =
      run("check --policy sequential --cell " + kCell + " --jobs " + conflicting_jobs().string());
  EXPECT_NE(sequential.out.find("\"kind\":\"capacity\",\"id\":\"j0\""), std::string::npos)
      << sequential.out;
}

TEST_F(Command, CheckNamesBadJobsWithFilePlaceAndValue) {
  json jobs = json::parse(read_text_file(conflicting_jobs()).value());
  jobs[3]["job"] = test::move("right", test::kHome, test::kMiddle);  // it will stand in the middle
  const Outcome astray =
      run("check --cell " + kCell + " --jobs " + file("astray.json", jobs.dump()).string());
  EXPECT_EQ(astray.exit_code, 2);
  EXPECT_NE(astray.err.find("astray.json:/3/job/trajectory/points/0/positions/1"),
            std::string::npos)
      << astray.err;
  EXPECT_EQ(astray.out, "");
  const Outcome policy =
      run("check --policy hopeful --cell " + kCell + " --jobs " + conflicting_jobs().string());
  EXPECT_EQ(policy.exit_code, 2);
  EXPECT_NE(policy.err.find("hopeful"), std::string::npos) << policy.err;
}

// The address that the server prints, read through a pipe.
TEST_F(Command, ServeSaysItsAddressRefusesATakenPortAndEndsCleanlyOnSigterm) {
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

TEST(RecordingFolder, IsAnotherWhenOneIsThere) {
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
