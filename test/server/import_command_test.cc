#include <gmock/gmock.h>

#include <fstream>
#include <regex>

#include "server/codec/json_text.h"
#include "test/server/close_wrists.h"
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
  EXPECT_THAT(made.err,
              HasSubstr("Groups of the SRDF that are not used as arms: hand, because it is "
                        "an end effector."));
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

// Another home or another base would not help. Each of the two remedies in the messages does.
TEST_F(Import, NamesOwnLinksThatAreTooCloseInEveryPose) {
  const std::string urdf = " --urdf " + file("twin.urdf", test::close_wrists_urdf()).string();
  const std::string close =
      urdf + " --srdf " + file("twin.srdf", test::close_wrists_srdf()).string();
  const fs::path cell = folder_ / "cell.json";
  const test::Outcome made = run("import" + close + " --out " + cell.string());
  EXPECT_EQ(made.exit_code, 2);
  EXPECT_THAT(made.err, AllOf(HasSubstr("neither other homes nor other bases help: link_5_l and "
                                        "link_7_l, link_5_r and link_7_r."),
                              Not(HasSubstr("move the bases"))));
  EXPECT_EQ(written("cell.json")["robots"][0]["arms"][0]["home"], "home");  // of both_arms
  EXPECT_EQ(written("cell.json")["robots"][0]["arms"][1]["home"], "home");

  std::smatch lower;
  ASSERT_TRUE(
      std::regex_search(made.err, lower, std::regex(R"re("self_clearance_m" to ([0-9.]+))re")))
      << made.err;
  json lowered = written("cell.json");
  lowered["self_clearance_m"] = std::stod(lower[1]);
  EXPECT_EQ(run("validate --cell " + file("lowered.json", lowered.dump()).string()).exit_code, 0);

  // Two such robots share the SRDF, so its lines have no prefix.
  const std::string two = " --robot a:x=-2 --robot b:x=2";
  const test::Outcome both = run("import" + close + two);
  EXPECT_EQ(both.exit_code, 2);
  const std::regex element("<disable_collisions [^>]*/>");
  std::set<std::string> elements;
  for (auto it = std::sregex_iterator(both.err.begin(), both.err.end(), element);
       it != std::sregex_iterator(); ++it)
    elements.insert(it->str());
  std::string lines;
  for (const std::string& one : elements) lines += one;
  const fs::path mended = file("mended.srdf", test::close_wrists_srdf(lines));
  EXPECT_EQ(run("import" + urdf + " --srdf " + mended.string() + two).exit_code, 0) << lines;
}

TEST_F(Import, FindsMeshesAtAddressesOfAnotherMachine) {
  const fs::path shuttle = test::kSource / "models/shuttle";
  const std::string text = read_text_file(shuttle / "shuttle.urdf").value();
  const std::string srdf = " --srdf " + (shuttle / "shuttle.srdf").string();
  for (const std::string address :
       {"file:///home/other/ws/src/shuttle_description/", "/opt/share/shuttle_description/",
        "package://shuttle_description//", "package://shuttle_description/"}) {
    const std::string urdf =
        std::regex_replace(text, std::regex("package://shuttle_description/"), address);
    const std::string files = "import --urdf " + file("shuttle.urdf", urdf).string() + srdf;
    const test::Outcome refused = run(files);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, AllOf(HasSubstr("--package: 7 meshes of shuttle.urdf in the package "
                                             "shuttle_description (" +
                                             address),
                                   HasSubstr("give --package shuttle_description=FOLDER with the "
                                             "folder that contains meshes/base_link.stl"),
                                   Not(HasSubstr("add to the robot"))));
    EXPECT_EQ(std::ranges::count(refused.err, '\n'), 1) << refused.err;
    const std::string option = " --package shuttle_description=";
    EXPECT_EQ(run(files + option + shuttle.string()).exit_code, 0) << address;
    // The folder above the right one: the message names the right one.
    EXPECT_THAT(run(files + option + shuttle.parent_path().string()).err,
                HasSubstr("/models has none of the 7 meshes"));
    EXPECT_THAT(run(files + option + shuttle.parent_path().string()).err,
                HasSubstr("give --package shuttle_description=" + shuttle.string()));
    EXPECT_THAT(run(files + " --package shuttle=" + shuttle.string()).err,
                HasSubstr("(no mesh needs --package shuttle)"));
  }
}

