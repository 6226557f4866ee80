#include "test/soundness/concave_meshes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "core/geometry/mesh/convex_pieces.h"

namespace armloom::soundness {
namespace {

using Index3 = std::array<int, 3>;

// The full blocks of a grid.
struct Blocks {
  Index3 count;
  std::vector<bool> full;

  [[nodiscard]] bool at(const Index3& i) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (i[k] < 0 || i[k] >= count[k]) return false;
    }
    return full[static_cast<std::size_t>((i[2] * count[1] + i[1]) * count[0] + i[0])];
  }
};

template <class Full>
Blocks blocks(const Index3& count, const Full& is_full) {
  Blocks made{count, {}};
  for (int z = 0; z < count[2]; ++z) {
    for (int y = 0; y < count[1]; ++y) {
      for (int x = 0; x < count[0]; ++x) made.full.push_back(is_full(x, y, z));
    }
  }
  return made;
}

Blocks random_blocks(std::mt19937_64& random) {
  switch (random() % 8) {
    case 0:  // L
      return blocks({3, 3, 2}, [](int x, int y, int) { return x == 0 || y == 0; });
    case 1:  // U
      return blocks({3, 3, 1}, [](int x, int y, int) { return x != 1 || y == 0; });
    case 2:  // C
      return blocks({3, 5, 2}, [](int x, int y, int) { return x == 0 || y == 0 || y == 4; });
    case 3:  // ring
      return blocks({3, 3, 1}, [](int x, int y, int) { return x != 1 || y != 1; });
    case 4:  // box with a slot
      return blocks({5, 3, 3}, [](int x, int y, int) { return x != 2 || y == 0; });
    case 5:  // hollow
      return blocks({3, 3, 3}, [](int x, int y, int z) { return x != 1 || y != 1 || z != 1; });
    case 6:  // frame of a box: bars along its edges
      return blocks({3, 3, 3}, [](int x, int y, int z) {
        return (x != 1 ? 1 : 0) + (y != 1 ? 1 : 0) + (z != 1 ? 1 : 0) >= 2;
      });
    default: {
      const auto side = [&] { return 2 + static_cast<int>(random() % 3); };
      const Index3 count{side(), side(), side()};
      Blocks made = blocks(count, [&](int, int, int) { return random() % 2 == 0; });
      made.full.front() = true;
      return made;
    }
  }
}

class Surfacer {
 public:
  Surfacer(const Blocks& made, std::mt19937_64& random) : blocks_(made) {
    for (std::size_t k = 0; k < 3; ++k) {
      double at = 0.0;
      for (int i = 0; i <= made.count[k]; ++i) {
        planes_[k].push_back(at);
        at += between(random, 0.3, 1.0);
      }
    }
  }

  // Adds two triangles for each free side of a block, consistently oriented.
  void fill(MeshData& mesh) {
    for (int z = 0; z < blocks_.count[2]; ++z) {
      for (int y = 0; y < blocks_.count[1]; ++y) {
        for (int x = 0; x < blocks_.count[0]; ++x) {
          if (!blocks_.at({x, y, z})) continue;
          for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const int side : {0, 1}) add_side(mesh, {x, y, z}, axis, side);
          }
        }
      }
    }
  }

 private:
  void add_side(MeshData& mesh, const Index3& block, std::size_t axis, int side) {
    Index3 beside = block;
    beside[axis] += side == 1 ? 1 : -1;
    if (blocks_.at(beside)) return;
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    std::array<std::uint32_t, 4> corner{};
    for (std::size_t i = 0; i < 4; ++i) {
      Index3 at = block;
      at[axis] += side;
      at[u] += i == 1 || i == 2 ? 1 : 0;
      at[v] += i >= 2 ? 1 : 0;
      corner[i] = vertex(mesh, at);
    }
    if (side == 0) std::swap(corner[1], corner[3]);
    mesh.triangles.push_back({corner[0], corner[1], corner[2]});
    mesh.triangles.push_back({corner[0], corner[2], corner[3]});
  }

  std::uint32_t vertex(MeshData& mesh, const Index3& at) {
    const auto next = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto [known, fresh] = known_.try_emplace(at, next);
    if (fresh) {
      mesh.vertices.emplace_back(planes_[0][static_cast<std::size_t>(at[0])],
                                 planes_[1][static_cast<std::size_t>(at[1])],
                                 planes_[2][static_cast<std::size_t>(at[2])]);
    }
    return known->second;
  }

  const Blocks& blocks_;
  std::array<std::vector<double>, 3> planes_;
  std::map<Index3, std::uint32_t> known_;
};

