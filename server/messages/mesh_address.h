#pragma once

#include <string>

namespace armloom {

// Before every path of the interface, but those of the server itself (/healthz, /docs, ...).
inline constexpr const char* kApiPrefix = "/api/v1";
inline constexpr const char* kMeshFolder = "/cell/meshes/";

// The name under which a mesh file of the cell is served: a hash of its path and its extension in
// lower case ("91d3c0ffee5a1b2c.stl"), so that clients learn the kind of file and never its place.
[[nodiscard]] std::string mesh_name(const std::string& path);

// Where it is served.
[[nodiscard]] std::string mesh_address(const std::string& path);

}  // namespace armloom
