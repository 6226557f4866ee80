#include "core/model/cell/limits_of_joint.h"

#include <algorithm>
#include <cmath>

namespace armloom {
namespace {

// If a limit exceeds the URDF's by less than this share, it was probably only rounded. The URDF's
// limit then applies without a warning.
constexpr double kRounding = 1e-3;

// Larger limits are probably unit errors (degrees, millimeters).
constexpr double kFarthestTurn_rad = 20.0;
constexpr double kFarthestSlide_m = 20.0;
constexpr double kFastestTurn_rad_s = 30.0;
constexpr double kFastestSlide_m_s = 20.0;
constexpr double kStrongest = 100.0;  // rad/s^2 or m/s^2

}  // namespace

std::string json_member(const std::string& key, const std::string& value) {
  std::string text("\"");
  text += key;
  text += "\": ";
  return text += value;
}

void append_item(std::string& list, const char* separator, const std::string& item) {
  if (!list.empty()) list += separator;
  list += item;
}

LimitsOfJoint::LimitsOfJoint(const RobotBuild& robot, TreeLink& link, Joint& joint,
                             OwnerOfJoint owner, Diagnostics& diagnostics)
    : robot_(robot),
      link_(link),
      joint_(joint),
      arm_(owner.arm),
      own_(owner.own),
      diagnostics_(diagnostics) {
  if (arm_ != nullptr) {
    const auto given = arm_->description->limits.find(link.joint.name);
    if (given != arm_->description->limits.end()) cell_ = given->second;
    pointer_ = arm_->pointer + "/limits/" + pointer_token(link.joint.name);
  }
}

void LimitsOfJoint::settle(LimitsFile::Joint* filed, Needs& needs) {
  if (filed != nullptr) {
    if (arm_ != nullptr)
      diagnostics_.merge(filed->faults);
    else
      diagnostics_.merge_as_warnings(filed->faults);
    file_ = filed->limits;
    place_ = filed->place;
  }
  check_units();
  settle_positions();
  settle_velocity();
  settle_rates();
  warn_of_units();
  // Faults of the URDF's limits are problems only if a needed limit is missing. Otherwise they are
  // warnings.
  if (own_ && !missing_.empty()) {
    needs.faulty = needs.faulty || link_.joint.limits.faults.count() > 0;
    diagnostics_.merge(std::move(link_.joint.limits.faults));
    append_item(needs.names, ", ", words_ + " of " + link_.joint.name);
    append_item(needs.members, ", ", json_member(link_.joint.name, "{" + missing_ + "}"));
  } else {
    diagnostics_.merge_as_warnings(std::move(link_.joint.limits.faults));
  }
}

void LimitsOfJoint::check_units() {
  const bool slides = joint_.kind == JointKind::prismatic;
  for (const std::string& key : cell_.keys) {
    const auto angular = key.find("_rad");
    if ((angular == std::string::npos) == slides) continue;
    std::string right = key;
    if (slides)
      right.replace(angular, 4, "_m");
    else
      right.replace(key.find("_m"), 2, "_rad");
    std::string rest(slides ? " is for rotating joints, but this joint is prismatic"
                            : " is for prismatic joints, but this joint rotates");
    rest += ": give ";
    rest += right;
    diagnostics_.in_cell("wrong-unit", pointer_ + "/" + key,
                         "joint " + link_.joint.name + ": " + key + rest);
  }
}

std::string LimitsOfJoint::key(const char* what, const char* angular, const char* linear) const {
  return std::string(what) + (joint_.kind == JointKind::prismatic ? linear : angular);
}

void LimitsOfJoint::warn(const std::string& slug, const std::string& place,
                         const std::string& sentence, double value) {
  diagnostics_.warn({ProblemKind::invalid, slug, place, place + ": " + sentence, value});
}

void LimitsOfJoint::need(const std::string& word, const std::string& members) {
  append_item(words_, " and ", word);
  append_item(missing_, ", ", members);
}

std::optional<double> LimitsOfJoint::from_cell(const std::optional<double>& value,
                                               const std::string& name,
                                               const std::optional<double>& urdf, bool wider) {
  if (!value) return std::nullopt;
  if (!std::isfinite(*value)) {
    refuse("not-a-number", name, " is " + text_of(*value) + ", it must be finite", *value);
    return std::nullopt;
  }
  if (!urdf || !wider) return value;
  refuse("limit-exceeded", name,
         " is " + text_of(*value) + ", wider than the URDF's " + text_of(*urdf), *value);
  return std::nullopt;
}

void LimitsOfJoint::refuse(const char* slug, const std::string& name, const std::string& rest,
                           double value) {
  diagnostics_.in_cell(slug, pointer_ + "/" + name,
                       "joint " + link_.joint.name + ": " + name + rest, value);
}

std::optional<double> LimitsOfJoint::from_file(const std::optional<double>& value, const char* name,
                                               const std::optional<double>& urdf, double wider_by) {
  if (!value || !urdf || wider_by <= 0.0) return value ? value : urdf;
  if (wider_by > kRounding * std::max(1.0, std::abs(*urdf))) {
    warn("limit-exceeded", place_,
         std::string(name) + " is " + text_of(*value) + ", wider than the URDF's " +
             text_of(*urdf) + "; the URDF's value applies",
         *value);
  }
  return urdf;
}

void LimitsOfJoint::settle_velocity() {
  const auto& urdf = link_.joint.limits.velocity;
  const std::string name = key("velocity", "_rad_s", "_m_s");
  std::optional<double> velocity;
  if (cell_.velocity && *cell_.velocity <= 0.0)
    refuse("not-positive", name, " is " + text_of(*cell_.velocity) + ", it must be greater than 0",
           *cell_.velocity);
  else
    velocity =
        from_cell(cell_.velocity, name, urdf, urdf && cell_.velocity && *cell_.velocity > *urdf);
  if (!velocity)
    velocity = from_file(file_.velocity, "max_velocity", urdf,
                         urdf && file_.velocity ? *file_.velocity - *urdf : 0.0);
  joint_.assumed.velocity = !velocity.has_value();
  joint_.velocity_max = velocity.value_or(kDefaultVelocity);
  if (velocity || arm_ == nullptr || cell_.velocity || robot_.limits_unread()) return;
  const std::string limit = json_member(name, "1");
  if (own_) return need("velocity", limit);
  warn("missing", place_in_urdf(),
       "no velocity limit; assuming 1 " + joint_.unit() +
           "/s for this gripper joint. To set it, add to arm " + arm_->description->name +
           " \"limits\": {\"" + link_.joint.name + "\": {" + limit + "}}",
       kDefaultVelocity);
}

void LimitsOfJoint::settle_rate(const std::optional<double>& cell,
                                const std::optional<double>& file, const std::string& name,
                                double& limit, bool& assumed) {
  assumed = !cell && !file;
  if (assumed) return;
  const double given = cell ? *cell : *file;
  if (std::isfinite(given) && given > 0.0)
    limit = given;
  else
    refuse("not-positive", name, " is " + text_of(given) + ", it must be greater than 0", given);
}

void LimitsOfJoint::settle_rates() {
  settle_rate(cell_.acceleration, file_.acceleration, key("acceleration", "_rad_s2", "_m_s2"),
              joint_.acceleration_max, joint_.assumed.acceleration);
  settle_rate(cell_.jerk, file_.jerk, key("jerk", "_rad_s3", "_m_s3"), joint_.jerk_max,
              joint_.assumed.jerk);
  joint_.brake = 2.0 * joint_.acceleration_max;
  settle_rate(cell_.brake, file_.brake, key("brake", "_rad_s2", "_m_s2"), joint_.brake,
              joint_.assumed.brake);
}

void LimitsOfJoint::warn_of_units() {
  if (arm_ == nullptr) return;
  const bool slides = joint_.kind == JointKind::prismatic;
  const char* meant = slides ? " (millimeters?)" : " (degrees?)";
  const double farthest = slides ? kFarthestSlide_m : kFarthestTurn_rad;
  const double fastest = slides ? kFastestSlide_m_s : kFastestTurn_rad_s;
  const bool endless = joint_.kind == JointKind::continuous;
  const auto beyond = [&](double limit) {
    return std::abs(limit) > farthest && !(endless && std::abs(limit) == kFarthestPosition);
  };
  if (beyond(joint_.lower) || beyond(joint_.upper)) {
    warn("wrong-unit", place_in_urdf(),
         "its limits are " + text_of(joint_.lower) + " to " + text_of(joint_.upper) + " " +
             joint_.unit() + ", probably a unit error" + meant +
             ": jobs that move that far are accepted",
         beyond(joint_.lower) ? joint_.lower : joint_.upper);
  }
  if (joint_.acceleration_max > kStrongest) {
    warn("wrong-unit", place_.empty() ? place_in_urdf() : place_,
         "its acceleration limit is " + text_of(joint_.acceleration_max) + " " + joint_.unit() +
             "/s^2, probably a unit error" + meant +
             ": jobs that accelerate that much are accepted",
         joint_.acceleration_max);
  }
  if (joint_.velocity_max > fastest) {
    warn("wrong-unit", place_in_urdf(),
         "its velocity limit is " + text_of(joint_.velocity_max) + " " + joint_.unit() +
             "/s, probably a unit error" + meant + ": jobs that move that fast are accepted",
         joint_.velocity_max);
  }
}

std::string LimitsOfJoint::place_in_urdf() const { return robot_.tree.place_of_joint(link_); }

}  // namespace armloom
