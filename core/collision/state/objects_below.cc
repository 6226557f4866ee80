#include "core/collision/state/objects_below.h"

namespace armloom {

std::vector<std::pair<ArmId, std::size_t>> objects_below(const PlanningScene::Bodies& bodies) {
  std::vector<std::pair<ArmId, std::size_t>> found;
  for (const auto& [link, object] : bodies.cell->allowed.link_objects) {
    for (std::uint32_t arm = 0; arm < bodies.cell->arms.size(); ++arm) {
      if (!bodies.cell->is_mount(link, ArmId{arm})) continue;
      for (std::size_t body = 0; body < bodies.bodies.size(); ++body) {
        const CollisionBody& of = bodies.bodies[body];
        if (!of.carrier && of.name == object) found.emplace_back(ArmId{arm}, body);
      }
    }
  }
  return found;
}

}  // namespace armloom
