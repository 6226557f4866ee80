// Audits a recording of a job that picks and places a part.
#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>

#include "test/server/command_fixture.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::Outcome;
using ::testing::HasSubstr;

class TaskAudit : public test::CommandFixture {
 protected:
  static json move_hand(double y_m, double z_m) {
    return {{"arm", "left"},
            {"move_to",
             {{"pose",
               {{"link", "left_panda_hand"},
                {"xyz", {-0.1, y_m, z_m}},
                {"rpy", {3.14159265, 0, 0.785}}}}}}};
  }
  static json gripper(double width_m) {
    return {{"gripper", {{"arm", "left"}, {"width_m", width_m}}}};
  }
  // Runs the job, and checks that it has succeeded.
  void record() {
    recording_ = folder_ / "recording";
    cell_ =
        changed_cell("/objects/-",
                     {{"name", "part"}, {"box", {0.04, 0.04, 0.08}}, {"xyz", {-0.1, 0.35, 0.141}}})
            .string();
    const json steps = {
        move_hand(0.35, 0.4),
        gripper(0.07),
        move_hand(0.35, 0.25),
        gripper(0.04),
        {{"attach", {{"object", "part"}, {"link", "left_panda_hand"}, {"touch", {"table"}}}}},
        move_hand(0.35, 0.4),
        move_hand(-0.35, 0.4),
        move_hand(-0.35, 0.25),
        {{"detach", {{"object", "part"}, {"touch", {"table"}}}}},
        gripper(0.07),
        move_hand(-0.35, 0.4),
        {{"arm", "left"}, {"move_to", {{"named", "home"}}}}};
    const json jobs = {{{"at", 0}, {"job", {{"id", "pick"}, {"steps", steps}}}}};
    const Outcome outcome =
        run("simulate --cell " + cell_ + " --jobs " + file("jobs.json", jobs.dump()).string() +
            " --out " + recording_.string());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    ASSERT_EQ(outcome.last_line()["jobs"]["succeeded"], 1) << outcome.out;
  }
  Outcome audit() const {
    return run("audit --cell " + cell_ + " --recording " + recording_.string());
  }
  // Replaces events.jsonl: calls change(data) for each `scene` event.
  template <class Change>
  void falsify(Change change) const {
    std::istringstream lines(read_text_file(recording_ / "events.jsonl").value());
    std::ofstream out(recording_ / "events.jsonl", std::ios::binary);
    for (std::string line; std::getline(lines, line);) {
      json event = json::parse(line);
      if (event["type"] == "scene") change(event["data"]);
      out << event.dump() << '\n';
    }
  }

  std::string cell_;
  fs::path recording_;
};

TEST_F(TaskAudit, FollowsWhatTheArmHolds) {
  ASSERT_NO_FATAL_FAILURE(record());
  const Outcome whole = audit();
  EXPECT_EQ(whole.exit_code, 0) << whole.out << whole.err;
  EXPECT_TRUE(whole.last_line()["contact"].is_null());
  EXPECT_THAT(whole.out, HasSubstr("scene events of events.jsonl"));

  const std::string events = read_text_file(recording_ / "events.jsonl").value();
  const auto restore = [&] { std::ofstream(recording_ / "events.jsonl") << events; };
  const auto contact = [&] {
    const Outcome outcome = audit();
    EXPECT_EQ(outcome.exit_code, 1) << outcome.out << outcome.err;
    const json links = outcome.last_line()["contact"]["links"];
    restore();
    return std::pair(links[0].get<std::string>(), links[1].get<std::string>());
  };
  const auto pair = [](const char* a, const char* b) {
    return std::pair<std::string, std::string>(a, b);
  };
  // The part 0.2 m further down: it meets the table when it may touch it no more.
  falsify([](json& scene) {
    for (json& held : scene["held"]) held["object"]["xyz"][2] = 0.35;
  });
  EXPECT_EQ(contact(), pair("table", "part"));
  falsify([](json& scene) { scene.erase("touch"); });
  EXPECT_EQ(contact().second, "part") << "the fingers are at the part before it is attached";
  fs::remove(recording_ / "events.jsonl");
  EXPECT_EQ(contact().second, "part") << "without events, the part stays where it was";

  falsify([](json& scene) {
    for (json& held : scene["held"]) held["link"] = "gripper";
  });
  const Outcome unknown = audit();
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("/data/held/0/link: the cell has no link gripper"));
}

}  // namespace
}  // namespace armloom
