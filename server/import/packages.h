#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace armloom {

// The folders of the packages that a URDF names with package://name/..., besides those in `given`.
// A package lies where its files do: in a folder above the URDF, in one of its name beside such a
// folder, or in `installed` (share/ folders of ROS, if there are any).
struct Packages {
  std::map<std::string, std::string> folders;  // absolute
  std::map<std::string, std::string> guessed;  // those of them whose folder has another name
  std::set<std::string> missing;               // of packages that were not found
};
[[nodiscard]] Packages find_packages(const std::string& urdf_text,
                                     const std::filesystem::path& urdf,
                                     std::map<std::string, std::string> given,
                                     const std::vector<std::filesystem::path>& installed);

// From AMENT_PREFIX_PATH and ROS_PACKAGE_PATH, as ROS sets them; empty without ROS.
[[nodiscard]] std::vector<std::filesystem::path> installed_package_folders();

}  // namespace armloom
