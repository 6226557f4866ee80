#pragma once

#include <optional>
#include <string>

#include "core/model/cell/robot_build.h"

namespace armloom {

// What an arm's joint needs and no file gives, as members of the cell file's "limits".
struct Needs {
  std::string names;    // "velocity of j1, position of j2"
  std::string members;  // "\"j1\": {\"velocity_rad_s\": 1}"
  bool faulty = false;  // the URDF gives some of them, with faults that are told
};

void append_item(std::string& list, const char* separator, const std::string& item);
[[nodiscard]] std::string json_member(const std::string& key, const std::string& value);

// Settles the limits of one joint. Whose joint it is decides what has to be known of it: an arm's
// own joint needs all; a gripper's joint takes defaults, with a warning; what no arm moves needs
// nothing.
class LimitsOfJoint {
 public:
  struct OwnerOfJoint {
    const ArmBuild* arm;  // none: no arm moves the joint
    bool own;             // of the arm's group, not of its gripper
  };
  LimitsOfJoint(const RobotBuild& robot, TreeLink& link, Joint& joint, OwnerOfJoint owner,
                Diagnostics& diagnostics);

  void settle(LimitsFile::Joint* filed, Needs& needs);

 private:
  [[nodiscard]] std::string key(const char* what, const char* angular, const char* linear) const;

  void warn(const std::string& slug, const std::string& place, const std::string& sentence,
            double value);

  void need(const std::string& word, const std::string& members);

  // The cell's number if it can be one and is no wider than the URDF's; `wider` compares with that.
  std::optional<double> from_cell(const std::optional<double>& value, const std::string& name,
                                  const std::optional<double>& urdf, bool wider);

  // Keys in the cell whose unit is of joints that move otherwise.
  void check_units();

  void refuse(const char* slug, const std::string& name, const std::string& rest, double value);

  // The number of joint_limits.yaml, or the URDF's where that is narrower.
  std::optional<double> from_file(const std::optional<double>& value, const char* name,
                                  const std::optional<double>& urdf, double wider_by);

  // limits_of_position.cc
  void settle_positions();

  // As the URDF specification has it, and MoveIt.
  void take_zero_for_the_other(UrdfLimits& urdf);

  void refuse_crossed();

  void say_nothing_more();

  void need_positions(bool lower, bool upper);

  void settle_velocity();

  void settle_rate(const std::optional<double>& cell, const std::optional<double>& file,
                   const std::string& name, double& limit, bool& assumed);

  void settle_rates();

  // Limits of an arm's joint that are hardly meant, as degrees and millimetres are.
  void warn_of_units();

  [[nodiscard]] std::string place_in_urdf() const;

  const RobotBuild& robot_;
  TreeLink& link_;
  Joint& joint_;
  const ArmBuild* arm_;  // as of its OwnerOfJoint
  bool own_;
  Diagnostics& diagnostics_;
  JointLimitsDescription cell_;
  JointLimitsDescription file_;
  std::string pointer_;  // of the joint's limits in the cell file
  std::string place_;    // of them in joint_limits.yaml
  std::string words_;
  std::string missing_;
};

}  // namespace armloom
