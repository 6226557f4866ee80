#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/model/cell.h"
#include "server/http/message.h"

namespace armloom {

// Serves the mesh files of URDFs (visual meshes included) and of the cell file's objects. A request
// contains a mesh_name() (mesh_address.h), never a path.
class CellMeshes {
 public:
  explicit CellMeshes(const Cell& cell);

  [[nodiscard]] static std::vector<std::string> content_types();

  // Answers 404 if the name is unknown, or if the file is gone or exceeds kMaxMeshBytes. Answers
  // 503 if no file descriptor is left. Concurrent requests for a file share its bytes in memory.
  [[nodiscard]] Response answer(const Request& request, const std::string& name);

 private:
  struct Place {
    std::filesystem::path file;  // canonical at start: a later symbolic link is refused
    std::string stamp;           // file stamp of `bytes`
    std::weak_ptr<const std::string> bytes;
    std::string tag;
  };
  std::map<std::string, Place> places_;  // by name
};

}  // namespace armloom
