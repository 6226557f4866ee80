#pragma once

#include <string>
#include <vector>

#include "core/model/cell.h"
#include "server/codec/format.h"

namespace armloom {

// The answer to GET /cell: what the dashboard has to know, names instead of ids. URDF and SRDF are
// texts, meshes addresses, by the name that the URDF has for them.
struct CellArmView {
  const Arm* arm;
  std::vector<std::string> joints;
  std::vector<std::string> gripper_joints;
};
struct CellRobotView {
  const Robot* robot;
  std::vector<CellArmView> arms;
};
struct CellJointView {
  const Joint* joint;
  std::string arm;  // empty: of none
};
struct CellView {
  const Cell* cell;
  std::string policy;  // in force
  double speed;        // in force
  std::vector<CellRobotView> robots;
  std::vector<CellJointView> joints;
  CellDescription settings;  // its settings alone
};

// `cell` outlives the view.
struct PolicyChoice {
  std::string policy;
};
[[nodiscard]] FormatPtr<PolicyChoice> policy_choice_format();

[[nodiscard]] CellDescription settings_of(const Cell& cell);
[[nodiscard]] CellView view_of(const Cell& cell, std::string policy, double speed);
[[nodiscard]] FormatPtr<CellView> cell_view_format();

}  // namespace armloom
