#include "core/model/surface_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace armloom {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

// Not smaller than x.
float rounded_up(double x) {
  const auto near = static_cast<float>(x);
  if (static_cast<double>(near) >= x) return near;
  return std::nextafter(near, std::numeric_limits<float>::infinity());
}

class Builder {
 public:
  explicit Builder(SurfaceTree& tree) : tree_(tree), order_(tree.triangles.size()) {
    std::iota(order_.begin(), order_.end(), std::uint32_t{0});
    for (std::uint32_t t = 0; t < order_.size(); ++t) {
      const auto [a, b, c] = tree.corners(t);
      middles_.emplace_back((a + b + c) / 3.0);
    }
  }

  void build() {
    tree_.nodes.reserve(2 * order_.size() - 1);
    tree_.nodes.emplace_back();
    split(0, 0, order_.size());
    std::vector<Triangle> sorted;
    sorted.reserve(order_.size());
    for (const std::uint32_t t : order_) sorted.push_back(tree_.triangles[t]);
    tree_.triangles = std::move(sorted);
  }

 private:
  // Its depth is the logarithm of the number of triangles.
  void split(std::uint32_t node, std::size_t begin, std::size_t end) {
    bound(tree_.nodes[node], begin, end);
    if (end - begin == 1) {
      tree_.nodes[node].leaf = true;
      tree_.nodes[node].first = static_cast<std::uint32_t>(begin);
      return;
    }
    Eigen::AlignedBox3d middles;
    for (std::size_t i = begin; i < end; ++i) middles.extend(middles_[order_[i]]);
    Eigen::Index axis = 0;
    middles.sizes().maxCoeff(&axis);
    const std::size_t half = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(half), at(end), [&](std::uint32_t s, std::uint32_t t) {
      return std::pair(middles_[s][axis], s) < std::pair(middles_[t][axis], t);
    });
    const auto first = static_cast<std::uint32_t>(tree_.nodes.size());
    tree_.nodes[node].leaf = false;
    tree_.nodes[node].first = first;
    tree_.nodes.resize(tree_.nodes.size() + 2);
    split(first, begin, half);
    split(first + 1, half, end);
  }

  void bound(SurfaceTree::Node& node, std::size_t begin, std::size_t end) const {
    Eigen::AlignedBox3d box;
    for (std::size_t i = begin; i < end; ++i) {
      for (const Eigen::Vector3d& p : tree_.corners(order_[i])) box.extend(p);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      node.center[k] = static_cast<float>(box.center()[axis]);
      const auto middle = static_cast<double>(node.center[k]);
      node.half[k] = rounded_up(std::max(box.max()[axis] - middle, middle - box.min()[axis]));
    }
  }

  SurfaceTree& tree_;
  std::vector<std::uint32_t> order_;
  std::vector<Eigen::Vector3d> middles_;
};

std::uint32_t root_of(std::vector<std::uint32_t>& above, std::uint32_t i) {
  while (above[i] != i) i = above[i] = above[above[i]];
  return i;
}

// Of a triangle with a corner twice what is left is one edge there and back: no rim.
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

bool is_closed(const std::vector<Triangle>& triangles) {
  const std::vector<Edge> edges = sorted_edges(triangles, false);
  for (auto at = edges.begin(); at != edges.end();) {
    const auto end = std::find_if(at, edges.end(), [&](const Edge& e) { return e != *at; });
    if ((end - at) % 2 != 0) return false;
    at = end;
  }
  return true;
}

SurfaceTreePtr make_surface_tree(std::vector<Eigen::Vector3d> vertices,
                                 std::vector<Triangle> triangles) {
  auto tree = std::make_shared<SurfaceTree>();
  tree->vertices = std::move(vertices);
  tree->triangles = std::move(triangles);
  Builder(*tree).build();
  find_components(*tree);
  tree->encloses = tree->triangles.size() >= 4 && is_closed(tree->triangles);
  for (const Eigen::Vector3d& p : tree->vertices) tree->reach_m = std::max(tree->reach_m, p.norm());
  return tree;
}

}  // namespace armloom
