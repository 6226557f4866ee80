#pragma once

#include <filesystem>
#include <string>

#include "core/model/cell/build_cell.h"

namespace armloom {

[[nodiscard]] std::string data_file(const std::string& name);   // test/model/data/...
[[nodiscard]] std::string model_file(const std::string& name);  // models/...

// Returns test/model/data/two_arms: one robot with two arms, prefix "t_", and a base pose away from
// the origin.
[[nodiscard]] CellDescription two_arms_description();

// Returns the Pandas of config/two_pandas.json without joint limits in the description.
[[nodiscard]] CellDescription two_pandas_description();

// Builds the cell, or fails the test with its problems.
[[nodiscard]] CellPtr build_or_fail(const CellDescription& description);

// Returns all problems, one line each: "<pointer> | <detail>"; empty if the cell builds.
[[nodiscard]] std::string problems_of(const CellDescription& description);

// Returns all warnings in the same format; throws if the cell does not build.
[[nodiscard]] std::string warnings_of(const CellDescription& description);

class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  // Writes a file and its parent folders; returns its path.
  std::string write(const std::string& name, const std::string& text) const;

 private:
  std::filesystem::path path_;
};

// Returns a file's text with `from`, which must occur exactly once, replaced by `to`.
[[nodiscard]] std::string file_with(const std::string& path, const std::string& from,
                                    const std::string& to);

// "a.urdf:12: link b" -> "a.urdf: link b"
[[nodiscard]] std::string without_lines(const std::string& text);

// Returns 12 for "a.urdf:12: link b", 0 if there is no line.
[[nodiscard]] int line_of(const std::string& place);

[[nodiscard]] int line_of_change(const std::string& before, const std::string& after);

inline const Joint& joint_of(const Cell& cell, const char* name) {
  return cell.joint(*cell.find_joint(name));
}

inline std::vector<std::string> names_of(const Cell& cell, const std::vector<JointId>& joints) {
  std::vector<std::string> names;
  for (const JointId joint : joints) names.push_back(cell.joint(joint).name);
  return names;
}

inline CellDescription with_limits_file(const ScratchFolder& folder, const std::string& text) {
  CellDescription cell = two_arms_description();
  cell.robots[0].joint_limits = folder.write("joint_limits.yaml", text);
  return cell;
}

}  // namespace armloom
