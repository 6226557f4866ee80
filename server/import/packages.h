#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace armloom {

// Folders of the packages named by package://name/... in a URDF, in addition to `given`. A package
// is where its files are: in a folder above the URDF, in a subfolder of it with the package's name,
// or in `installed` (ROS share/ folders).
struct Packages {
  std::map<std::string, std::string> folders;  // absolute
  std::map<std::string, std::string> guessed;  // whose folder has another name
  std::set<std::string> missing;               // packages not found
};
[[nodiscard]] Packages find_packages(const std::string& urdf_text,
                                     const std::filesystem::path& urdf,
                                     std::map<std::string, std::string> given,
                                     const std::vector<std::filesystem::path>& installed);

// Returns the folders in AMENT_PREFIX_PATH and ROS_PACKAGE_PATH; empty without ROS.
[[nodiscard]] std::vector<std::filesystem::path> installed_package_folders();

}  // namespace armloom
