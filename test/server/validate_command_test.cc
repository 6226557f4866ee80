#include <gmock/gmock.h>

#include <regex>
#include <sstream>

#include "test/server/close_wrists.h"
#include "test/server/command_fixture.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::kCell;
using test::Outcome;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class ValidateCommand : public test::CommandFixture {};

TEST_F(ValidateCommand, PrintsTheContentsOfACell) {
  const Outcome outcome = run("validate --cell " + kCell);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("left_panda_joint4"), std::string::npos);
  EXPECT_NE(outcome.out.find("home clearance"), std::string::npos);
  EXPECT_NE(outcome.out.find("\ntable   "), std::string::npos) << "among the shapes";
  EXPECT_EQ(outcome.err, "");
}

TEST_F(ValidateCommand, PrintsTheEndpointOfARemoteRobot) {
  const fs::path cell =
      changed_cell("/robots/1/controller", {{"type", "remote"}, {"endpoint", "tcp:10.0.0.7:4000"}});
  const Outcome outcome = run("validate --cell " + cell.string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("; controller sim, lag"));
  EXPECT_THAT(outcome.out,
              HasSubstr("; controller remote at tcp:10.0.0.7:4000; when simulated: lag 0"));
}

TEST_F(ValidateCommand, PrintsMassesAndWhatArmsMayHold) {
  const fs::path strong =
      changed_cell("/robots/0/arms/0/payload", {{"max_kg", 3}, {"brake_at_max", 0.5}});
  json cell = json::parse(read_text_file(strong).value());
  for (const auto& [name, kg] : {std::pair("light", 2.5), {"heavy", 4.0}}) {
    cell["objects"].push_back({{"name", name},
                               {"box", {0.1, 0.1, 0.1}},
                               {"xyz", {0, 0, 3}},
                               {"rpy", {0, 0, 0}},
                               {"mass_kg", kg}});
  }
  const Outcome outcome = run("validate --cell " + file("masses.json", cell.dump()).string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("    holds at most 3 kg, and then keeps 50 % of its brake\n"));
  EXPECT_THAT(outcome.out, HasSubstr("object light: box at 0, 0, 3, 2.5 kg\n"));
  EXPECT_THAT(outcome.out,
              HasSubstr("object heavy: box at 0, 0, 3, 4 kg: no arm may hold it (payload)\n"));
}

json modbus(const std::string& device, const std::string& table, int address) {
  return {{"device", device}, {"table", table}, {"address", address}};
}

TEST_F(ValidateCommand, PrintsInputsAndOutputs) {
  const json plc = {{"name", "plc"}, {"endpoint", "tcp:10.0.0.5:502"}, {"unit", 3}};
  const json level = {
      {"name", "level"}, {"direction", "input"}, {"modbus", modbus("plc", "input_register", 10)}};
  const json valve = {{"name", "valve"},
                      {"direction", "output"},
                      {"fail_state", false},
                      {"modbus", modbus("plc", "coil", 0)}};
  const json lamp = {
      {"name", "lamp"}, {"direction", "output"}, {"modbus", modbus("plc", "coil", 7)}};
  const json lane = {{"name", "lane"}, {"direction", "input"}, {"initial", true}};
  const fs::path cell =
      changed_cell("/io", {{"devices", {plc}}, {"signals", {level, lane, valve, lamp}}});
  const Outcome outcome = run("validate --cell " + cell.string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              HasSubstr("I/O device plc: Modbus at tcp:10.0.0.5:502, unit 3, read every 0.02 s, "
                        "lost after 0.5 s without an answer\n"
                        "  input level (integer): input_register 10\n"
                        "  output valve (bool): coil 0, fail state false\n"
                        "  output lamp (bool): coil 7, no fail state: the server never writes it "
                        "by itself\n"
                        "simulated signals\n"
                        "  input lane (bool): true at the start\n"));
}

TEST_F(ValidateCommand, RefusesTwoDevicesWithOneEndpointAndUnit) {
  const auto device = [](const char* name, int unit) {
    return json{{"name", name}, {"endpoint", "tcp:10.0.0.5:502"}, {"unit", unit}};
  };
  const auto validated = [&](int unit) {
    const json devices = {device("a", 1), device("b", unit)};
    return run("validate --cell " + changed_cell("/io", {{"devices", devices}}).string());
  };
  EXPECT_EQ(validated(2).exit_code, 0) << "two units behind one gateway";
  const Outcome same = validated(1);
  EXPECT_EQ(same.exit_code, 2);
  EXPECT_THAT(same.err, HasSubstr("/io/devices/1/endpoint"));
  EXPECT_THAT(same.err,
              HasSubstr("I/O device b has the same endpoint and unit (1) as I/O device a: "
                        "list its signals there, or correct the endpoint or unit"));
  EXPECT_THAT(same.err, HasSubstr("tcp:10.0.0.5:502"));
}

