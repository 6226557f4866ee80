#include "server/api/route.h"
#include "server/messages/cell.h"
#include "server/messages/mesh_address.h"

namespace armloom {
namespace {

void get_cell(Call call) {
  const ApiParts& parts = call.parts;
  const CellView cell = view_of(*parts.cell, parts.policy, parts.loop.speed());
  call.respond(answer(200, cell_view_format(), cell));
}

void get_mesh(Call call) { call.respond(call.meshes.answer(call.request, call.arguments.front())); }

}  // namespace

std::vector<Route> cell_routes() {
  const Schema file{{"type", "string"}, {"format", "binary"}};
  Outcome mesh{200, "The file"};
  for (const std::string& type : CellMeshes::content_types()) mesh.content.push_back({type, file});
  return {
      {.method = "GET",
       .path = api_path("/cell"),
       .id = "getCell",
       .tag = "cell",
       .summary = "Robots, joints, settings",
       .outcomes = {outcome(200, "The cell as the dashboard needs it", cell_view_format())},
       .run = get_cell},
      {.method = "GET",
       .path = api_path(kMeshFolder + std::string("{name}")),
       .id = "getMesh",
       .tag = "cell",
       .summary = "A mesh that a robot or an object names",
       .outcomes = {mesh},
       .refuses = {404},
       .run = get_mesh},
  };
}

}  // namespace armloom
