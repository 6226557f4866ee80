// The SRDF disables all pairs between two arms, as the Setup Assistant does. Admission and audit
// must check the pairs that are not proven out of reach nevertheless.
#include <gmock/gmock.h>

#include "test/model/arm_row.h"
#include "test/server/command_fixture.h"

namespace armloom {
namespace {

using nlohmann::json;
using test::Outcome;
using testing::HasSubstr;

class DisabledPairsCommand : public test::CommandFixture {
 protected:
  void SetUp() override {
    CommandFixture::SetUp();
    (void)file("row.urdf", test::arm_row_urdf(2));
    (void)file("row.srdf", test::arm_row_srdf(2));
  }
  std::string cell(const std::string& name, const json& allowed_collisions) const {
    json arms = json::array();
    for (const char* arm : {"arm0", "arm1"}) {
      arms.push_back({{"name", arm}, {"group", arm}, {"home", {1.5, 0.0}}});
    }
    const json robot = {
        {"name", "row"}, {"urdf", "row.urdf"}, {"srdf", "row.srdf"}, {"arms", arms}};
    const json cell = {{"name", "row"},
                       {"robots", {robot}},
                       {"scheduling", {{"on_idle_blocker", "report"}, {"backlog_timeout_s", 5}}},
                       {"allowed_collisions", allowed_collisions}};
    return file(name, cell.dump()).string();
  }
  // Returns jobs that turn both arms until one lies on the other.
  std::string crossing_jobs() const {
    json jobs = json::array();
    for (const auto& [arm, to] : {std::pair{"arm0", 0.2}, {"arm1", 2.9}}) {
      const std::string name = arm;
      const auto point = [](double turn, double at_s) {
        return json{
            {"positions", {turn, 0.0}}, {"velocities", {0.0, 0.0}}, {"time_from_start", at_s}};
      };
      const json trajectory = {{"joint_names", {name + "_1", name + "_2"}},
                               {"points", {point(1.5, 0.0), point(to, 3.0)}}};
      jobs.push_back({{"at", 0.0}, {"job", {{"id", name}, {"trajectory", trajectory}}}});
    }
    return file("jobs.json", jobs.dump()).string();
  }
};

TEST_F(DisabledPairsCommand, CheckAndAuditStillFindCollisions) {
  const std::string claimed = cell("claimed.json", json::array());
  const std::string jobs = crossing_jobs();
  const Outcome checked = run("check --cell " + claimed + " --jobs " + jobs);
  ASSERT_EQ(checked.exit_code, 0) << checked.err;
  EXPECT_EQ(checked.last_line()["verdict"], "conflict") << checked.out;
  EXPECT_EQ(checked.last_line()["conflicts"][0]["id"], "arm0") << checked.out;

  json all_pairs = json::array();
  for (const char* of_arm0 : {"arm0_1_link", "arm0_2_link"}) {
    for (const char* of_arm1 : {"arm1_1_link", "arm1_2_link"}) {
      all_pairs.push_back(json::array({of_arm0, of_arm1}));
    }
  }
  const std::string recording = (folder_ / "recording").string();
  const Outcome crossed = run("simulate --cell " + cell("allowed.json", all_pairs) + " --jobs " +
                              jobs + " --out " + recording);
  ASSERT_EQ(crossed.exit_code, 0) << crossed.out << crossed.err;
  const Outcome audit = run("audit --cell " + claimed + " --recording " + recording);
  EXPECT_EQ(audit.exit_code, 1) << audit.out << audit.err;
  EXPECT_TRUE(audit.last_line()["contact"].is_object()) << audit.out;
}

TEST_F(DisabledPairsCommand, ValidateReportsProvenAndCheckedPairs) {
  const Outcome outcome =
      run("validate --cell " +
          cell("cell.json", json::array({json::array({"arm0_1_link", "arm1_1_link"})})));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err,
              HasSubstr("cell.json: the SRDF disables 8 pairs of links of different arms, or of an "
                        "arm and its surroundings: 3 proven out of reach and skipped, 1 "
                        "allowed by the cell file, 4 checked nevertheless (arm0_1_link and "
                        "arm1_2_link at row.srdf:3, arm0_2_link and arm1_1_link at row.srdf:4, "
                        "arm0_2_link and arm1_2_link at row.srdf:5, ...); add a pair to the cell's "
                        "\"allowed_collisions\" to skip it, too\n"));
  EXPECT_EQ(outcome.err.find("warning"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace armloom
