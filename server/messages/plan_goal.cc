#include "server/messages/plan_goal.h"

#include "server/codec/object_format.h"
#include "server/codec/read_text.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/scene_format.h"
#include "server/codec/value_formats.h"

namespace armloom {

using namespace formats;

FormatPtr<PlanGoal> plan_goal_format() {
  static const FormatPtr<PlanPose> pose = object<PlanPose>({
      field("link", &PlanPose::link, name(),
            "Link with prefix; default: the link of the arm's last joint"),
      inlined(&PlanPose::X_WL, pose_part(Need::required)),
  });
  static const FormatPtr<PlanGoal> format =
      named("Goal", "Goal of an arm.",
            object<PlanGoal>({
                field("joints", &PlanGoal::joints, number_list(),
                      "Joint positions in the order of the arm's group: rad or m"),
                field("named", &PlanGoal::named, name(), "Named state of the SRDF, or `home`"),
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
