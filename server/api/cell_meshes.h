#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/model/cell.h"
#include "server/http/message.h"

namespace armloom {

// The mesh files that the cell names, for the dashboard: those of the robots' URDFs, visuals too,
// and of the objects at start. A request holds a name of mesh_address.h, never a path.
class CellMeshes {
 public:
  explicit CellMeshes(const Cell& cell);

  // Of what may be served.
  [[nodiscard]] static std::vector<std::string> content_types();

  // 404 for a name that is none of these, and for a file that has gone or grown over kMaxMeshBytes.
  // 503 when there are too few file descriptors to look. Who asks while another one still reads it
  // gets the same bytes.
  [[nodiscard]] Response answer(const Request& request, const std::string& name);

 private:
  struct Place {
    std::filesystem::path file;  // where it truly was at start: no link leads elsewhere later
    std::string stamp;           // of `bytes`
    std::weak_ptr<const std::string> bytes;
    std::string tag;
  };
  std::map<std::string, Place> places_;  // by name
};

}  // namespace armloom
