#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "core/base/diagnostics.h"
#include "core/model/cell_description.h"

namespace armloom {

// The limits of MoveIt's joint_limits.yaml, by URDF joint name.
struct LimitsFile {
  struct Joint {
    std::string place;              // "joint_limits.yaml:12: joint panda_joint1"
    JointLimitsDescription limits;  // brake from max_deceleration
    Diagnostics faults;             // problems if the joint belongs to an arm of the cell
  };
  std::string file;  // file name without folder
  std::map<std::string, Joint> joints;
};

// Reads the text of a joint_limits.yaml that was loaded from `path`. The limits may be nested as in
// ROS 2's parameter files. A limit applies unless its has_..._limits is false, as in MoveIt.
// Default scaling factors are only checked, because they affect only MoveIt's planning. `prefix` is
// prepended to the joint names. Returns nullopt, with the reasons in `diagnostics`, if the text is
// not YAML or has no joint_limits.
[[nodiscard]] std::optional<LimitsFile> read_limits_file(const std::string& text,
                                                         const std::filesystem::path& path,
                                                         const std::string& prefix,
                                                         Diagnostics& diagnostics);

}  // namespace armloom
