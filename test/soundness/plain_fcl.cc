#include "test/soundness/plain_fcl.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <exception>
#include <limits>

namespace armloom::soundness {
namespace {

using Shape = std::shared_ptr<fcl::CollisionGeometryd>;

// Returns the triangles of a closed mesh, which replace its pieces.
Shape surface_of(const SurfaceTree& tree) {
  auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  std::vector<fcl::Triangle> triangles;
  for (const Triangle& t : tree.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  model->beginModel();
  model->addSubModel(tree.vertices, triangles);
  model->endModel();
  return model;
}

Shape shape_of(const ConvexShape& body) {
  if (body.is_piece) return surface_of(*body.solid->tree);
  if (body.kind == ConvexShapeKind::box) return std::make_shared<fcl::Boxd>(2.0 * body.half_size_m);
  if (body.kind == ConvexShapeKind::cylinder) {
    return std::make_shared<fcl::Cylinderd>(body.radius_m, 2.0 * body.half_length_m);
  }
  if (body.kind == ConvexShapeKind::hull) {
    auto faces = std::make_shared<std::vector<int>>();
    for (const auto& face : body.hull->hull.faces) {
      faces->push_back(3);
      for (const std::uint32_t i : face) faces->push_back(static_cast<int>(i));
    }
    return std::make_shared<fcl::Convexd>(
        std::make_shared<const std::vector<Eigen::Vector3d>>(body.hull->hull.vertices),
        static_cast<int>(body.hull->hull.faces.size()), std::move(faces));
  }
  if (body.half_length_m == 0.0) return std::make_shared<fcl::Sphered>(body.radius_m);
  return std::make_shared<fcl::Capsuled>(body.radius_m, 2.0 * body.half_length_m);
}

}  // namespace

struct PlainFcl::Shapes {
  std::vector<Shape> of_body;  // nullptr if another piece of the same mesh represents this one
};

PlainFcl::PlainFcl(const PlanningScene::Bodies& bodies)
    : bodies_(bodies), shapes_(std::make_unique<Shapes>()) {
  const Solid* last = nullptr;
  for (const ConvexShape& body : bodies.shapes) {
    const bool known = body.solid.get() == last;
    last = body.solid.get();
    shapes_->of_body.push_back(known ? nullptr : shape_of(body));
    if (!known) shapes_->of_body.back()->computeLocalAABB();
  }
}

PlainFcl::~PlainFcl() = default;

double PlainFcl::distance(std::size_t body_a, const Eigen::Isometry3d& X_WA, std::size_t body_b,
                          const Eigen::Isometry3d& X_WB) const {
  const CollisionBody& a = bodies_.bodies[body_a];
  const CollisionBody& b = bodies_.bodies[body_b];
  double smallest = std::numeric_limits<double>::infinity();
  fcl::DistanceRequestd request;
  request.distance_tolerance = 1e-12;
  const auto pose = [](const ConvexShape& body) {
    return body.is_piece ? body.solid->X_PT : body.X_PS;
  };
  for (std::size_t i = a.shapes_begin; i < a.shapes_end; ++i) {
    for (std::size_t j = b.shapes_begin; j < b.shapes_end; ++j) {
      if (!shapes_->of_body[i] || !shapes_->of_body[j]) continue;
      fcl::DistanceResultd result;
      try {
        const double distance = fcl::distance<double>(
            shapes_->of_body[i].get(), X_WA * pose(bodies_.shapes[i]), shapes_->of_body[j].get(),
            X_WB * pose(bodies_.shapes[j]), request, result);
        smallest = std::min(smallest, distance);
      } catch (const std::exception&) {
        smallest = std::min(smallest, 0.0);
      }
    }
  }
  return smallest;
}

}  // namespace armloom::soundness
