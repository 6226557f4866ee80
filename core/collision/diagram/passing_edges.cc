#include "core/collision/diagram/passing_edges.h"

#include <algorithm>
#include <functional>
#include <tuple>

#include "core/base/disjoint_sets.h"

namespace armloom {
namespace {

// Leaves that touch are one component, named by its first leaf. Given by from_a.
std::vector<std::size_t> components_of(const std::vector<OpenLeaf>& leaves) {
  DisjointSets components;
  for (std::size_t i = 0; i < leaves.size(); ++i) components.add();
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const ProgressBox& box = leaves[i].box;
    for (std::size_t j = i + 1; j < leaves.size() && leaves[j].box.from_a <= box.to_a; ++j) {
      const ProgressBox& other = leaves[j].box;
      if (other.from_b <= box.to_b && box.from_b <= other.to_b) components.join(i, j);
    }
  }
  std::vector<std::size_t> component(leaves.size());
  for (std::size_t i = 0; i < leaves.size(); ++i) component[i] = components.root(i);
  return component;
}

// A and B exchanged.
ProgressBox exchanged(const ProgressBox& box) {
  return {box.from_b, box.to_b, box.from_a, box.to_a};
}

// A leaf as it looks where A passes first; for the other side with A and B exchanged.
struct Corner {
  Duration far;   // to_a
  Duration near;  // from_b
  bool at_rim;
  std::size_t leaf;
};

// Of one component: the corners with nothing of it farther out, far and near ascending.
struct Staircase {
  std::vector<Corner> corners;
  // What a path by the clock has to keep clear of for certain: the largest far - near that is
  // proven.
  Duration certain = Duration::min() / 4;

  // In the order of the leaves: of two alike the first one counts.
  void add(const Corner& corner) {
    const auto at = std::ranges::lower_bound(corners, corner.far, {}, &Corner::far);
    if (at != corners.end() && at->near <= corner.near) return;
    const auto end = at != corners.end() && at->far == corner.far ? at + 1 : at;
    const auto begin =
        std::ranges::lower_bound(corners.begin(), end, corner.near, {}, &Corner::near);
    if (begin == end) {
      corners.insert(end, corner);
    } else {
      *begin = corner;
      corners.erase(begin + 1, end);
    }
  }
};

// How wide each leaf may be on this side; Duration::max(): it does not matter there. box_of(leaf):
// as it looks where A passes first.
template <class BoxOf>
std::vector<Duration> allowed_widths(const std::vector<OpenLeaf>& leaves,
                                     const std::vector<std::size_t>& component, const BoxOf& box_of,
                                     const ProgressBox& remaining,
                                     const PassingResolution& resolution) {
  std::vector<Staircase> staircases(leaves.size());
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const ProgressBox box = box_of(leaves[i].box);
    Staircase& staircase = staircases[component[i]];
    staircase.add(
        {box.to_a, box.from_b, box.to_a >= remaining.to_a || box.from_b <= remaining.from_b, i});
    if (!leaves[i].refinable) {
      staircase.certain = std::max(staircase.certain, box.to_a - box.from_b);
    } else if (leaves[i].proven) {
      const Duration middle = ((box.from_a + box.to_a) - (box.from_b + box.to_b)) / 2;
      staircase.certain = std::max(staircase.certain, middle);
    }
  }
  std::vector<Duration> allowed(leaves.size(), Duration::max());
  for (const Staircase& staircase : staircases) {
    for (const Corner& corner : staircase.corners) {
      const double behind_s = to_seconds(staircase.certain - (corner.far - corner.near));
      const Duration wider = from_seconds(resolution.slope * std::max(0.0, behind_s));
      allowed[corner.leaf] =
          corner.at_rim ? resolution.fine : std::clamp(wider, resolution.fine, resolution.coarse);
    }
  }
  return allowed;
}

}  // namespace

std::vector<CoarseLeaf> coarse_leaves(std::vector<OpenLeaf> leaves, const ProgressBox& remaining,
                                      const PassingResolution& resolution) {
  std::ranges::sort(leaves, [](const OpenLeaf& x, const OpenLeaf& y) {
    return std::tuple(x.box.from_a, x.box.from_b, x.cell) <
           std::tuple(y.box.from_a, y.box.from_b, y.cell);
  });
  const std::vector<std::size_t> component = components_of(leaves);
  const std::vector<Duration> allowed_a =
      allowed_widths(leaves, component, std::identity{}, remaining, resolution);
  const std::vector<Duration> allowed_b =
      allowed_widths(leaves, component, exchanged, exchanged(remaining), resolution);
  std::vector<CoarseLeaf> coarse;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    if (!leaves[i].refinable) continue;
    const ProgressBox& box = leaves[i].box;
    const bool stands = box.from_a <= remaining.from_a && box.from_b <= remaining.from_b;
    const Duration width = std::max(box.to_a - box.from_a, box.to_b - box.from_b);
    const Duration most = stands ? resolution.fine : Duration::max();
    const bool everywhere = width > most;
    const bool a = everywhere || width > allowed_a[i];
    const bool b = everywhere || width > allowed_b[i];
    if (!a && !b) continue;
    coarse.push_back({leaves[i].cell, std::min({allowed_a[i], allowed_b[i], most}), a, b});
  }
  return coarse;
}

}  // namespace armloom
