#include <gmock/gmock.h>

#include <fstream>

#include "server/codec/json_text.h"
#include "test/server/command_fixture.h"
#include "test/server/torso_robot.h"

namespace armloom {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

class Import : public test::CommandFixture {
 protected:
  std::string files(const std::string& model) const {
    const std::string path = (test::kSource / "models" / model).string();
    return " --urdf " + path + ".urdf --srdf " + path + ".srdf";
  }
  json written(const std::string& name) const {
    return parse_json(read_text_file(folder_ / name).value(), JsonComments::allowed).value();
  }
};

TEST_F(Import, MakesACellWithTwoRobotsFromOneUrdf) {
  const fs::path cell = folder_ / "cell.json";
  const test::Outcome made =
      run("import" + files("panda") +
          " --robot left:x=-0.6 --robot right:x=0.6,yaw_deg=180 --out " + cell.string());
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(made.out, "");
  const json file = written("cell.json");
  EXPECT_EQ(file["name"], "cell");
  ASSERT_EQ(file["robots"].size(), 2U);
  const json& right = file["robots"][1];
  EXPECT_EQ(right["prefix"], "right_");
  EXPECT_TRUE(fs::path(right["urdf"]).is_relative()) << right["urdf"];
  EXPECT_NEAR(right["base"]["rpy"][2].get<double>(), 3.14159265358979, 1e-12);
  ASSERT_EQ(right["arms"].size(), 1U);
  EXPECT_EQ(right["arms"][0]["name"], "right");
  EXPECT_EQ(right["arms"][0]["group"], "panda_arm");
  EXPECT_THAT(made.err, HasSubstr("The group hand is not used as an arm: it is an end effector."));
  EXPECT_EQ(file["clearance_m"], 0.02);
  EXPECT_EQ(file["execution"]["duration_scaling"], 1.1);
  const std::string text = read_text_file(cell).value();
  EXPECT_THAT(text, HasSubstr("// Monitoring of the measured state of all arms."));
  EXPECT_EQ(run("validate --cell " + cell.string()).exit_code, 0);
  EXPECT_EQ(run("import" + files("panda") + " --out " + cell.string()).exit_code, 2);
  EXPECT_EQ(read_text_file(cell).value(), text);  // existing files are never overwritten
}

TEST_F(Import, WritesAbsolutePathsToStdout) {
  const test::Outcome made = run("import" + files("dual_panda") + " --name pair");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const json file = parse_json(made.out, JsonComments::allowed).value();
  EXPECT_EQ(file["name"], "pair");
  ASSERT_EQ(file["robots"].size(), 1U);
  EXPECT_TRUE(fs::path(file["robots"][0]["urdf"]).is_absolute());
  ASSERT_EQ(file["robots"][0]["arms"].size(), 2U);
  EXPECT_EQ(file["robots"][0]["arms"][0]["name"], "left_arm");
  EXPECT_EQ(run("validate --cell " + this->file("copy.json", made.out).string()).exit_code, 0);
}

TEST_F(Import, AcceptsRobotsOfDifferentKinds) {
  const test::Outcome made =
      run("import" + files("panda") + files("ur5e") + " --robot a:x=-1 --robot b:x=1");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const json file = parse_json(made.out, JsonComments::allowed).value();
  EXPECT_THAT(file["robots"][1]["urdf"].get<std::string>(), HasSubstr("ur5e.urdf"));
  EXPECT_EQ(file["robots"][1]["prefix"], "b_");
}

TEST_F(Import, GuessesMissingLimitsAndFixesTheTorso) {
  std::string urdf = test::torso_urdf();
  // Makes one shoulder continuous without limits, and one joint prismatic with zero velocity.
  const auto drop = [&](const std::string& begin, const std::string& what, const std::string& by) {
    const std::size_t at = urdf.find(what, urdf.find("<joint name=\"" + begin + "\""));
    ASSERT_NE(at, urdf.npos);
    urdf.replace(at, what.size(), by);
  };
  drop("left_1", R"(type="revolute")", R"(type="continuous")");
  drop("left_1", R"(<limit lower="-2.5" upper="2.5" effort="1" velocity="1"/>)", "");
  drop("right_2", R"(type="revolute")", R"(type="prismatic")");
  drop("right_2", R"(velocity="1")", R"(velocity="0")");
  const std::string arguments = "import --urdf " + file("torso.urdf", urdf).string() + " --srdf " +
                                file("torso.srdf", test::torso_srdf()).string();
  const test::Outcome made = run(arguments + " --out " + (folder_ / "cell.json").string());
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const json robot = written("cell.json")["robots"][0];
  EXPECT_EQ(robot["fixed"], json({{"torso_lift", 0.1}}));
  ASSERT_EQ(robot["arms"].size(), 2U);
  EXPECT_EQ(robot["arms"][0]["home"], "left_home");
  EXPECT_EQ(robot["arms"][0]["limits"], json({{"left_1", {{"velocity_rad_s", 0.5}}}}));
  EXPECT_EQ(robot["arms"][1]["limits"], json({{"right_2", {{"velocity_m_s", 0.05}}}}));
  EXPECT_THAT(made.err, HasSubstr("torso.urdf does not give all limits of left_1"));
  EXPECT_THAT(made.err,
              HasSubstr("torso_lift moves arms and belongs to no single arm: fixed at its "
                        "value in the state home."));
  // With MoveIt's joint limits file nothing has to be guessed.
  const fs::path limits = file("joint_limits.yaml",
                               "joint_limits:\n"
                               "  left_1:\n    has_velocity_limits: true\n    max_velocity: 2\n"
                               "  right_2:\n    has_velocity_limits: true\n    max_velocity: 1\n");
  const test::Outcome told = run(arguments + " --joint-limits " + limits.string() + " --out " +
                                 (folder_ / "told.json").string());
  ASSERT_EQ(told.exit_code, 0) << told.err;
  EXPECT_FALSE(written("told.json")["robots"][0]["arms"][0].contains("limits"));
  EXPECT_EQ(written("told.json")["robots"][0]["joint_limits"], "joint_limits.yaml");
}

TEST_F(Import, GuessesNoLimitsOfFixedJoints) {
  std::string urdf = test::torso_urdf();
  for (const std::string joint : {"torso_lift", "left_1"}) {
    const std::string limit = R"(velocity="1")";
    urdf.replace(urdf.find(limit, urdf.find("<joint name=\"" + joint + "\"")), limit.size(), "");
  }
  const fs::path srdf = file("torso.srdf", R"(<robot name="torso_robot">
    <group name="l"><chain base_link="base" tip_link="left_3_link"/></group>
    <group name="r"><chain base_link="base" tip_link="right_3_link"/></group></robot>)");
  const fs::path cell = folder_ / "cell.json";
  const test::Outcome made = run("import --urdf " + file("torso.urdf", urdf).string() + " --srdf " +
                                 srdf.string() + " --out " + cell.string());
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const json robot = written("cell.json")["robots"][0];
  EXPECT_EQ(robot["fixed"], json({{"torso_lift", 0.0}}));
  EXPECT_EQ(robot["arms"][0]["limits"], json({{"left_1", {{"velocity_rad_s", 0.5}}}}));
  EXPECT_FALSE(robot["arms"][1].contains("limits"));
  EXPECT_THAT(made.err, HasSubstr("does not give all limits of left_1:"));
  EXPECT_THAT(run("validate --cell " + cell.string()).err, Not(HasSubstr("limits")));
}

TEST_F(Import, AcceptsAnArmOfSubgroupsAndItsState) {
  const fs::path srdf = file("whole.srdf", R"(<robot name="torso_robot">
    <group name="lo"><joint name="left_1"/><joint name="left_2"/></group>
    <group name="hi"><joint name="left_3"/></group>
    <group name="manip"><group name="lo"/><group name="hi"/></group>
    <group_state name="ready" group="manip"><joint name="left_1" value="0.1"/>
      <joint name="left_2" value="-0.6"/><joint name="left_3" value="0.5"/></group_state></robot>)");
  const test::Outcome made =
      run("import --urdf " + file("torso.urdf", test::torso_urdf()).string() + " --srdf " +
          srdf.string());
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const json arms = parse_json(made.out, JsonComments::allowed).value()["robots"][0]["arms"];
  ASSERT_EQ(arms.size(), 1U);
  EXPECT_EQ(arms[0]["group"], "manip");
  EXPECT_EQ(arms[0]["home"], "ready");
}

TEST_F(Import, WritesACellThatDoesNotLoadAndExitsWithTwo) {
  // Both bases are at the same place, so no homes are collision-free.
  const test::Outcome made = run("import" + files("panda") + " --robot a --robot b");
  EXPECT_EQ(made.exit_code, 2);
  EXPECT_TRUE(parse_json(made.out, JsonComments::allowed));
  EXPECT_THAT(made.err, HasSubstr("No homes were found at which all arms keep their clearance"));
  EXPECT_THAT(made.err, HasSubstr("apart at home"));
}

TEST_F(Import, NamesTheInvalidOption) {
  const fs::path no_arm = file("no_arm.srdf", "<robot name='panda'/>");
  const std::string panda = (test::kSource / "models/panda.urdf").string();
  const fs::path meshed =
      file("meshed.urdf", R"(<robot name="m"><link name="l"><collision><geometry>
      <mesh filename="package://far_away/l.stl"/></geometry></collision></link></robot>)");
  const struct {
    std::string arguments;
    std::string says;
  } cases[] = {
      {files("panda") + " --srdf x.srdf",
       "--srdf: 1 --urdf but 2 --srdf: give one --srdf for each --urdf"},
      {files("panda") + files("ur5e") + " --robot a", "--urdf: there are 2 and 1 --robot"},
      {files("panda") + " --joint-limits a --joint-limits b", "--joint-limits: 1 --urdf but 2"},
      {files("panda") + " --robot a:yaw=3", "--robot: in \"a:yaw=3\": \"yaw\" is not known"},
      {files("panda") + " --robot a --robot b --prefix c_", "--prefix: several robots"},
      {files("panda") + " --package x", "--package: in \"x\": expected NAME=FOLDER"},
      {files("panda") + " --package x=/nowhere", "no such folder"},
      {" --urdf /nowhere.urdf --srdf /nowhere.srdf", "/nowhere.srdf"},
      {" --urdf " + panda + " --srdf " + no_arm.string(), "no group is an arm"},
      {" --urdf " + meshed.string() + " --srdf " + no_arm.string(), "--package far_away=FOLDER"},
      {files("panda") + " --out /nowhere/cell.json", "--out: /nowhere/cell.json cannot be written"},
  };
  for (const auto& bad : cases) {
    const test::Outcome outcome = run("import" + bad.arguments);
    EXPECT_EQ(outcome.exit_code, 2) << bad.arguments;
    EXPECT_THAT(outcome.err, HasSubstr(bad.says)) << bad.arguments;
  }
  EXPECT_EQ(run("import --urdf " + panda).exit_code, 2);
}

TEST_F(Import, ReportsAnSrdfOfAnotherRobot) {
  const std::string models = (test::kSource / "models").string();
  const test::Outcome outcome =
      run("import --urdf " + models + "/panda.urdf --srdf " + models + "/ur5e.srdf");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("no group of it is an arm"),
                    HasSubstr("the SRDF is for robot ur5e, but panda.urdf for robot panda"),
                    HasSubstr("is not in panda.urdf; it is left out of the group")));
}

TEST_F(Import, SchemaCommandPrintsTheFilesInConfig) {
  const test::Outcome schema = run("schema");
  EXPECT_EQ(schema.exit_code, 0);
  EXPECT_EQ(schema.out, read_text_file(test::kSource / "config/cell.schema.json").value());
  EXPECT_EQ(run("schema --markdown").out,
            read_text_file(test::kSource / "config/README.md").value());
}

}  // namespace
}  // namespace armloom
