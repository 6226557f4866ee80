#include <cmath>
#include <cstdlib>

#include "test/geometry/mesh_file.h"

namespace armloom {
namespace {

TEST(ConvexHullOf, ContainsEveryPointAndIsClosed) {
  std::srand(7);
  for (const int count : {4, 50, 3000, 20000}) {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector3d p = Eigen::Vector3d::Random();
      points.push_back(count == 20000 ? p.normalized() : p);  // on a sphere
    }
    const ConvexHull hull = convex_hull(points).value();
    EXPECT_LE(hull.vertices.size(), kMaxHullVertices) << count;
    EXPECT_EQ(hull.faces.size(), 2 * hull.vertices.size() - 4) << "Euler, " << count;
    for (const Triangle& face : hull.faces) {
      const Eigen::Vector3d& a = hull.vertices[face[0]];
      const Eigen::Vector3d n = (hull.vertices[face[1]] - a).cross(hull.vertices[face[2]] - a);
      if (n.norm() < 1e-9) continue;  // a sliver has no plane
      for (const Eigen::Vector3d& p : points)
        ASSERT_LE(n.normalized().dot(p - a), kHullTolerance_m);
    }
    if (count == 20000) {
      for (const Eigen::Vector3d& p : hull.vertices) EXPECT_LT(p.norm(), 1.035);
    }
  }
}

TEST(ConvexHullOf, TurnsAFlatSheetIntoAThinPlate) {
  const Eigen::Vector3d normal = Eigen::Vector3d(1, 2, 3).normalized();
  std::vector<Eigen::Vector3d> sheet;
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d p(std::cos(i), std::sin(i), 0);
    sheet.push_back(Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), normal) * p);
  }
  for (const auto& points :
       {sheet, std::vector<Eigen::Vector3d>(3, kOne), {kOne, 2 * kOne, 3 * kOne}}) {
    const ConvexHull hull = convex_hull(points).value();
    EXPECT_GT(volume(hull.vertices, hull.faces), 0.0);
    for (const Eigen::Vector3d& p : hull.vertices) {
      double nearest = 1e9;
      for (const Eigen::Vector3d& point : points) nearest = std::min(nearest, (p - point).norm());
      EXPECT_LT(nearest, kFlat_m);
    }
  }
}

}  // namespace
}  // namespace armloom
