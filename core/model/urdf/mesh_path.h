#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tl/expected.hpp>

namespace armloom {

// Resolves a mesh reference of a URDF to an existing file:
//   package://name/rest          below the folder packages[name]
//   relative/path                below the URDF's own folder
//   ../path                      treated as an absolute path
//   file:///path, /absolute/path below the URDF's own folder or any of the packages' folders. If
//                                there is no such file, the path may be of another machine:
//                                any/name/rest is below the folder packages[name]
// Refuses other schemes (http://) and paths that leave their folder, as written or through symbolic
// links. A foreign robot description must not make the server read or show files that the cell file
// does not permit, or reveal which files exist. The error text continues the sentence "mesh <uri>
// ...". If a line in the cell file would permit the mesh, the text quotes that line. It names a
// folder only if that folder exists.
[[nodiscard]] tl::expected<std::filesystem::path, std::string> resolve_mesh(
    const std::string& uri, const std::filesystem::path& urdf_folder,
    const std::map<std::string, std::string>& packages);

// The package of a mesh and the path of the mesh below the package's folder.
struct PackagePath {
  std::string package;
  std::filesystem::path inside;
  // The folder that the address itself gives the package (file:///home/ada/ws/name); it need not
  // exist. Empty for package://.
  std::filesystem::path folder;
};
// Returns the package in package://name/rest. In another path, which is relative to the URDF's
// folder unless it is absolute, and in a file:// address, the package is the last folder with a
// name in `packages`, else the folder above "meshes", else the mesh's own folder. Returns nullopt
// for other schemes, and addresses without a package.
[[nodiscard]] std::optional<PackagePath> package_of_mesh(
    const std::string& uri, const std::filesystem::path& urdf_folder,
    const std::map<std::string, std::string>& packages);

// Returns the name of each mesh in the URDF, also in visuals; empty if the text is not XML.
[[nodiscard]] std::set<std::string> mesh_names(const std::string& urdf_text);

// Returns the file of each mesh name in the URDF, also in visuals. Leaves out names that cannot be
// resolved and files whose format is not read (is_mesh_name). Returns an empty map if the text is
// not XML.
[[nodiscard]] std::map<std::string, std::string> mesh_files(
    const std::string& urdf_text, const std::filesystem::path& urdf_folder,
    const std::map<std::string, std::string>& packages);

// Returns the URDF with mesh names replaced by `names`, or unchanged if it is not XML.
[[nodiscard]] std::string with_mesh_names(const std::string& urdf_text,
                                          const std::map<std::string, std::string>& names);

}  // namespace armloom
