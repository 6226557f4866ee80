#include "test/server/command_fixture.h"

namespace armloom {
namespace {

using nlohmann::json;

using test::Outcome;

class PlanCommand : public test::CommandFixture {
 protected:
  [[nodiscard]] Outcome plan(const std::string& arguments) const {
    return run("plan --cell " + test::kCell + " --arm left " + arguments);
  }
};

TEST_F(PlanCommand, WritesAJobThatCheckAndSimulateAccept) {
  for (const std::string to :
       {"ready", "'[1.2, -0.4, 0.3, -1.9, 0.1, 1.8, 0.2]'",
        "'{\"pose\": {\"link\": \"left_panda_link8\", \"xyz\": [0, 0.2, 0.5], \"rpy\": [3.14, 0, "
        "0]}}'"}) {
    SCOPED_TRACE(to);
    const auto out = folder_ / "job.json";
    const Outcome planned = plan("--to " + to + " --out " + out.string());
    ASSERT_EQ(planned.exit_code, 0) << planned.err;
    const json job = json::parse(read_text_file(out).value());
    const auto jobs = file("jobs.json", json::array({{{"at", 0.0}, {"job", job}}}).dump()).string();
    const Outcome checked = run("check --cell " + test::kCell + " --jobs " + jobs);
    EXPECT_EQ(checked.last_line()["verdict"], "free") << checked.out << checked.err;
    const std::string recording = (folder_ / "recording").string();
    const Outcome ran =
        run("simulate --cell " + test::kCell + " --jobs " + jobs + " --out " + recording);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    const Outcome audited = run("audit --cell " + test::kCell + " --recording " + recording);
    EXPECT_EQ(audited.exit_code, 0) << audited.out;
  }
}

TEST_F(PlanCommand, RepeatsForASeedAndPrintsTheJob) {
  const Outcome first = plan("--to extended --from ready --seed 7");
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(plan("--to extended --from ready --seed 7").out, first.out);
  EXPECT_EQ(first.last_line()["trajectory"]["joint_names"].size(), 7u);
}

TEST_F(PlanCommand, ReportsWhyThereIsNoPlan) {
  const Outcome in_the_table = plan("--to '[0, 1.7, 0, -1, 0, 1, 0]'");
  EXPECT_EQ(in_the_table.exit_code, 1);
  EXPECT_EQ(in_the_table.last_line()["result"], "goal-in-collision");
  EXPECT_EQ(in_the_table.last_line()["links"].size(), 2u);
  EXPECT_EQ(in_the_table.last_line()["required_clearance_m"], 0.02);
  EXPECT_EQ(in_the_table.last_line()["nearest"].size(), 7u);
  const Outcome too_far = plan("--to '{\"pose\": {\"xyz\": [3, 0, 0.5]}}'");
  EXPECT_EQ(too_far.exit_code, 1);
  EXPECT_EQ(too_far.last_line()["result"], "goal-not-reached");
  EXPECT_EQ(plan("--to '[0, 0, 0, 1, 0, 1, 0]'").last_line()["result"], "outside-limits");
}

// Only the right arm can reach the pose.
TEST_F(PlanCommand, SelectsTheArmThatArrivesFirst) {
  const auto by_arms = [&](const std::string& arguments) {
    return run("plan --cell " + test::kCell + " --arms left,right " + arguments);
  };
  const std::string far = "'{\"pose\": {\"xyz\": [0.75, 0.45, 0.5], \"rpy\": [3.14, 0, 0]}}'";
  const Outcome planned = by_arms("--to " + far);
  ASSERT_EQ(planned.exit_code, 0) << planned.err;
  EXPECT_EQ(planned.last_line()["trajectory"]["joint_names"][0], "right_panda_joint1");
  EXPECT_EQ(by_arms("--to ready --from extended").exit_code, 0);
  const Outcome nobody = by_arms("--to '{\"pose\": {\"xyz\": [0, 9, 0.5]}}'");
  EXPECT_EQ(nobody.exit_code, 1);
  const std::string detail = nobody.last_line()["detail"];
  EXPECT_NE(detail.find("left: "), std::string::npos) << detail;
  EXPECT_NE(detail.find("right: "), std::string::npos) << detail;
  EXPECT_EQ(by_arms("--arm left --to ready").exit_code, 2);
  EXPECT_EQ(run("plan --cell " + test::kCell + " --to ready").exit_code, 2);
  EXPECT_EQ(run("plan --cell " + test::kCell + " --arms left,lft --to ready").exit_code, 2);
}

TEST_F(PlanCommand, RefusesBadInputWithPlaceAndRemedy) {
  const auto refused = [&](const std::string& arguments, const std::string& says) {
    const Outcome outcome = plan(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_NE(outcome.err.find(says), std::string::npos) << outcome.err;
  };
  refused("--to redy", "did you mean ready?");
  refused("--to '[0, 1]'", "7 joints, found 2");
  refused("--to '{\"named\": \"ready\", \"joints\": []}'", "--to");
  refused("--to '{\"pose\": {\"link\": \"left_tool\", \"xyz\": [0, 0, 1]}}'", "no link left_tool");
  refused("--to '{\"pose\": {\"rpy\": [0, 0, 0]}}'", "\"xyz\" is missing");
  refused("--to '{\"pose\": {\"xyz\": [0, 0]}}'", "--to /pose/xyz: ");
  refused("--to '{\"pse\": 1}'", "pse");
  refused("--to ready --budget 0", "--budget");
  refused("--to ready --from '{\"pose\": {\"xyz\": [0, 0, 1]}}'", "--from");
  refused("--to ready --out /no/such/folder/job.json", "--out");
  const Outcome unknown = run("plan --cell " + test::kCell + " --arm lft --to ready");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("left, right"), std::string::npos) << unknown.err;
}

}  // namespace
}  // namespace armloom
