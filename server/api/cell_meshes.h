#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/model/cell.h"
#include "server/http/message.h"

namespace armloom {

// Serves the mesh files of the cell to the dashboard: meshes of the robots' URDFs (visuals
// included) and of the objects at start. A request contains a name of mesh_address.h, never a path.
class CellMeshes {
 public:
  explicit CellMeshes(const Cell& cell);

  // Returns all media types that answer() may use.
  [[nodiscard]] static std::vector<std::string> content_types();

  // 404 if the name is unknown, or if the file has disappeared or exceeds kMaxMeshBytes. 503 if no
  // file descriptor is left. Concurrent requests for one mesh share its bytes.
  [[nodiscard]] Response answer(const Request& request, const std::string& name);

 private:
  struct Place {
    std::filesystem::path
        file;           // canonical path at start, so that a later symbolic link cannot redirect it
    std::string stamp;  // file stamp of `bytes`
    std::weak_ptr<const std::string> bytes;
    std::string tag;
  };
  std::map<std::string, Place> places_;  // by name
};

}  // namespace armloom
