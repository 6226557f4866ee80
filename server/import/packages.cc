#include "server/import/packages.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <system_error>

namespace armloom {
namespace {

namespace fs = std::filesystem;

std::map<std::string, std::set<std::string>> named_files(const std::string& urdf) {
  static constexpr std::string_view kScheme = "package://";
  std::map<std::string, std::set<std::string>> files;
  for (std::size_t at = 0; (at = urdf.find(kScheme, at)) != urdf.npos;) {
    at += kScheme.size();
    const std::string address = urdf.substr(at, urdf.find_first_of("\"'<> \t\r\n", at) - at);
    const std::size_t slash = address.find('/');
    if (slash == 0 || slash == address.npos) continue;
    files[address.substr(0, slash)].insert(address.substr(slash + 1));
  }
  return files;
}

// Returns true if the folder contains at least one of the files. Does not require all files,
// because a URDF often names missing files (omitted visuals).
bool holds_one(const fs::path& folder, const std::set<std::string>& files) {
  std::error_code error;
  return std::ranges::any_of(
      files, [&](const std::string& file) { return fs::is_regular_file(folder / file, error); });
}

std::vector<fs::path> split(const char* variable, const char* below) {
  std::vector<fs::path> folders;
  const char* value = std::getenv(variable);
  std::string_view rest = value == nullptr ? "" : value;
  while (!rest.empty()) {
    const std::string_view one = rest.substr(0, rest.find(':'));
    if (!one.empty()) folders.push_back(fs::path(one) / below);
    rest.remove_prefix(std::min(rest.size(), one.size() + 1));
  }
  return folders;
}

}  // namespace

Packages find_packages(const std::string& urdf_text, const fs::path& urdf,
                       std::map<std::string, std::string> given,
                       const std::vector<fs::path>& installed) {
  Packages packages;
  for (const auto& [name, files] : named_files(urdf_text)) {
    if (const auto known = given.find(name); known != given.end()) {
      packages.folders[name] = fs::weakly_canonical(known->second).string();
      continue;
    }
    std::vector<fs::path> candidates;
    fs::path folder = fs::weakly_canonical(urdf).parent_path();
    for (; folder != folder.root_path(); folder = folder.parent_path()) {
      candidates.push_back(folder);
      candidates.push_back(folder / name);
    }
    for (const fs::path& share : installed) candidates.push_back(share / name);
    const auto found = std::ranges::find_if(
        candidates, [&, &wanted = files](const fs::path& path) { return holds_one(path, wanted); });
    if (found == candidates.end()) {
      packages.missing.insert(name);
    } else {
      packages.folders[name] = found->string();
      if (found->filename() != name) packages.guessed[name] = found->string();
    }
  }
  return packages;
}

std::vector<fs::path> installed_package_folders() {
  std::vector<fs::path> folders = split("AMENT_PREFIX_PATH", "share");
  for (const fs::path& folder : split("ROS_PACKAGE_PATH", "")) folders.push_back(folder);
  return folders;
}

}  // namespace armloom
