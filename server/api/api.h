#pragma once

#include <functional>

#include "server/api/cell_meshes.h"
#include "server/api/parts.h"
#include "server/http/router.h"

namespace armloom {

// Everything under /api/v1, /healthz and /readyz, and the feeds. All parts outlive the API, which
// outlives the router's calls.
class Api {
 public:
  explicit Api(ApiParts parts) : parts_(std::move(parts)), meshes_(*parts_.cell) {}

  void add_routes(Router& router);
  // A reader of the event stream: `?stream=&since=` resumes where it was, otherwise, and when those
  // events are gone ("gap"), it begins with a snapshot.
  void subscribe(const Target& target, std::function<void(FeedPtr)> then);

 private:
  ApiParts parts_;
  CellMeshes meshes_;
};

}  // namespace armloom
