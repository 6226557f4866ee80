#include "core/geometry/mesh/surface_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace armloom {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

float rounded_up(double x) {
  const auto near = static_cast<float>(x);
  if (static_cast<double>(near) >= x) return near;
  return std::nextafter(near, std::numeric_limits<float>::infinity());
}

// A triangle, or the part of a long triangle in `box`. A box around a whole long triangle would be
// mostly empty.
struct Share {
  std::uint32_t triangle;
  Eigen::AlignedBox3d box;
};

constexpr double kShare = 1.0 / 16.0;  // of the extent: larger triangles are divided
constexpr double kRounding = 1e-12;    // of the extent: boxes of shares are enlarged by this

constexpr float kNoBox_m = -1e18F;  // half extent of an unused box

const SurfaceTree::Box kNoBox{Eigen::Vector3f::Zero(), Eigen::Vector3f::Constant(kNoBox_m), 0,
                              true};

class Builder {
 public:
  Builder(SurfaceTree& tree, bool are_divided) : tree_(tree) {
    Eigen::AlignedBox3d all;
    for (const Eigen::Vector3d& p : tree.vertices) all.extend(p);
    const double extent_m = all.sizes().maxCoeff();
    largest_m_ = are_divided ? kShare * extent_m : extent_m;
    rounding_m_ = kRounding * (extent_m + all.center().norm());
    for (std::uint32_t t = 0; t < tree.triangles.size(); ++t) {
      const auto corners = tree.corners(t);
      share_out(t, {corners.begin(), corners.end()});
    }
  }

  void build() {
    tree_.nodes.reserve(shares_.size());
    tree_.root = box_of(0, shares_.size());
  }

 private:
  // Adds shares for a part of a triangle: halves the polygon until it is small or fills its box
  // well.
  void share_out(std::uint32_t triangle, const std::vector<Eigen::Vector3d>& polygon) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& p : polygon) box.extend(p);
    Eigen::Index axis = 0;
    const Eigen::Vector3d sizes = box.sizes();
    const double longest_m = sizes.maxCoeff(&axis);
    const double across_m = sizes.sum() - longest_m;
    if (longest_m <= largest_m_ || across_m <= 1e-3 * longest_m || polygon.size() < 3) {
      box.extend(box.min() - Eigen::Vector3d::Constant(rounding_m_));
      box.extend(box.max() + Eigen::Vector3d::Constant(rounding_m_));
      shares_.push_back({triangle, box});
      return;
    }
    for (const double side : {-1.0, 1.0}) {
      const auto part = clipped(polygon, axis, box.center()[axis], side);
      if (!part.empty()) share_out(triangle, part);
    }
  }

  static std::vector<Eigen::Vector3d> clipped(const std::vector<Eigen::Vector3d>& polygon,
                                              Eigen::Index axis, double at, double side) {
    std::vector<Eigen::Vector3d> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Eigen::Vector3d& p = polygon[i];
      const Eigen::Vector3d& next = polygon[(i + 1) % polygon.size()];
      const double d = side * (p[axis] - at);
      const double d_next = side * (next[axis] - at);
      if (d >= 0.0) kept.push_back(p);
      if ((d > 0.0 && d_next < 0.0) || (d < 0.0 && d_next > 0.0)) {
        kept.emplace_back(p + d / (d - d_next) * (next - p));
        kept.back()[axis] = at;
      }
    }
    return kept;
  }

  SurfaceTree::Box box_of(std::size_t begin, std::size_t end) {
    SurfaceTree::Box box = bound(begin, end);
    box.leaf = end - begin == 1;
    box.below = box.leaf ? shares_[begin].triangle : add_node(begin, end);
    return box;
  }

  std::uint32_t add_node(std::size_t begin, std::size_t end) {
    const auto index = static_cast<std::uint32_t>(tree_.nodes.size());
    tree_.nodes.emplace_back();
    const std::size_t middle = halve(begin, end);
    const std::array<std::size_t, 5> limits{begin, halve(begin, middle), middle, halve(middle, end),
                                            end};
    SurfaceTree::Node node;
    for (std::size_t i = 0; i < 4; ++i) {
      const bool none = limits[i] == limits[i + 1];
      const SurfaceTree::Box box = none ? kNoBox : box_of(limits[i], limits[i + 1]);
      const auto k = static_cast<Eigen::Index>(i);
      for (std::size_t j = 0; j < 3; ++j) {
        node.center[j][k] = box.center[static_cast<Eigen::Index>(j)];
        node.half[j][k] = box.half[static_cast<Eigen::Index>(j)];
      }
      node.below[i] = box.below;
      node.leaf[i] = box.leaf;
    }
    tree_.nodes[index] = node;
    return index;
  }

  // Sorts the shares into a lower and an upper half, and returns the start of the upper half. A
  // single share is in the upper half.
  std::size_t halve(std::size_t begin, std::size_t end) {
    Eigen::AlignedBox3d middles;
    for (std::size_t i = begin; i < end; ++i) middles.extend(shares_[i].box.center());
    Eigen::Index axis = 0;
    middles.sizes().maxCoeff(&axis);
    const std::size_t half = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return shares_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(half), at(end), [&](const Share& s, const Share& t) {
      return std::pair(s.box.center()[axis], s.triangle) <
             std::pair(t.box.center()[axis], t.triangle);
    });
    return half;
  }

  [[nodiscard]] SurfaceTree::Box bound(std::size_t begin, std::size_t end) const {
    Eigen::AlignedBox3d all;
    for (std::size_t i = begin; i < end; ++i) all.extend(shares_[i].box);
    SurfaceTree::Box box = kNoBox;
    box.center = all.center().cast<float>();
    const Eigen::Vector3d middle = box.center.cast<double>();
    const Eigen::Vector3d half = (all.max() - middle).cwiseMax(middle - all.min());
    box.half = half.unaryExpr([](double x) { return rounded_up(x); });
    return box;
  }

  SurfaceTree& tree_;
  std::vector<Share> shares_;
  double largest_m_;
  double rounding_m_;
};

