#include <algorithm>
#include <cmath>

#include "core/model/cell_doubts.h"
#include "core/model/kinematics.h"
#include "core/model/mesh.h"

namespace armloom {
namespace {

constexpr double kLarge_m = 1.2;  // bases, torsos and beams reach less from the first joint

// At most: the farthest point of the shape from p_L.
double reach_m(const PlacedShape& placed, const Eigen::Vector3d& p_L) {
  const Eigen::Vector3d p = placed.X_LS.inverse() * p_L;
  if (const auto* box = std::get_if<Box>(&placed.shape))
    return (p.cwiseAbs() + box->size_m / 2).norm();
  if (const auto* cylinder = std::get_if<Cylinder>(&placed.shape)) {
    return std::hypot(std::hypot(p.x(), p.y()) + cylinder->radius_m,
                      std::abs(p.z()) + cylinder->length_m / 2);
  }
  if (const auto* sphere = std::get_if<Sphere>(&placed.shape)) return p.norm() + sphere->radius_m;
  double farthest = 0.0;
  const auto& mesh = std::get<Mesh>(placed.shape);
  if (mesh.data == nullptr) return farthest;
  for (const Eigen::Vector3d& vertex : mesh.data->vertices)
    farthest = std::max(farthest, (vertex - p).norm());
  return farthest;
}

}  // namespace

void warn_of_large_mounts(const Cell& cell, Findings& findings) {
  if (cell.self_clearance_m >= cell.clearance_m) return;
  LinkPoses X_WL;
  forward_kinematics(cell, cell.home(), X_WL);
  for (std::uint32_t a = 0; a < cell.arms.size(); ++a) {
    const Arm& arm = cell.arms[a];
    const auto moved = std::ranges::find_if(arm.links, [&](LinkId link) {
      const auto& parent = cell.link(link).parent;
      return parent && !cell.link(*parent).arm;
    });
    if (moved == arm.links.end()) continue;
    for (std::uint32_t l = 0; l < cell.links.size(); ++l) {
      if (!cell.is_mount(LinkId{l}, ArmId{a})) continue;
      const Link& mount = cell.links[l];
      const Eigen::Vector3d p_L = X_WL[l].inverse() * X_WL[moved->index()].translation();
      double reach = 0.0;
      for (const PlacedShape& placed : mount.shapes) reach = std::max(reach, reach_m(placed, p_L));
      if (reach <= kLarge_m) continue;
      findings.warn({ProblemKind::invalid, "large-mount", "",
                     "link " + mount.name + " carries arm " + arm.name + " and reaches " +
                         text_of(std::round(100.0 * reach) / 100.0) +
                         " m from its first joint: the arm keeps self_clearance_m (" +
                         text_of(cell.self_clearance_m) +
                         " m) from all of it, and no figure names it; a table or fixture in it "
                         "gets clearance_m (" +
                         text_of(cell.clearance_m) + " m) as a link of its own",
                     mount.name});
    }
  }
}

}  // namespace armloom
