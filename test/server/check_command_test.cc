#include <sstream>
#include <vector>

#include "test/server/command_fixture.h"

namespace armloom {
namespace {

using nlohmann::json;
using test::kCell;
using test::Outcome;

class CheckCommand : public test::CommandFixture {};

TEST_F(CheckCommand, ChecksJobsAgainstEachOtherWithoutRunningThem) {
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

TEST_F(CheckCommand, NamesBadJobsWithFilePlaceAndValue) {
  json jobs = json::parse(read_text_file(conflicting_jobs()).value());
  // the arm will be in the middle
  jobs[3]["job"] = test::move("right", test::kHome, test::kMiddle);
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

TEST_F(CheckCommand, GoesThroughTheStepsOfAJob) {
  const std::string cell =
      changed_cell("/objects/-",
                   {{"name", "part"}, {"box", {0.04, 0.04, 0.08}}, {"xyz", {-0.1, 0.35, 0.141}}})
          .string();
  const auto hand_to = [](double y_m) -> json {
    const json pose = {
        {"link", "left_panda_hand"}, {"xyz", {-0.1, y_m, 0.25}}, {"rpy", {3.14159265, 0, 0.785}}};
    return {{"arm", "left"}, {"move_to", {{"pose", pose}}}};
  };
  const json attach = {
      {"attach", {{"object", "part"}, {"link", "left_panda_hand"}, {"touch", {"table"}}}}};
  const json ready = {{"arm", "left"}, {"move_to", {{"named", "ready"}}}};
  const json holds = {hand_to(0.35), attach, ready, hand_to(-0.35)};
  const json bare = {hand_to(0.35), ready, hand_to(-0.35)};
  for (const json& steps : {holds, bare}) {
    const json jobs = {{{"at", 0}, {"job", {{"id", "pick"}, {"steps", steps}}}}};
    const Outcome outcome = run("check --cell " + (steps == holds ? cell : kCell) + " --jobs " +
                                file("steps.json", jobs.dump()).string());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json verdict = outcome.last_line();
    EXPECT_EQ(verdict["id"], "pick");
    EXPECT_EQ(verdict["verdict"], steps == holds ? "conflict" : "free") << verdict;
    if (steps == bare) continue;
    EXPECT_EQ(verdict["step"], 3);
    EXPECT_EQ(verdict["earliest_start_s"], 0.0);
    EXPECT_EQ(verdict["result"]["reason"], "no_plan");
    EXPECT_NE(verdict["result"]["detail"].get<std::string>().find("table"), std::string::npos);
  }
  const json bad = {{{"at", 0}, {"job", {{"steps", {ready, attach}}}}}};
  const Outcome refused =
      run("check --cell " + cell + " --jobs " + file("bad.json", bad.dump()).string());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("bad.json:/0/job/steps/1/attach/link"), std::string::npos)
      << refused.err;
}

}  // namespace
}  // namespace armloom
