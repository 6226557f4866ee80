#pragma once

#include <optional>
#include <string>

#include "core/model/cell/robot_build.h"

namespace armloom {

// Limits that an arm's joints need and that no file gives. `members` is text to add to the cell
// file's "limits".
struct Needs {
  std::string names;    // "velocity of j1, position of j2"
  std::string members;  // "\"j1\": {\"velocity_rad_s\": 1}"
  bool faulty = false;  // the URDF gives them, but with faults that are reported
};

void append_item(std::string& list, const char* separator, const std::string& item);
[[nodiscard]] std::string json_member(const std::string& key, const std::string& value);

// Determines the limits of one joint. For an arm's own joint, some file must give position and
// velocity limits. A gripper joint without limits takes defaults, with a warning. A joint that no
// arm moves needs no limits.
class LimitsOfJoint {
 public:
  struct OwnerOfJoint {
    const ArmBuild* arm;  // nullptr if no arm moves the joint
    bool own;             // true if in the arm's group, false if in its gripper
  };
  LimitsOfJoint(const RobotBuild& robot, TreeLink& link, Joint& joint, OwnerOfJoint owner,
                Diagnostics& diagnostics);

  void settle(LimitsFile::Joint* filed, Needs& needs);

 private:
  [[nodiscard]] std::string key(const char* what, const char* angular, const char* linear) const;

  void warn(const std::string& slug, const std::string& place, const std::string& sentence,
            double value);

  void need(const std::string& word, const std::string& members);

  // Returns the cell file's value. If it is not finite, or if `wider` says that it is wider than
  // the URDF's, reports it and returns nullopt.
  std::optional<double> from_cell(const std::optional<double>& value, const std::string& name,
                                  const std::optional<double>& urdf, bool wider);

  // Reports keys whose unit does not fit the joint.
  void check_units();

  void refuse(const char* slug, const std::string& name, const std::string& rest, double value);

  // Returns the narrower of the values in joint_limits.yaml and the URDF.
  std::optional<double> from_file(const std::optional<double>& value, const char* name,
                                  const std::optional<double>& urdf, double wider_by);

  // limits_of_position.cc
  void settle_positions();

  // If only one position limit is given, sets the other to 0, as the URDF specification and MoveIt
  // do.
  void take_zero_for_the_other(UrdfLimits& urdf);

  void refuse_crossed();

  void say_nothing_more();

  void need_positions(bool lower, bool upper);

  void settle_velocity();

  void settle_rate(const std::optional<double>& cell, const std::optional<double>& file,
                   const std::string& name, double& limit, bool& assumed);

  void settle_rates();

  // Warns of limits that look like degrees or millimeters.
  void warn_of_units();

  [[nodiscard]] std::string place_in_urdf() const;

  const RobotBuild& robot_;
  TreeLink& link_;
  Joint& joint_;
  const ArmBuild* arm_;  // see OwnerOfJoint
  bool own_;
  Diagnostics& diagnostics_;
  JointLimitsDescription cell_;
  JointLimitsDescription file_;
  std::string pointer_;  // in the cell file
  std::string place_;    // in joint_limits.yaml
  std::string words_;
  std::string missing_;
};

}  // namespace armloom
