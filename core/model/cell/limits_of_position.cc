#include <algorithm>
#include <limits>

#include "core/model/cell/limits_of_joint.h"

namespace armloom {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

void LimitsOfJoint::settle_positions() {
  const bool endless = joint_.kind == JointKind::continuous;
  UrdfLimits& urdf = link_.joint.limits;
  if (!endless && urdf.faults.count() == 0 && urdf.lower.has_value() != urdf.upper.has_value())
    take_zero_for_the_other(urdf);
  const auto lower = from_cell(cell_.lower, key("lower", "_rad", "_m"), urdf.lower,
                               urdf.lower && cell_.lower && *cell_.lower < *urdf.lower);
  const auto upper = from_cell(cell_.upper, key("upper", "_rad", "_m"), urdf.upper,
                               urdf.upper && cell_.upper && *cell_.upper > *urdf.upper);
  const auto lowest = lower
                          ? lower
                          : from_file(file_.lower, "min_position", urdf.lower,
                                      urdf.lower && file_.lower ? *urdf.lower - *file_.lower : 0.0);
  const auto highest =
      upper ? upper
            : from_file(file_.upper, "max_position", urdf.upper,
                        urdf.upper && file_.upper ? *file_.upper - *urdf.upper : 0.0);
  joint_.lower = std::max(lowest.value_or(endless ? -kInfinity : 0.0), -kFarthestPosition);
  joint_.upper = std::min(highest.value_or(endless ? kInfinity : 0.0), kFarthestPosition);
  if (lowest && highest && joint_.lower > joint_.upper) {
    refuse_crossed();
    say_nothing_more();
  } else if (!endless && !(lowest && highest)) {
    joint_.lower = joint_.upper = lowest.value_or(highest.value_or(0.0));
    need_positions(!lowest, !highest);
    if (own_) say_nothing_more();
  }
}

void LimitsOfJoint::take_zero_for_the_other(UrdfLimits& urdf) {
  const bool lower = !urdf.lower;
  if (urdf.lower.value_or(0.0) > urdf.upper.value_or(0.0)) return;  // empty range: reported later
  (lower ? urdf.lower : urdf.upper) = 0.0;
  if (arm_ == nullptr) return;
  warn("missing", place_in_urdf(),
       lower ? "limit lower is missing; 0 is used, as the URDF specification says"
             : "limit upper is missing; 0 is used, as the URDF specification says",
       0.0);
}

// Removes the limits after their fault was reported. Otherwise homes and states outside of them
// would be reported too.
void LimitsOfJoint::say_nothing_more() {
  joint_.lower = -kInfinity;
  joint_.upper = kInfinity;
}

void LimitsOfJoint::refuse_crossed() {
  const std::string sentence = "joint " + link_.joint.name + ": the limits leave no range: lower " +
                               text_of(joint_.lower) + " is above upper " + text_of(joint_.upper);
  if (cell_.lower || cell_.upper)
    return diagnostics_.in_cell("limits-crossed", pointer_, sentence, joint_.lower);
  if (arm_ != nullptr)
    diagnostics_.add(
        {ProblemKind::invalid, "limits-crossed", place_, place_ + ": " + sentence, joint_.lower});
}

void LimitsOfJoint::need_positions(bool lower, bool upper) {
  if (arm_ == nullptr || robot_.limits_unread()) return;
  std::string members;
  if (lower) append_item(members, ", ", json_member(key("lower", "_rad", "_m"), "-1"));
  if (upper) append_item(members, ", ", json_member(key("upper", "_rad", "_m"), "1"));
  if (own_) return need("position", members);
  warn("missing", place_in_urdf(),
       "no position limits; this gripper joint stays at " + text_of(joint_.lower) +
           ". To set them, add to arm " + arm_->description->name + " \"limits\": {\"" +
           link_.joint.name + "\": {" + members + "}}",
       joint_.lower);
}

}  // namespace armloom
