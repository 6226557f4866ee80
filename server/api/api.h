#pragma once

#include "server/api/cell_meshes.h"
#include "server/api/parts.h"
#include "server/api/recording_files.h"
#include "server/http/router.h"

namespace armloom {

struct Route;

// The HTTP interface of one server session. The parts must outlive the Api, and the Api must
// outlive all calls of the router.
class Api {
 public:
  explicit Api(ApiParts parts)
      : parts_(std::move(parts)),
        meshes_(*parts_.cell),
        recordings_(parts_.data, parts_.recording) {}

  void add_routes(Router& router);

 private:
  [[nodiscard]] Respond with_text(const Route& route, Respond respond) const;

  ApiParts parts_;
  CellMeshes meshes_;
  RecordingFiles recordings_;
};

}  // namespace armloom
