#pragma once

#include <string>

namespace armloom {

// Prefix of all paths of the API. Paths of the server itself (/healthz, /docs, ...) do not have it.
inline constexpr const char* kApiPrefix = "/api/v1";
inline constexpr const char* kMeshFolder = "/cell/meshes/";

// Returns a hash of the path and its extension in lower case ("91d3c0ffee5a1b2c.stl"), so that
// clients never see the path.
[[nodiscard]] std::string mesh_name(const std::string& path);

[[nodiscard]] std::string mesh_address(const std::string& path);

}  // namespace armloom
