#include "test/server/command_fixture.h"

namespace armloom {
namespace {

using nlohmann::json;

using test::Outcome;

class ReachCommand : public test::CommandFixture {
 protected:
  [[nodiscard]] Outcome reach(const std::string& arguments) const {
    return run("reach --cell " + test::kCell + " --step 0.35 " + arguments);
  }
};

TEST_F(ReachCommand, ReportsTheReachOfEachArmAndTheOverlap) {
  const Outcome outcome = reach("--json --link panda_hand");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json told = outcome.last_line();
  ASSERT_EQ(told["arms"].size(), 2U);
  for (const json& arm : told["arms"]) {
    EXPECT_GT(arm["places"], 10);
    EXPECT_LT(arm["places"], told["places"]);
    EXPECT_GE(arm["poses"], arm["places"]);
    EXPECT_LE(arm["poses"], 5 * arm["places"].get<int>());
    EXPECT_GT(arm["upper"][2], 0.3) << "above the table";
  }
  EXPECT_EQ(told["arms"][0]["tool"], "left_panda_hand");
  EXPECT_LT(told["arms"][0]["lower"][0], told["arms"][1]["lower"][0]) << "left stands at -x";
  const json& both = told["overlaps"][0];
  EXPECT_EQ(both["arms"], json({"left", "right"}));
  EXPECT_GT(both["places"], 0);
  EXPECT_LT(both["places"], told["arms"][0]["places"]);
  EXPECT_EQ(both["by_either"].get<int>() + both["places"].get<int>(),
            told["arms"][0]["places"].get<int>() + told["arms"][1]["places"].get<int>());
  EXPECT_EQ(reach("--json --link panda_hand").out, outcome.out) << "the same again";
}

TEST_F(ReachCommand, WritesTablesAndAPicture) {
  const std::string picture = (folder_ / "reach.svg").string();
  const Outcome outcome = reach("--picture " + picture);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("| left | left_panda_link7 |"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("| left, right |"), std::string::npos) << outcome.out;
  const std::string svg = read_text_file(picture).value();
  EXPECT_TRUE(svg.starts_with("<svg "));
  for (const char* part : {"from above", "from the side", "reached by several", ">left<"}) {
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  }
}

// On one core, so that it takes longer than the two seconds without progress.
TEST_F(ReachCommand, ShowsProgressOnATerminalOnly) {
  const std::string command =
      std::string(ARMLOOM_BINARY) + " reach --step 0.22 --cell " + test::kCell;
  const std::string typed = (folder_ / "typed").string();
  ASSERT_EQ(std::system(("taskset -c 0 script -qec '" + command + "' /dev/null >" + typed).c_str()),
            0);
  const std::string shown = read_text_file(typed).value();
  EXPECT_NE(shown.find("armloom: reach: "), std::string::npos) << shown;
  EXPECT_NE(shown.find(" %, "), std::string::npos) << shown;
  EXPECT_EQ(reach("").err, "");
}

TEST_F(ReachCommand, RefusesBadInputWithPlaceAndRemedy) {
  const auto refused = [&](const std::string& arguments, const std::string& says) {
    const Outcome outcome = run("reach --cell " + test::kCell + " " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_NE(outcome.err.find(says), std::string::npos) << outcome.err;
  };
  refused("--link gripper", "arm left has no link gripper; it moves left_panda_link1");
  refused("--step 0.01", "give a larger step");
  refused("--step 7", "--step");
  refused("--step 0.5 --picture /nowhere/reach.svg", "cannot write /nowhere/reach.svg");
}

}  // namespace
}  // namespace armloom
