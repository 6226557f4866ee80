#include "server/import/packages.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include "core/model/urdf/mesh_path.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;

// Files and addresses of the meshes in one package.
struct NamedFiles {
  std::set<std::string> inside;     // paths below the package's folder
  std::set<std::string> meshes;     // as the URDF names them
  std::vector<fs::path> addressed;  // folders that addresses give the package (file://)
};

// Returns the meshes that the URDF looks for in packages. Omits those that are below its own
// folder.
std::map<std::string, NamedFiles> files_by_package(
    const std::string& urdf_text, const fs::path& urdf,
    const std::map<std::string, std::string>& given) {
  std::map<std::string, NamedFiles> files;
  for (const std::string& mesh : mesh_names(urdf_text)) {
    const auto path = package_of_mesh(mesh, urdf.parent_path(), given);
    if (!path || resolve_mesh(mesh, urdf.parent_path(), {})) continue;
    NamedFiles& named = files[path->package];
    named.inside.insert(path->inside.lexically_normal().string());
    named.meshes.insert(mesh);
    if (!path->folder.empty()) named.addressed.push_back(path->folder);
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

// Returns the folders next to a folder in which the files of a package may be: its parent, and its
// subfolders.
std::vector<fs::path> folders_around(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.is_directory(error)) folders.push_back(entry.path());
  }
  std::ranges::sort(folders);
  folders.insert(folders.begin(), folder.parent_path());
  return folders;
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
  for (const auto& [name, folder] : given) packages.unused.insert(name);
  for (const auto& [name, files] : files_by_package(urdf_text, urdf, given)) {
    packages.unused.erase(name);
    const auto first_with_files = [&,
                                   &inside = files.inside](const std::vector<fs::path>& folders) {
      const auto found = std::ranges::find_if(
          folders, [&](const fs::path& path) { return holds_one(path, inside); });
      return found == folders.end() ? fs::path() : *found;
    };
    const MissingPackage missing{
        .meshes = files.meshes, .inside = *files.inside.begin(), .given = {}, .likely = {}};
    if (const auto known = given.find(name); known != given.end()) {
      const fs::path folder = fs::weakly_canonical(known->second);
      packages.folders[name] = folder.string();
      if (holds_one(folder, files.inside)) continue;
      MissingPackage& misplaced = packages.missing.emplace(name, missing).first->second;
      misplaced.given = known->second;
      misplaced.likely = first_with_files(folders_around(folder)).string();
      continue;
    }
    std::vector<fs::path> candidates;
    fs::path folder = fs::weakly_canonical(urdf).parent_path();
    for (; folder != folder.root_path(); folder = folder.parent_path()) {
      candidates.push_back(folder);
      candidates.push_back(folder / name);
    }
    for (const fs::path& share : installed) candidates.push_back(share / name);
    const fs::path found = first_with_files(candidates);
    if (found.empty()) {
      // Other folders are only suggested: the URDF must not choose what the cell permits.
      packages.missing.emplace(name, missing).first->second.likely =
          first_with_files(files.addressed).string();
    } else {
      packages.folders[name] = found.string();
      if (found.filename() != name) packages.guessed[name] = found.string();
    }
  }
  return packages;
}

std::string to_text(const std::string& package, const MissingPackage& missing, const fs::path& urdf,
                    const std::set<std::string>& unused) {
  const bool is_one = missing.meshes.size() == 1;
  const std::string meshes = std::to_string(missing.meshes.size()) +
                             (is_one ? " mesh of " : " meshes of ") + urdf.filename().string() +
                             " in the package " + package + " (" + *missing.meshes.begin() +
                             (is_one ? ")" : ", ...)");
  const std::string option = "--package " + package + "=";
  const std::string remedy =
      missing.likely.empty()
          ? "give " + option + "FOLDER with the folder that contains " + missing.inside
          : "give " + option + missing.likely;
  if (!missing.given.empty()) return missing.given + " has none of the " + meshes + ": " + remedy;
  std::string others;
  for (const std::string& name : unused) others += (others.empty() ? "" : ", ") + name;
  return meshes + (is_one ? " was" : " were") + " not found above " + urdf.string() + ": " +
         remedy + (others.empty() ? "" : " (no mesh needs --package " + others + ")");
}

std::vector<fs::path> installed_package_folders() {
  std::vector<fs::path> folders = split("AMENT_PREFIX_PATH", "share");
  for (const fs::path& folder : split("ROS_PACKAGE_PATH", "")) folders.push_back(folder);
  return folders;
}

}  // namespace armloom
