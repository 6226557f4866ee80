#include "core/executive/shape_report.h"

#include <algorithm>
#include <utility>

#include "core/collision/scene/scene_bodies.h"

namespace armloom {

Result<std::vector<ShapeReport>> report_shapes(CellPtr cell) {
  const auto scene = PlanningScene::build(std::move(cell));
  if (!scene) return failure(scene.error());
  const PlanningScene::Bodies& bodies = (*scene)->bodies();
  std::vector<ShapeReport> report;
  for (std::size_t i = 0; i < bodies.bodies.size(); ++i) {
    const CollisionBody& part = bodies.bodies[i];
    if (i > 0 && i < bodies.links_end && part.link == bodies.bodies[i - 1].link) {
      ShapeReport& link = report.back();
      link.convex_shapes += part.shapes_end - part.shapes_begin;
      link.capsules += part.fitted.capsules.size();
      link.excess_m = std::max(link.excess_m, part.fitted.overestimate_m);
      continue;
    }
    report.push_back({part.name, part.shapes_end - part.shapes_begin, part.fitted.capsules.size(),
                      part.fitted.overestimate_m});
  }
  return report;
}

}  // namespace armloom
