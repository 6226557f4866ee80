#pragma once

#include <map>
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
  [[nodiscard]] Response answer(const std::string& name) const;

 private:
  std::map<std::string, std::string> paths_;  // by name
};

}  // namespace armloom