void scale(MeshData& mesh, const MeshWish& wish, std::mt19937_64& random) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh.vertices) box.extend(p);
  const double factor = wish.size_m / box.diagonal().norm();
  for (Eigen::Vector3d& p : mesh.vertices) {
    // Blocks are at least 0.3 long, so the order of corners is kept.
    const auto moved = [&] { return 0.3 * wish.noise * between(random, -1.0, 1.0); };
    const Eigen::Vector3d noise(moved(), moved(), moved());
    p = factor * (p - box.center() + noise);
  }
}

}  // namespace

MeshPtr concave_mesh(const MeshWish& wish, std::mt19937_64& random) {
  auto mesh = std::make_shared<MeshData>();
  const Blocks made = random_blocks(random);
  Surfacer(made, random).fill(*mesh);
  scale(*mesh, wish, random);
  if (wish.crumbs) {
    MeshData crumb;
    const Blocks one = blocks({1, 1, 1}, [](int, int, int) { return true; });
    Surfacer(one, random).fill(crumb);
    scale(crumb, {0.1 * wish.size_m, 0.0, false}, random);
    const auto first = static_cast<std::uint32_t>(mesh->vertices.size());
    for (const Eigen::Vector3d& p : crumb.vertices) {
      mesh->vertices.emplace_back(p + Eigen::Vector3d(0.6 * wish.size_m, 0, 0));
    }
    for (const Triangle& t : crumb.triangles) {
      mesh->triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
  }
  mesh->hull = convex_hull(mesh->vertices).value();
  mesh->pieces = convex_pieces(*mesh);
  if (!is_closed(mesh->triangles)) throw std::logic_error("a mesh of blocks is not closed");
  mesh->surface = make_surface_tree(mesh->vertices, mesh->triangles);
  return mesh;
}

MeshPtr twice_wound_mesh() {
  constexpr std::uint32_t kPoints = 48;
  auto mesh = std::make_shared<MeshData>();
  for (const double z : {-0.2, 0.2}) {
    for (std::uint32_t i = 0; i < kPoints; ++i) {
      const double angle = 4.0 * std::numbers::pi * i / kPoints;
      const double radius = 0.2 * (1.0 + 0.35 * std::cos(0.5 * angle));
      mesh->vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
    mesh->vertices.emplace_back(0.0, 0.0, z);
  }
  constexpr std::uint32_t kTop = kPoints + 1;
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    const std::uint32_t next = (i + 1) % kPoints;
    mesh->triangles.push_back({i, next, kTop + next});
    mesh->triangles.push_back({i, kTop + next, kTop + i});
    mesh->triangles.push_back({kPoints, next, i});
    mesh->triangles.push_back({kTop + kPoints, kTop + i, kTop + next});
  }
  if (!is_closed(mesh->triangles)) throw std::logic_error("the prism is not closed");
  mesh->surface = make_surface_tree(mesh->vertices, mesh->triangles);
  return mesh;
}

MeshPtr turned_over(const MeshData& mesh, std::mt19937_64& random) {
  auto turned = std::make_shared<MeshData>(mesh);
  for (Triangle& t : turned->triangles) {
    if (random() % 4 == 0) std::swap(t[0], t[1]);
  }
  turned->pieces = convex_pieces(*turned);
  turned->surface = make_surface_tree(turned->vertices, turned->triangles);
  return turned;
}

std::vector<std::uint32_t> components_of(const MeshData& mesh) {
  std::vector<std::uint32_t> components(mesh.vertices.size());
  std::iota(components.begin(), components.end(), std::uint32_t{0});
  for (bool changed = true; changed;) {  // spreads the smallest vertex number
    changed = false;
    for (const Triangle& t : mesh.triangles) {
      const auto least = std::min({components[t[0]], components[t[1]], components[t[2]]});
      for (const std::uint32_t i : t) {
        changed = changed || components[i] != least;
        components[i] = least;
      }
    }
  }
  return components;
}

bool winds_about(const MeshData& mesh, const std::vector<std::uint32_t>& components,
                 const Eigen::Vector3d& p) {
  std::map<std::uint32_t, double> angle;
  for (const Triangle& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[t[0]] - p;
    const Eigen::Vector3d b = mesh.vertices[t[1]] - p;
    const Eigen::Vector3d c = mesh.vertices[t[2]] - p;
    // van Oosterom and Strackee 1983
    const double denominator = a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                               b.dot(c) * a.norm() + c.dot(a) * b.norm();
    angle[components[t[0]]] += 2.0 * std::atan2(a.dot(b.cross(c)), denominator);
  }
  return std::ranges::any_of(
      angle, [](const auto& sum) { return std::abs(sum.second) > 2.0 * std::numbers::pi; });
}

double between(std::mt19937_64& random, double from, double to) {
  return from + (to - from) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

}  // namespace armloom::soundness
