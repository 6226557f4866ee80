#include "server/messages/plan_goal.h"

#include <map>
#include <optional>
#include <utility>

#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/read_text.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/scene_format.h"
#include "server/codec/value_formats.h"

namespace armloom {

using namespace formats;

namespace {

// The member "joints": a list for the arm's joints, or gripper joints by name.
class JointsFormat final : public CustomFormat<PlanGoal> {
 public:
  void read(const JsonNode& node, PlanGoal& goal) const override {
    if (!node.raw().is_object()) {
      goal.joints.emplace();
      return list_->read(node, *goal.joints);
    }
    by_name_->read(node, goal.gripper);
    if (node.raw().empty()) node.invalid("empty", "name at least one gripper joint");
  }
  void write(JsonWriter& out, const PlanGoal& goal) const override {
    goal.joints ? list_->write(out, *goal.joints) : by_name_->write(out, goal.gripper);
  }
  Schema schema(Way way) const override {
    Schema by_name = by_name_->schema(way);
    by_name["minProperties"] = 1;
    return {{"oneOf", Schema::array({list_->schema(way), by_name})}};
  }

 private:
  FormatPtr<std::vector<double>> list_ = number_list();
  FormatPtr<std::map<std::string, double>> by_name_ = dictionary(number(kAnyNumber));
};

PartPtr<PlanGoal> joints_part() {
  return member<PlanGoal>(
      {"joints",
       "Joint positions in the order of the arm's group: rad or m. Or positions of gripper joints "
       "by name, in a job: the arm stays",
       Need::optional,
       {}},
      make_format<JointsFormat>(),
      [](const PlanGoal& goal) {
        return goal.joints || !goal.gripper.empty() ? std::optional(goal) : std::nullopt;
      },
      [](PlanGoal& goal, PlanGoal read) {
        goal.joints = std::move(read.joints);
        goal.gripper = std::move(read.gripper);
      });
}

}  // namespace

FormatPtr<PlanGoal> plan_goal_format() {
  static const FormatPtr<PlanPose> pose = object<PlanPose>({
      field("link", &PlanPose::link, name(),
            "Link with prefix; default: the link of the arm's last joint"),
      inlined(&PlanPose::X_WL, pose_part(Need::required)),
  });
  static const FormatPtr<PlanGoal> format =
      named("Goal", "Goal of an arm.",
            object<PlanGoal>({
                joints_part(),
                field("named", &PlanGoal::named, name(),
                      "Named state of the SRDF, or `home`. In a job also a state of the gripper: "
                      "the arm stays"),
                field("pose", &PlanGoal::pose, pose, "Pose of a link in the world"),
                exactly_one<PlanGoal>({"joints", "named", "pose"}),
                only_with("pose", &PlanGoal::pose,
                          field("cartesian", &PlanGoal::cartesian, flag(),
                                "With `pose`: the link moves in a straight line in the world and "
                                "rotates uniformly, within 1 mm and 0.01 rad at every instant")),
            }));
  return format;
}

Result<PlanGoal> read_plan_goal(const std::string& text) {
  if (text.starts_with('[')) return read_text(*plan_goal_format(), "{\"joints\":" + text + "}");
  if (text.starts_with('{')) return read_text(*plan_goal_format(), text);
  return PlanGoal{.joints = {}, .named = text, .pose = {}};
}

}  // namespace armloom