std::uint32_t root_of(std::vector<std::uint32_t>& above, std::uint32_t i) {
  while (above[i] != i) i = above[i] = above[above[i]];
  return i;
}

// Returns the edges of all triangles, sorted. A triangle with a repeated corner has the same edge
// in both directions, so that this edge is not open.
std::vector<Edge> sorted_edges(const std::vector<Triangle>& triangles, bool directed) {
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Edge edge{t[i], t[(i + 1) % 3]};
      if (edge.first == edge.second) continue;
      edges.push_back(directed ? edge : Edge(std::minmax(edge.first, edge.second)));
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

std::size_t count_of(const std::vector<Edge>& edges, const Edge& edge) {
  const auto [from, to] = std::equal_range(edges.begin(), edges.end(), edge);
  return static_cast<std::size_t>(to - from);
}

void find_components(SurfaceTree& tree) {
  std::vector<std::uint32_t> above(tree.vertices.size());
  std::iota(above.begin(), above.end(), std::uint32_t{0});
  for (const Triangle& t : tree.triangles) {
    above[root_of(above, t[0])] = root_of(above, t[1]);
    above[root_of(above, t[1])] = root_of(above, t[2]);
  }
  constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(tree.vertices.size(), kNone);
  const std::vector<Edge> edges = sorted_edges(tree.triangles, true);
  for (const Triangle& t : tree.triangles) {
    std::uint32_t& component = number[root_of(above, t[0])];
    if (component == kNone) {
      component = static_cast<std::uint32_t>(tree.components.size());
      tree.components.push_back({t[0], true});
    }
    tree.component_of.push_back(component);
    for (std::size_t i = 0; i < 3; ++i) {
      const Edge edge{t[i], t[(i + 1) % 3]};
      if (count_of(edges, edge) == count_of(edges, {edge.second, edge.first})) continue;
      tree.components[component].oriented = false;
    }
  }
}

}  // namespace

std::size_t open_edges(const std::vector<Triangle>& triangles) {
  const std::vector<Edge> edges = sorted_edges(triangles, false);
  std::size_t open = 0;
  for (auto at = edges.begin(); at != edges.end();) {
    const auto end = std::find_if(at, edges.end(), [&](const Edge& e) { return e != *at; });
    open += static_cast<std::size_t>(end - at) % 2;
    at = end;
  }
  return open;
}

bool is_closed(const std::vector<Triangle>& triangles) { return open_edges(triangles) == 0; }

SurfaceTreePtr make_surface_tree(std::vector<Eigen::Vector3d> vertices,
                                 std::vector<Triangle> triangles, bool are_divided) {
  auto tree = std::make_shared<SurfaceTree>();
  tree->vertices = std::move(vertices);
  tree->triangles = std::move(triangles);
  Builder(*tree, are_divided).build();
  find_components(*tree);
  tree->encloses = tree->triangles.size() >= 4 && is_closed(tree->triangles);
  for (const Eigen::Vector3d& p : tree->vertices) tree->reach_m = std::max(tree->reach_m, p.norm());
  return tree;
}

}  // namespace armloom
