#pragma once

#include <filesystem>
#include <string>

#include "core/model/cell/build_cell.h"

namespace armloom {

[[nodiscard]] std::string data_file(const std::string& name);   // test/model/data/...
[[nodiscard]] std::string model_file(const std::string& name);  // models/...

// Returns test/model/data/two_arms: both arms of one robot, prefix "t_", base pose away from the
// origin.
[[nodiscard]] CellDescription two_arms_description();

// Returns the two Pandas of config/two_pandas.json, without limits of their own.
[[nodiscard]] CellDescription two_pandas_description();

// Builds the cell, or fails the test with all problems of build_cell.
[[nodiscard]] CellPtr build_or_fail(const CellDescription& description);

// Returns all problems of the description, one line each: "<pointer> | <detail>"; empty if it
// builds.
[[nodiscard]] std::string problems_of(const CellDescription& description);

// Builds the cell and returns all warnings in the same format. Throws if it does not build.
[[nodiscard]] std::string warnings_of(const CellDescription& description);

// A new folder that is removed with this object.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  // Writes a file, creating the folders above it, and returns its path.
  std::string write(const std::string& name, const std::string& text) const;

 private:
  std::filesystem::path path_;
};

// Returns a file's text with `from`, which must occur exactly once, replaced by `to`.
[[nodiscard]] std::string file_with(const std::string& path, const std::string& from,
                                    const std::string& to);

// Removes the line numbers of URDF and SRDF files: "a.urdf:12: link b" -> "a.urdf: link b".
[[nodiscard]] std::string without_lines(const std::string& text);

// Returns the line number in "a.urdf:12: link b", or 0 if there is none.
[[nodiscard]] int line_of(const std::string& place);

// Returns the first line in which two texts differ.
[[nodiscard]] int line_of_change(const std::string& before, const std::string& after);

inline const Joint& joint_of(const Cell& cell, const char* name) {
  return cell.joint(*cell.find_joint(name));
}

inline std::vector<std::string> names_of(const Cell& cell, const std::vector<JointId>& joints) {
  std::vector<std::string> names;
  for (const JointId joint : joints) names.push_back(cell.joint(joint).name);
  return names;
}

// Gives the first robot of two_arms this joint_limits.yaml.
inline CellDescription with_limits_file(const ScratchFolder& folder, const std::string& text) {
  CellDescription cell = two_arms_description();
  cell.robots[0].joint_limits = folder.write("joint_limits.yaml", text);
  return cell;
}

}  // namespace armloom
