#include "core/executive/active_policy.h"
#include "core/executive/status_board.h"
#include "server/api/route.h"
#include "server/messages/cell.h"
#include "server/messages/mesh_address.h"

namespace armloom {
namespace {

void get_cell(Call call) {
  const ApiParts& parts = call.parts;
  const CellView cell = view_of(*parts.cell, parts.loop.board().read().policy, parts.loop.speed());
  call.respond(answer(200, cell_view_format(), cell));
}

void put_policy(Call call) {
  const ApiParts& parts = call.parts;
  const auto change = [&parts, respond = call.respond](const PolicyChoice& choice) {
    ask(
        parts,
        [choice](Executive& executive) {
          auto changed = executive.policy().change(choice.policy);
          if (changed) executive.alert({Alert::Level::info, "the policy is now " + choice.policy});
          return changed;
        },
        [respond, choice](const Result<void>& changed) {
          if (!changed) return respond(problem_response(changed.error()));
          respond(answer(200, policy_choice_format(), choice));
        });
  };
  read_body(
      parts, call.request, call.respond,
      [](std::string_view text) { return read_text(*policy_choice_format(), text); }, change);
}

void get_mesh(Call call) { call.respond(call.meshes.answer(call.request, call.arguments.front())); }

}  // namespace

std::vector<Route> cell_routes() {
  const Schema file{{"type", "string"}, {"format", "binary"}};
  Outcome mesh{200, "The mesh file"};
  for (const std::string& type : CellMeshes::content_types()) mesh.content.push_back({type, file});
  return {
      {.method = "GET",
       .path = api_path("/cell"),
       .id = "getCell",
       .tag = "cell",
       .summary = "Get the cell: robots, joints, settings",
       .outcomes = {outcome(200, "The cell", cell_view_format())},
       .run = get_cell},
      {.method = "PUT",
       .path = api_path("/policy"),
       .id = "changePolicy",
       .tag = "cell",
       .summary = "Change the policy",
       .text = "Possible only while no job is admitted. All waiting jobs are checked again under "
               "the new policy. The change lasts until the server restarts.",
       .reads = body(policy_choice_format(), {{"coordinated", R"({"policy": "coordinated"})"}}),
       .outcomes = {outcome(200, "The policy now in force", policy_choice_format())},
       .refuses = {409, 422},
       .who = Who::commander,
       .role = Role::operate,
       .run = put_policy},
      {.method = "GET",
       .path = api_path(kMeshFolder + std::string("{name}")),
       .id = "getMesh",
       .tag = "cell",
       .summary = "Get a mesh file of a robot or an object",
       .outcomes = {mesh},
       .refuses = {404},
       .run = get_mesh},
  };
}

}  // namespace armloom
