#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "core/base/diagnostics.h"
#include "core/model/cell_description.h"

namespace armloom {

// MoveIt's joint_limits.yaml: what it says of each joint, by URDF name.
struct LimitsFile {
  struct Joint {
    std::string place;              // "joint_limits.yaml:12: joint panda_joint1"
    JointLimitsDescription limits;  // the brake from max_deceleration
    Diagnostics faults;             // problems if an arm of the cell has the joint
  };
  std::string file;  // file name without folder
  std::map<std::string, Joint> joints;
};

// Reads such a file, which was loaded from `path`. A limit counts when its has_..._limits is true,
// as for MoveIt; the default scaling factors are of MoveIt's plans and no limits, so they are only
// checked. Also finds the map under ROS 2's /**: ros__parameters: robot_description_planning. Keys
// that are not known warn. Nothing, with the reasons in `diagnostics`, when the text is no YAML or
// holds no joint_limits.
[[nodiscard]] std::optional<LimitsFile> read_limits_file(const std::string& text,
                                                         const std::filesystem::path& path,
                                                         Diagnostics& diagnostics);

}  // namespace armloom
