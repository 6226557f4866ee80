#pragma once

#include <gtest/gtest.h>

#include "core/geometry/mesh/mesh.h"
#include "test/geometry/small_meshes.h"
#include "test/model/test_cells.h"

namespace armloom {

inline const Eigen::Vector3d kOne = Eigen::Vector3d::Ones();

class MeshFile : public testing::Test {
 protected:
  MeshPtr load(const std::string& name, const std::string& bytes,
               const Eigen::Vector3d& scale = kOne) {
    auto mesh = load_mesh(folder_.write(name, bytes), scale, "/here", "robot a");
    EXPECT_TRUE(mesh.has_value()) << mesh.error().front().detail;
    return mesh ? *mesh : std::make_shared<const MeshData>();
  }
  Problem refusal(const std::string& path) {
    const auto mesh = load_mesh(path, kOne, "/here", "robot a");
    EXPECT_FALSE(mesh.has_value()) << path;
    return mesh ? Problem{} : mesh.error().front();
  }
  Problem refusal(const std::string& name, const std::string& bytes) {
    return refusal(folder_.write(name, bytes));
  }

  ScratchFolder folder_;
  const small::Surface box_ = small::box_surface({-0.1, -0.2, 0.5}, {0.3, 0.4, 0.75});
};

inline Eigen::AlignedBox3d bounds(const std::vector<Eigen::Vector3d>& points) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : points) box.extend(p);
  return box;
}

inline void expect_bounds(const MeshData& mesh, const Eigen::Vector3d& low,
                          const Eigen::Vector3d& high) {
  EXPECT_LT((bounds(mesh.vertices).min() - low).norm(), 1e-6)
      << bounds(mesh.vertices).min().transpose();
  EXPECT_LT((bounds(mesh.vertices).max() - high).norm(), 1e-6)
      << bounds(mesh.vertices).max().transpose();
}

inline double volume(const std::vector<Eigen::Vector3d>& p,
                     const std::vector<Triangle>& triangles) {
  double six = 0.0;
  for (const Triangle& t : triangles) six += p[t[0]].cross(p[t[1]]).dot(p[t[2]]);
  return six / 6.0;
}

}  // namespace armloom
