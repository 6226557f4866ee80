#include "core/collision/diagram/passing_edges.h"

#include <algorithm>
#include <tuple>

#include "core/base/disjoint_sets.h"

namespace armloom {
namespace {

// Leaves that touch are one component. Given by from_a.
DisjointSets components_of(const std::vector<OpenLeaf>& leaves) {
  DisjointSets components;
  for (std::size_t i = 0; i < leaves.size(); ++i) components.add();
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const ProgressBox& box = leaves[i].box;
    for (std::size_t j = i + 1; j < leaves.size() && leaves[j].box.from_a <= box.to_a; ++j) {
      const ProgressBox& other = leaves[j].box;
      if (other.from_b <= box.to_b && box.from_b <= other.to_b) components.join(i, j);
    }
  }
  return components;
}

// A leaf as it looks where A passes first; for the other side with A and B exchanged.
struct Corner {
  std::size_t component;
  Duration far;     // to_a
  Duration near;    // from_b
  Duration middle;  // of the leaf: far - near
  bool at_rim;
  std::size_t leaf;
};

// What a path by the clock has to keep clear of for certain: the largest far - near that is proven.
Duration certain_of(const std::vector<Corner>& of, std::size_t begin, std::size_t end,
                    const std::vector<OpenLeaf>& leaves) {
  Duration certain = Duration::min() / 4;
  for (std::size_t i = begin; i < end; ++i) {
    const OpenLeaf& leaf = leaves[of[i].leaf];
    if (!leaf.refinable) certain = std::max(certain, of[i].far - of[i].near);
    if (leaf.refinable && leaf.proven) certain = std::max(certain, of[i].middle);
  }
  return certain;
}

// allowed[leaf]: how wide it may be on this side; untouched where it does not matter.
void judge_side(std::vector<Corner> corners, const std::vector<OpenLeaf>& leaves,
                const PassingResolution& resolution, std::vector<Duration>& allowed) {
  std::ranges::sort(corners, [](const Corner& x, const Corner& y) {
    return std::tuple(x.component, -x.far, x.near, x.leaf) <
           std::tuple(y.component, -y.far, y.near, y.leaf);
  });
  for (std::size_t begin = 0, end = 0; begin < corners.size(); begin = end) {
    while (end < corners.size() && corners[end].component == corners[begin].component) ++end;
    const Duration certain = certain_of(corners, begin, end, leaves);
    Duration nearest = Duration::max();
    for (std::size_t i = begin; i < end; ++i) {
      const Corner& corner = corners[i];
      if (corner.near >= nearest) continue;  // another one is farther out
      nearest = corner.near;
      const double behind_s = to_seconds(certain - (corner.far - corner.near));
      const Duration wider = from_seconds(resolution.slope * std::max(0.0, behind_s));
      allowed[corner.leaf] =
          corner.at_rim ? resolution.fine : std::clamp(wider, resolution.fine, resolution.coarse);
    }
  }
}

}  // namespace

std::vector<CoarseLeaf> coarse_leaves(std::vector<OpenLeaf> leaves, const ProgressBox& remaining,
                                      const PassingResolution& resolution) {
  std::ranges::sort(leaves, [](const OpenLeaf& x, const OpenLeaf& y) {
    return std::tuple(x.box.from_a, x.box.from_b, x.cell) <
           std::tuple(y.box.from_a, y.box.from_b, y.cell);
  });
  DisjointSets components = components_of(leaves);
  std::vector<Corner> a_first, b_first;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const ProgressBox& box = leaves[i].box;
    const std::size_t component = components.root(i);
    const Duration middle = ((box.from_a + box.to_a) - (box.from_b + box.to_b)) / 2;
    a_first.push_back({component, box.to_a, box.from_b, middle,
                       box.to_a >= remaining.to_a || box.from_b <= remaining.from_b, i});
    b_first.push_back({component, box.to_b, box.from_a, -middle,
                       box.to_b >= remaining.to_b || box.from_a <= remaining.from_a, i});
  }
  std::vector<Duration> allowed_a(leaves.size(), Duration::max());
  std::vector<Duration> allowed_b = allowed_a;
  judge_side(std::move(a_first), leaves, resolution, allowed_a);
  judge_side(std::move(b_first), leaves, resolution, allowed_b);
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