TEST_F(Import, FindsMeshesBesideTheFolderOfTheUrdf) {
  const fs::path shuttle = test::kSource / "models/shuttle";
  const fs::path package = folder_ / "shuttle_description";
  fs::create_directories(package / "urdf");
  fs::copy(shuttle / "meshes", package / "meshes", fs::copy_options::recursive);
  const std::string text = std::regex_replace(read_text_file(shuttle / "shuttle.urdf").value(),
                                              std::regex("package://shuttle_description/"), "../");
  std::ofstream(package / "urdf/shuttle.urdf") << text;
  const std::string files = "import --urdf " + (package / "urdf/shuttle.urdf").string() +
                            " --srdf " + (shuttle / "shuttle.srdf").string();
  const test::Outcome made = run(files);
  EXPECT_EQ(made.exit_code, 0) << made.err;
}

TEST_F(Import, AppliesThePrefixThatTheMessageNames) {
  std::string urdf = read_text_file(test::kSource / "models/ur5e.urdf").value();
  urdf = std::regex_replace(
      urdf, std::regex(R"re((<link name="|<joint name="|<parent link="|<child link="))re"),
      "$1ur_");
  const std::string arguments =
      "import --urdf " + file("ur.urdf", urdf).string() + " --srdf " +
      (test::kSource / "models/ur5e.srdf").string() + " --joint-limits " +
      file("joint_limits.yaml", "joint_limits: {elbow_joint: {max_velocity: 0.5}}").string() +
      " --robot a:x=-1 --robot b:x=1 --out " + (folder_ / "cell.json").string();
  const test::Outcome refused = run(arguments);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("exist in ur.urdf with ur_ before them"));
  EXPECT_THAT(refused.err, HasSubstr("(armloom import: --srdf-prefix ur_)"));
  const test::Outcome made = run(arguments + " --srdf-prefix ur_ --joint-limits-prefix ur_");
  EXPECT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(made.err, "");
  const json robot = written("cell.json")["robots"][1];
  EXPECT_EQ(robot["srdf_prefix"], "ur_");
  EXPECT_EQ(robot["joint_limits_prefix"], "ur_");
  EXPECT_THAT(run("validate --cell " + (folder_ / "cell.json").string()).out,
              HasSubstr("b_ur_elbow_joint"));
}

TEST_F(Import, WritesACellThatDoesNotLoadAndExitsWithTwo) {
  // Both bases are at the same place, so no homes are collision-free.
  const test::Outcome made = run("import" + files("panda") + " --robot a --robot b");
  EXPECT_EQ(made.exit_code, 2);
  EXPECT_TRUE(parse_json(made.out, JsonComments::allowed));
  EXPECT_THAT(made.err,
              AllOf(HasSubstr("No homes were found at which all arms keep their clearances"),
                    HasSubstr("are closer than their clearance (0.02 m) at "),
                    HasSubstr("move the bases apart")));
  EXPECT_THAT(made.err, HasSubstr(": overlap by "));
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
      {files("panda") + files("ur5e") + " --robot a", "--urdf: 2 --urdf but 1 --robot"},
      {files("panda") + " --joint-limits a --joint-limits b", "--joint-limits: 1 --urdf but 2"},
      {files("panda") + " --robot a:yaw=3", "--robot: in \"a:yaw=3\": \"yaw\" is an unknown key"},
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
              AllOf(HasSubstr("no group is an arm"),
                    HasSubstr("the SRDF is for robot ur5e, but panda.urdf for robot panda"),
                    HasSubstr("is not in panda.urdf")));
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
