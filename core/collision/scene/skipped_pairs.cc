#include <map>

#include "core/collision/scene/planning_scene.h"
#include "core/collision/scene/scene_bodies.h"

namespace armloom {

const char* to_string(SkippedPair::Reason reason) {
  switch (reason) {
    case SkippedPair::Reason::robot_files:
      return "robot_files";
    case SkippedPair::Reason::cell_file:
      return "cell_file";
    case SkippedPair::Reason::out_of_reach:
      return "out_of_reach";
  }
  return nullptr;
}

std::vector<SkippedPair> PlanningScene::skipped_pairs() const {
  using Reason = SkippedPair::Reason;
  const Cell& cell = this->cell();
  std::map<LinkPair, Reason> reasons;  // the first that is given counts
  for (const LinkPair& pair : cell.allowed.cell_file_pairs) reasons[pair] = Reason::cell_file;
  for (const LinkPair& pair : cell.allowed.link_pairs) reasons.emplace(pair, Reason::robot_files);
  for (const LinkPair& pair : *bodies_->out_of_reach) reasons.emplace(pair, Reason::out_of_reach);

  std::vector<SkippedPair> skipped;
  for (const auto& [pair, reason] : reasons) {
    const Link& a = cell.link(pair.first);
    const Link& b = cell.link(pair.second);
    if (a.shapes.empty() || b.shapes.empty() || (!a.arm && !b.arm)) continue;
    skipped.push_back({a.name, b.name, reason});
  }
  for (const auto& [id, object] : cell.allowed.link_objects) {
    const Link& link = cell.link(id);
    const bool is_there = std::ranges::find(bodies_->objects, object, &CollisionObject::name) !=
                          bodies_->objects.end();
    if (!is_there || link.shapes.empty() || !link.arm) continue;
    skipped.push_back({link.name, object, Reason::cell_file});
  }
  return skipped;
}

}  // namespace armloom
