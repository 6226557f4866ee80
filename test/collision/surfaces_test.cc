#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/collision/check/motion_checker.h"
#include "core/collision/scene/scene_bodies.h"
#include "core/collision/state/clearance_query.h"
#include "core/geometry/mesh/convex_pieces.h"
#include "test/collision/scaled_query.h"
#include "test/collision/small_cell.h"
#include "test/geometry/small_meshes.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;

constexpr double kPi = std::numbers::pi;
constexpr double kReach_m = 0.23;  // reach of the arm: 0.2 m long, 0.03 m thick
constexpr int kFacets = 48;

Mesh loaded(const small::Surface& surface) {
  MeshData data;
  data.vertices = surface.vertices;
  data.triangles = surface.triangles;
  data.hull = convex_hull(data.vertices).value();
  data.pieces = convex_pieces(data);
  if (is_closed(data.triangles)) data.surface = make_surface_tree(data.vertices, data.triangles);
  return {"by hand", Eigen::Vector3d::Ones(), std::make_shared<const MeshData>(std::move(data))};
}

// Returns a notch: half a ring about z, open towards +y, with a square back.
small::Surface notch(double inner_m) {
  small::Surface surface;
  for (int i = 0; i <= kFacets; ++i) {
    const double angle = kPi + kPi * i / kFacets;
    const double x = inner_m * std::cos(angle);
    const double y = i == 0 || i == kFacets ? 0.0 : inner_m * std::sin(angle);
    for (const double z : {-0.1, 0.1}) {
      surface.vertices.emplace_back(x, y, z);
      surface.vertices.emplace_back(x, -0.5, z);
    }
  }
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    surface.triangles.push_back({a, b, c});
    surface.triangles.push_back({a, c, d});
  };
  for (std::uint32_t i = 0; i < kFacets; ++i) {
    const std::uint32_t a = 4 * i;  // front low, back low, front high, back high
    const std::uint32_t b = a + 4;
    quad(a, b, b + 2, a + 2);
    quad(a + 1, a + 3, b + 3, b + 1);
    quad(a, a + 1, b + 1, b);
    quad(a + 2, b + 2, b + 3, a + 3);
  }
  quad(0, 2, 3, 1);
  const std::uint32_t end = 4 * kFacets;
  quad(end, end + 1, end + 3, end + 2);
  return surface;
}

// One arm that turns in the notch, gap_m from the wall.
struct InNotch {
  explicit InNotch(double gap_m, bool open = false) {
    cell.clearances.clearance_m = 0.008;
    small::add_robot(cell, "a", small::at_xyz(0, 0, 0), {Eigen::Vector3d::UnitZ()}, {0.2, 0.03});
    small::Surface surface = notch((kReach_m + gap_m) / std::cos(kPi / 2 / kFacets));
    if (open) surface.triangles.pop_back();
    cell.objects.push_back({"body", loaded(surface), Eigen::Isometry3d::Identity()});
    made = small::shared(cell);
    scene = PlanningScene::build(made).value();
  }
  Configuration q(double angle) const { return Configuration::Constant(1, angle); }
  std::optional<Proximity> closer(double angle) {
    return small::ScaledQuery(scene).first_closer_than(q(angle), cell.clearances.clearance_m,
                                                       {true});
  }
  Verdict sweep() {
    Question question;
    question.start_at = TimePoint{};
    question.rest = q(-0.2);
    question.method = Coordinated{0.0};
    question.candidates = {{StepId{JobId{1}},
                            small::sweep(*made, {ArmId{0}}, {0.6}, {-kPi + 0.2}, 20s),
                            0s}};  // from outside
    return MotionChecker(scene).judge(question);
  }

  Cell cell;
  CellPtr made;
  PlanningScenePtr scene;
};

