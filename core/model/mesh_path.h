#pragma once

#include <filesystem>
#include <map>
#include <string>

#include <tl/expected.hpp>

namespace armloom {

// Resolves a mesh reference of a URDF to a file that exists.
//   package://name/rest   below the folder packages[name]
//   relative/path         below the URDF's own folder
// Anything else (absolute, file://, http://) is refused, and so is a path that leaves its folder,
// as written or through symbolic links: a robot description from elsewhere must not make the server
// read, or show, other files. The error is half a sentence for "mesh <uri> ...".
[[nodiscard]] tl::expected<std::filesystem::path, std::string> resolve_mesh(
    const std::string& uri, const std::filesystem::path& urdf_folder,
    const std::map<std::string, std::string>& packages);

}  // namespace armloom
