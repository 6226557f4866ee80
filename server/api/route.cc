#include "server/api/route.h"

#include <algorithm>

#include "server/messages/mesh_address.h"

namespace armloom {

const std::vector<Route>& all_routes() {
  static const std::vector<Route> routes = [] {
    std::vector<Route> all;
    for (const auto& part :
         {submission_routes(), plan_routes(), job_routes(), motion_routes(), arm_routes(),
          control_routes(), scene_routes(), io_routes(), cell_routes(), comparison_routes(),
          simulation_routes(), event_routes(), state_routes(), recording_routes(), session_routes(),
          audit_routes(), alert_routes(), service_routes()}) {
      all.insert(all.end(), part.begin(), part.end());
    }
    return all;
  }();
  return routes;
}

bool Route::answers_json() const {
  return std::ranges::any_of(outcomes, [](const Outcome& outcome) {
    return std::ranges::any_of(
        outcome.content, [](const Content& content) { return content.type == "application/json"; });
  });
}

std::vector<int> common_refusals(const Route& route) {
  std::vector<int> statuses{400, 413, 414, 417, 431, 503};
  if (route.rights().is_counted()) statuses.push_back(429);
  if (route.who != Who::anyone) statuses.push_back(403);
  if (route.role) statuses.push_back(401);
  if (route.reads) statuses.push_back(415);
  return statuses;
}

std::string api_path(const std::string& path) { return kApiPrefix + path; }

}  // namespace armloom
