#include <algorithm>
#include <utility>

#include "server/api/routes.h"
#include "server/codec/views.h"

namespace armloom {
namespace {

using Arguments = Router::Arguments;

void list_arms(const ApiParts& parts, Respond respond) {
  ask(
      parts, [](Executive& executive) { return executive.arms(); },
      [respond](const std::vector<ArmView>& arms) {
        JsonWriter out;
        out.begin_object().key("arms").begin_array();
        for (const ArmView& arm : arms) write(out, arm);
        out.end_array().end_object();
        respond(json_response(200, out.take()));
      });
}

// Does change(executive, arms) to one arm, and answers with what it is then.
template <class Change>
Router::Answer of_one_arm(const ApiParts& parts, int status, Change change) {
  return [&parts, status, change](const Request&, const Arguments& arguments, Respond respond) {
    const auto arm = parts.cell->find_arm(arguments.front());
    if (!arm) return respond(no_such("arm", arguments.front()));
    ask(
        parts,
        [arm = *arm, change](Executive& executive) {
          change(executive, std::vector<ArmId>{arm});
          return executive.arms()[arm.index()];
        },
        [respond, status](const ArmView& view) {
          JsonWriter out;
          write(out, view);
          respond(json_response(status, out.take()));
        });
  };
}

Router::Answer of_all_arms(const ApiParts& parts, bool stops) {
  return [&parts, stops](const Request&, const Arguments&, Respond respond) {
    ask(
        parts,
        [stops](Executive& executive) {
          if (stops) {
            executive.stop_all("operator");
          } else {
            executive.resume_all();
          }
          return stops;
        },
        [respond](bool stopped) {
          JsonWriter out;
          out.begin_object().field("stopped", stopped).end_object();
          respond(json_response(202, out.take()));
        });
  };
}

}  // namespace

void add_arm_routes(Router& router, const ApiParts& parts) {
  using Arms = std::vector<ArmId>;
  const std::string api = kApi;
  router.add("GET", api + "/arms", [&parts](const Request&, const Arguments&, Respond respond) {
    list_arms(parts, std::move(respond));
  });
  router.add("GET", api + "/arms/{}", of_one_arm(parts, 200, [](Executive&, const Arms&) {}));
  router.add("POST", api + "/arms/{}/stop",
             of_one_arm(parts, 202, [](Executive& executive, const Arms& arms) {
               executive.stop(arms, "operator");
             }));
  router.add("POST", api + "/arms/{}/resume",
             of_one_arm(parts, 202,
                        [](Executive& executive, const Arms& arms) { executive.resume(arms); }));
  router.add("POST", api + "/stop", of_all_arms(parts, true));
  router.add("POST", api + "/resume", of_all_arms(parts, false));
}

}  // namespace armloom