TEST(MeshSurface, AllowsStatesInWhichOnlyConvexPiecesTouch) {
  InNotch passes(0.012);
  int by_pieces = 0;
  const PlanningScene::Bodies& bodies = passes.scene->bodies();
  const CollisionBody& arm = bodies.bodies[0];
  const CollisionBody& body = bodies.bodies[1];
  ASSERT_GT(body.shapes_end - body.shapes_begin, 1U);
  ClearanceQuery states(passes.scene);
  for (double angle = -0.2; angle > -kPi + 0.2; angle -= 0.05) {
    EXPECT_FALSE(passes.closer(angle)) << angle;
    const Configuration q = passes.q(angle);
    const Configuration* const one[] = {&q};
    EXPECT_EQ(states.too_close(one), 0U) << angle;
    LinkPoses X_WL;
    forward_kinematics(*passes.made, q, X_WL);
    PlacedConvexShape at_arm;
    PlacedConvexShape at_piece;
    place(bodies.shapes[arm.shapes_begin], arm.pose(X_WL), at_arm);
    double least = 1.0;
    for (std::size_t i = body.shapes_begin; i < body.shapes_end; ++i) {
      place(bodies.shapes[i], body.pose(X_WL), at_piece);
      least = distance_below(bodies.shapes[arm.shapes_begin], at_arm, bodies.shapes[i], at_piece,
                             least);
    }
    by_pieces += least < passes.cell.clearances.clearance_m ? 1 : 0;
  }
  EXPECT_GT(by_pieces, 20);  // otherwise this test shows nothing
}

TEST(MeshSurface, ConflictsReportTheSurfaceDistance) {
  InNotch scrapes(0.005);
  ClearanceQuery states(scrapes.scene);
  for (double angle = -0.2; angle > -kPi + 0.2; angle -= 0.05) {
    const auto close = scrapes.closer(angle);
    ASSERT_TRUE(close) << angle;
    EXPECT_EQ(close->body_b, "body");
    EXPECT_NEAR(close->clearance_m, 0.005, 6e-4);  // facets and corners
    const Configuration q = scrapes.q(angle);
    const Configuration* const one[] = {&q};
    EXPECT_EQ(states.too_close(one), 1U) << angle;
  }
  const auto contact = InNotch(-0.002).closer(-1.0);
  ASSERT_TRUE(contact);
  EXPECT_LE(contact->clearance_m, 0.0);
}

TEST(MeshSurface, CertifiesAPassingMotionAndRejectsAScrapingMotion) {
  const Verdict passes = InNotch(0.012).sweep();
  EXPECT_EQ(passes.kind, Verdict::Kind::free)
      << passes.evaluations << " " << passes.exhausted
      << (passes.conflicts.empty() ? 0.0 : passes.conflicts.front().proximity.clearance_m);
  const Verdict scrapes = InNotch(0.005).sweep();
  ASSERT_EQ(scrapes.kind, Verdict::Kind::conflict);
  EXPECT_GT(scrapes.conflicts.front().proximity.clearance_m, 0.005 - 6e-4);
  EXPECT_LT(scrapes.conflicts.front().proximity.clearance_m, 0.008);
}

TEST(MeshSurface, OpenMeshIsReplacedByItsHull) {
  EXPECT_TRUE(InNotch(0.012, true).closer(-1.0));  // its hull
}

TEST(MeshSurface, FindsAnArmInsideTheBody) {
  InNotch passes(0.012);
  passes.cell.objects[0].shape =
      loaded(small::joined(notch(0.05), small::box_surface({-0.3, -1.2, -0.3}, {0.3, -0.6, 0.3})));
  passes.cell.objects[0].X_WO = small::at_xyz(0.1, 0.9, 0);
  const auto scene = PlanningScene::build(small::shared(passes.cell)).value();
  const auto inside = small::ScaledQuery(scene).first_closer_than(passes.q(0.0), 0.008, {true});
  ASSERT_TRUE(inside);
  EXPECT_LE(inside->clearance_m, 0.0);
}

TEST(MeshSurface, OverestimateIncludesTheNotch) {
  const InNotch passes(0.012);
  const CollisionBody& body = passes.scene->bodies().bodies[1];
  EXPECT_GT(body.fitted.overestimate_m, 0.05);  // the notch counts as overestimate
}

}  // namespace
}  // namespace armloom
