#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <tl/expected.hpp>

namespace armloom {

// Resolves a mesh reference of a URDF to a file that exists.
//   package://name/rest          below the folder packages[name]
//   relative/path                below the URDF's own folder; ../path as an absolute one
//   file:///path, /absolute/path below the URDF's own folder or any of the packages' folders
// Anything else (http://) is refused, and so is a path that leaves its folder, as written or
// through symbolic links: a robot description from elsewhere must not make the server read, or
// show, other files than those that the cell file lets it, nor tell which there are. The error is
// half a sentence for "mesh <uri> ...", with the line that the cell lacks where one would help.
[[nodiscard]] tl::expected<std::filesystem::path, std::string> resolve_mesh(
    const std::string& uri, const std::filesystem::path& urdf_folder,
    const std::map<std::string, std::string>& packages);

// All meshes that the URDF names, in visuals too, as it names them, with their files: those that
// resolve_mesh finds and whose names say that they can be read (is_mesh_name). Precondition: the
// text is XML, else nothing is found.
[[nodiscard]] std::map<std::string, std::string> mesh_files(
    const std::string& urdf_text, const std::filesystem::path& urdf_folder,
    const std::map<std::string, std::string>& packages);

// The URDF with other names for its meshes, by the names that it has; the others stay.
// Precondition: as above, else the text.
[[nodiscard]] std::string with_mesh_names(const std::string& urdf_text,
                                          const std::map<std::string, std::string>& names);

}  // namespace armloom
