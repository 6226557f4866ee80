#pragma once

#include <string>
#include <vector>

#include "core/model/cell.h"
#include "server/codec/format.h"

namespace armloom {

// The answer to GET /cell and its parts, with names instead of ids. Meshes are given by their path
// on this server, under the name that the URDF uses.
struct CellArmView {
  const Arm* arm;
  std::vector<std::string> joints;
  std::vector<std::string> gripper_joints;
};
struct CellRobotView {
  const Robot* robot;
  double tracking_error_rad;  // Cell::tracking_error()
  std::vector<CellArmView> arms;
};
struct CellJointView {
  const Joint* joint;
  std::string arm;  // empty if no arm has the joint
};
struct CellView {
  const Cell* cell;
  std::string policy;  // present policy
  double speed;        // present speed
  std::vector<CellRobotView> robots;
  std::vector<CellJointView> joints;
  CellDescription settings;  // only the settings are filled in
};

struct PolicyChoice {
  std::string policy;
};
[[nodiscard]] FormatPtr<PolicyChoice> policy_choice_format();

[[nodiscard]] CellDescription settings_of(const Cell& cell);
// `cell` must outlive the view.
[[nodiscard]] CellView view_of(const Cell& cell, std::string policy, double speed);
[[nodiscard]] FormatPtr<CellView> cell_view_format();

}  // namespace armloom
