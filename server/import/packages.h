#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace armloom {

// A package of which no file was found.
struct MissingPackage {
  std::set<std::string> meshes;  // addresses in the URDF
  std::string inside;            // path of one of them below the package's folder
  std::string given;             // the folder that the caller gave, which has none of the files
  std::string likely;            // an existing folder with one of the files, or empty
};

// Folders of the packages that a URDF names by package://name/... or file:///any/name/meshes/...
// (package_of_mesh). The caller may give folders in `given`. A package that is not in `given` is
// found by its files: in a folder above the URDF, in a subfolder of such a folder with the
// package's name, or in a folder of `installed` (ROS share/ folders).
struct Packages {
  std::map<std::string, std::string> folders;  // absolute
  std::map<std::string, std::string> guessed;  // packages whose folder has another name
  std::map<std::string, MissingPackage> missing;
  std::set<std::string> unused;  // names in `given` that no mesh needs
};
[[nodiscard]] Packages find_packages(const std::string& urdf_text,
                                     const std::filesystem::path& urdf,
                                     std::map<std::string, std::string> given,
                                     const std::vector<std::filesystem::path>& installed);

// Returns the sentence about a missing package, with the option that helps.
[[nodiscard]] std::string to_text(const std::string& package, const MissingPackage& missing,
                                  const std::filesystem::path& urdf,
                                  const std::set<std::string>& unused);

// Returns the folders in AMENT_PREFIX_PATH and ROS_PACKAGE_PATH; empty without ROS.
[[nodiscard]] std::vector<std::filesystem::path> installed_package_folders();

}  // namespace armloom
