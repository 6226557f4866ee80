// `armloom import` as a shell calls it: one command makes a cell that runs.
#include <gmock/gmock.h>

#include <fstream>

#include "server/codec/json_text.h"
#include "test/server/command_fixture.h"

namespace armloom {
namespace {

using nlohmann::json;
using testing::HasSubstr;
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

TEST_F(Import, MakesACellOfTwoRobotsOfOneUrdf) {
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
  EXPECT_THAT(made.err, HasSubstr("The group hand is no arm here: it is an end effector."));
  EXPECT_EQ(file["clearance_m"], 0.02);
  EXPECT_EQ(file["execution"]["duration_scaling"], 1.1);
  const std::string text = read_text_file(cell).value();
  EXPECT_THAT(text, HasSubstr("// The watch over the measured state of all arms."));
  EXPECT_EQ(run("validate --cell " + cell.string()).exit_code, 0);
  EXPECT_EQ(run("import" + files("panda") + " --out " + cell.string()).exit_code, 2);
  EXPECT_EQ(read_text_file(cell).value(), text);  // never over a file
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

TEST_F(Import, TakesRobotsOfDifferentKinds) {
  const test::Outcome made =
      run("import" + files("panda") + files("ur5e") + " --robot a:x=-1 --robot b:x=1");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const json file = parse_json(made.out, JsonComments::allowed).value();
  EXPECT_THAT(file["robots"][1]["urdf"].get<std::string>(), HasSubstr("ur5e.urdf"));
  EXPECT_EQ(file["robots"][1]["prefix"], "b_");
}

TEST_F(Import, WritesWhatDoesNotLoadAndEndsWithTwo) {
  // Bases in one place: no homes are free.
  const test::Outcome made = run("import" + files("panda") + " --robot a --robot b");
  EXPECT_EQ(made.exit_code, 2);
  EXPECT_TRUE(parse_json(made.out, JsonComments::allowed));
  EXPECT_THAT(made.err, HasSubstr("No homes were found in which all arms stand free"));
  EXPECT_THAT(made.err, HasSubstr("apart at home"));
}

TEST_F(Import, NamesTheOptionThatIsWrong) {
  const fs::path no_arm = file("no_arm.srdf", "<robot name='panda'/>");
  const std::string panda = (test::kSource / "models/panda.urdf").string();
  const fs::path meshed =
      file("meshed.urdf", R"(<robot name="m"><link name="l"><collision><geometry>
      <mesh filename="package://far_away/l.stl"/></geometry></collision></link></robot>)");
  const struct {
    std::string arguments;
    std::string says;
  } cases[] = {
      {files("panda") + " --srdf x.srdf", "--srdf: there are 1 --urdf and 2 --srdf"},
      {files("panda") + files("ur5e") + " --robot a", "--urdf: there are 2 and 1 --robot"},
      {files("panda") + " --joint-limits a --joint-limits b", "--joint-limits: there are 1 --urdf"},
      {files("panda") + " --robot a:yaw=3", "--robot: in \"a:yaw=3\": \"yaw\" is not known"},
      {files("panda") + " --robot a --robot b --prefix c_", "--prefix: several robots"},
      {files("panda") + " --package x", "--package: in \"x\": expected NAME=FOLDER"},
      {files("panda") + " --package x=/nowhere", "there is no such folder"},
      {" --urdf /nowhere.urdf --srdf /nowhere.srdf", "/nowhere.srdf"},
      {" --urdf " + panda + " --srdf " + no_arm.string(), "no group of it is an arm"},
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

TEST_F(Import, ItsSchemaIsPrinted) {
  const test::Outcome schema = run("schema");
  EXPECT_EQ(schema.exit_code, 0);
  EXPECT_EQ(schema.out, read_text_file(test::kSource / "config/cell.schema.json").value());
  EXPECT_EQ(run("schema --markdown").out,
            read_text_file(test::kSource / "config/README.md").value());
}

}  // namespace
}  // namespace armloom
