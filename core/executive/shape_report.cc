#include "core/executive/shape_report.h"

#include <utility>

#include "core/collision/scene_bodies.h"

namespace armloom {

Result<std::vector<LinkShapeReport>> report_shapes(CellPtr cell) {
  const auto scene = PlanningScene::build(std::move(cell));
  if (!scene) return failure(scene.error());
  const PlanningScene::Bodies& bodies = (*scene)->bodies();
  std::vector<LinkShapeReport> report;
  for (std::size_t i = 0; i < bodies.links_end; ++i) {
    const Part& part = bodies.parts[i];
    report.push_back({part.name, part.bodies_end - part.bodies_begin, part.capsules.size(),
                      part.capsule_excess_m});
  }
  return report;
}

}  // namespace armloom