TEST_F(ValidateCommand, PrintsWhatEachPromiseCosts) {
  const fs::path cell = changed_cell("/robots/0/controller",
                                     {{"tracking_error_rad", 0.01}, {"feedback_timeout_s", 1}});
  const Outcome outcome = run("validate --cell " + cell.string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("tracking error 0.01 rad (m): adds "), std::string::npos);
  EXPECT_NE(outcome.out.find("tracking error 0.001 rad"), std::string::npos) << "the other robot";
  EXPECT_NE(outcome.out.find("lost after 1 s: the authority reaches 1.121 s (at planned speed) "
                             "beyond the stopping point"),
            std::string::npos);
  EXPECT_NE(outcome.out.find("lost after 0.1 s: the authority reaches 0.27 s (at planned speed)"),
            std::string::npos);
}

// The longest way of a point at full speed: velocity x reaction; with braking, velocity x (reaction
// + velocity / (2 x brake)).
TEST_F(ValidateCommand, SeparatesTheCostsOfReactionAndBraking) {
  const auto costs_mm = [&](double reaction_s) {
    const fs::path cell = changed_cell("/robots/0/controller", {{"reaction_s", reaction_s}});
    const Outcome outcome = run("validate --cell " + cell.string());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string text = outcome.out.substr(outcome.out.find("  reaction "));
    const auto number_after = [&](const std::string& words) {
      const std::size_t at = text.find(words);
      EXPECT_NE(at, std::string::npos) << text;
      return std::stod(text.substr(at + words.size()));
    };
    const double before = number_after("farthest point moves ");
    EXPECT_LT(text.find(" before the arm brakes; with braking, it stops after "), text.find('\n'));
    const std::string total = text.substr(text.find("it stops after "));
    return std::pair(before, std::stod(total.substr(total.find(" and ") + 5)));
  };
  const auto [short_mm, short_total_mm] = costs_mm(0.02);
  const auto [long_mm, long_total_mm] = costs_mm(0.1);
  EXPECT_NEAR(long_mm, 5.0 * short_mm, 1.0);
  EXPECT_NEAR(long_total_mm - short_total_mm, long_mm - short_mm, 1.0);
  EXPECT_GT(short_total_mm, short_mm);
}

TEST_F(ValidateCommand, MarksDefaultLimits) {
  const fs::path cell =
      changed_cell("/robots/0/arms/0/limits",
                   {{"panda_joint1", {{"acceleration_rad_s2", 5}, {"jerk_rad_s3", 900}}}});
  const Outcome outcome = run("validate --cell " + cell.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto limits = [&](const std::string& joint) {  // joined by single spaces
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

TEST_F(ValidateCommand, PrintsHazardsFirstAndOneLineForEachKind) {
  std::string urdf = test::close_wrists_urdf();
  urdf = std::regex_replace(urdf, std::regex("</link>"), "<gravity/></link>");  // six links
  const std::string camera =
      R"(<link name="camera"><visual/></link><joint name="mount" type="fixed">
    <parent link="body"/><child link="camera"/></joint></robot>)";
  urdf.replace(urdf.find("</robot>"), 8, camera);
  (void)file("twin.urdf", urdf);
  (void)file("twin.srdf", test::close_wrists_srdf());
  const json cell = {{"name", "twin"},
                     {"self_clearance_m", 0.001},
                     {"robots",
                      {{{"name", "twin"},
                        {"urdf", "twin.urdf"},
                        {"srdf", "twin.srdf"},
                        {"arms", {{{"name", "left"}, {"group", "left_arm"}}}},
                        {"fixed", {{"joint_5_r", 0}, {"joint_6_r", 0}, {"joint_7_r", 0}}}}}}};
  const std::string arguments = "validate --cell " + file("cell.json", cell.dump()).string();
  const Outcome brief = run(arguments);
  EXPECT_EQ(brief.exit_code, 0) << brief.err;
  EXPECT_THAT(brief.err, StartsWith("armloom: warning: hazard: twin.urdf: links: camera"));
  EXPECT_THAT(brief.err,
              HasSubstr("armloom: warning: twin.urdf:1: link link_5_l: <gravity> is not known here "
                        "and is left out [and 5 more of this kind; validate and import print them "
                        "with --verbose]\n"));
  EXPECT_THAT(brief.err, Not(HasSubstr("link link_6_l")));
  const Outcome all = run(arguments + " --verbose");
  EXPECT_THAT(all.err, StartsWith("armloom: warning: hazard: twin.urdf: links: camera"));
  for (const std::string link : {"link_5_l", "link_6_l", "link_7_l", "link_7_r"})
    EXPECT_THAT(all.err, HasSubstr(": link " + link + ": <gravity> is not known here"));
  EXPECT_THAT(all.err, Not(HasSubstr("more of this kind")));
}

TEST_F(ValidateCommand, WarnsIfABrakeIsWeakerThanTheAcceleration) {
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
                "0.5, less than its acceleration_m_s2 of 3.75: the joint takes longer to stop than "
                "to reach its speed; check the value\narmloom: warning: " +
                limits +
                "panda_joint1/brake_rad_s2: joint right_panda_joint1: brake_rad_s2 is 1.5, less "
                "than its acceleration_rad_s2 of 3.75: the joint takes longer to stop than to "
                "reach its speed; check the value\n");
}

TEST_F(ValidateCommand, NeverPrintsMinusZero) {
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

TEST_F(ValidateCommand, ReportsBadCellsWithPlaceAndValue) {
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
      {"/robots/1/base/xyz", {-0.3, 0, 0.1}, "/home"},  // inside the other robot
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

}  // namespace
}  // namespace armloom
