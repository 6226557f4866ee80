#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace armloom {

// Folders of the packages that a URDF names by package://name/... The caller may give folders in
// `given`. A package that is not in `given` is found by its files: in a folder above the URDF, in a
// subfolder of such a folder with the package's name, or in a folder of `installed` (ROS share/
// folders).
struct Packages {
  std::map<std::string, std::string> folders;  // absolute
  std::map<std::string, std::string> guessed;  // packages whose folder has another name
  std::set<std::string> missing;               // packages not found
};
[[nodiscard]] Packages find_packages(const std::string& urdf_text,
                                     const std::filesystem::path& urdf,
                                     std::map<std::string, std::string> given,
                                     const std::vector<std::filesystem::path>& installed);

// Returns the folders in AMENT_PREFIX_PATH and ROS_PACKAGE_PATH; empty without ROS.
[[nodiscard]] std::vector<std::filesystem::path> installed_package_folders();

}  // namespace armloom
