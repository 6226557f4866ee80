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
      field("link", &PlanPose::link, name(), "With prefix; absent: that of the arm's last joint"),
      inlined(&PlanPose::X_WL, pose_part(Need::required)),
  });
  static const FormatPtr<PlanGoal> format =
      named("Goal", "Where an arm is to be.",
            object<PlanGoal>({
                field("joints", &PlanGoal::joints, number_list(),
                      "rad or m, in the order of the arm's group"),
                field("named", &PlanGoal::named, name(), "A named state of the SRDF, or home"),
                field("pose", &PlanGoal::pose, pose, "Of a link, in the world"),
                exactly_one<PlanGoal>({"joints", "named", "pose"}),
                only_with("pose", &PlanGoal::pose,
                          field("cartesian", &PlanGoal::cartesian, flag(),
                                "With a pose: the link goes there in a straight line of the world, "
                                "turning evenly, within 1 mm and 0.01 rad at every instant")),
            }));
  return format;
}

Result<PlanGoal> read_plan_goal(const std::string& text) {
  if (text.starts_with('[')) return read_text(*plan_goal_format(), "{\"joints\":" + text + "}");
  if (text.starts_with('{')) return read_text(*plan_goal_format(), text);
  return PlanGoal{.joints = {}, .named = text, .pose = {}};
}

}  // namespace armloom
