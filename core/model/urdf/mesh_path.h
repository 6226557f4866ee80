#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <tl/expected.hpp>

namespace armloom {

// Resolves a mesh reference of a URDF to an existing file:
//   package://name/rest          below the folder packages[name]
//   relative/path                below the URDF's own folder
//   ../path                      treated as an absolute path
//   file:///path, /absolute/path below the URDF's own folder or any of the packages' folders
// Refuses other schemes (http://) and paths that leave their folder, as written or through symbolic
// links. A foreign robot description must not make the server read or show files that the cell file
// does not permit, or reveal which files exist. The error text continues the sentence "mesh <uri>
// ...". If a line in the cell file would permit the mesh, the text quotes that line.
[[nodiscard]] tl::expected<std::filesystem::path, std::string> resolve_mesh(
    const std::string& uri, const std::filesystem::path& urdf_folder,
    const std::map<std::string, std::string>& packages);

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
