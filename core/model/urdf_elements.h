#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/model/findings.h"
#include "core/model/robot_tree.h"

namespace tinyxml2 {
class XMLElement;
}

namespace armloom {

// Where a URDF's meshes are looked for (mesh_path.h).
struct MeshFolders {
  std::filesystem::path urdf_folder;
  const std::map<std::string, std::string>* packages;
};

// The <link> and <joint> elements of a URDF, each for itself and in the file's order. Names may be
// missing (empty), doubled or unknown: what hangs where is make_tree's.
struct UrdfLink {
  std::string name;
  int line;
  std::vector<PlacedShape> shapes;
};
struct UrdfMimic {
  std::string joint;
  double multiplier;
  double offset;
};
struct UrdfJoint {
  std::string name;
  int line;
  std::string parent;  // empty: missing, and told
  std::string child;
  std::optional<JointKind> motion;  // none: fixed, or of a kind with more than one value
  bool many_values = false;         // floating, planar
  Eigen::Isometry3d X_PJ = Eigen::Isometry3d::Identity();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
  std::optional<UrdfMimic> mimic;
  UrdfLimits limits;
};
struct UrdfElements {
  std::vector<UrdfLink> links;
  std::vector<UrdfJoint> joints;
};

// Reads every element and tells all that is wrong. What the model is made of must be right: poses,
// axes, collision shapes, mimics; each number finite and complete, nothing doubled or missing. What
// it does not use (visuals, masses, efforts, unknown elements) only warns, and limits are judged by
// whose joint it is (UrdfLimits). A faulty part is left out, so that the rest can still be read.
// `file` begins each place.
[[nodiscard]] UrdfElements read_urdf_elements(const tinyxml2::XMLElement& robot,
                                              const std::string& file, const MeshFolders& folders,
                                              Findings& findings);

// Links depth first, children by their joints' names. Names must be unique, joints connect known
// links, all links hang in one tree under one root, and a mimic joint follows a movable joint that
// is no mimic. Where that is not so it is told, and the tree is patched: every name of the file
// that occurs is in it, so that other files' names can still be looked up.
[[nodiscard]] RobotTree make_tree(UrdfElements elements, const std::string& file,
                                  Findings& findings);

}  // namespace armloom
