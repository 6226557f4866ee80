#include "core/collision/diagram/passing_edges.h"

#include <algorithm>
#include <functional>
#include <tuple>
#include <utility>

#include "core/base/disjoint_sets.h"

namespace armloom {
namespace {

// Joins leaves that touch, by a sweep along A. Leaves do not overlap. So the leaves with the same
// time of A are ordered along B, and binary search finds the neighbors of a new leaf.
class TouchingLeaves {
 public:
  // Precondition: leaves are sorted by from_a, then from_b.
  explicit TouchingLeaves(const std::vector<OpenLeaf>& leaves) : leaves_(leaves) {
    for (std::size_t i = 0; i < leaves.size(); ++i) sets_.add();
    for (std::size_t begin = 0, end = 0; begin < leaves.size(); begin = end) {
      const Duration from = box(begin).from_a;
      std::erase_if(cut_, [&](const Cut& cut) { return cut.to_a < from; });
      for (; end < leaves.size() && box(end).from_a == from; ++end) {
        join_with_cut(end);
        if (end > begin && box(end).from_b <= box(end - 1).to_b) sets_.join(end - 1, end);
      }
      const auto before = static_cast<std::ptrdiff_t>(cut_.size());
      for (std::size_t i = begin; i < end; ++i) cut_.push_back({box(i).from_b, box(i).to_a, i});
      std::ranges::inplace_merge(cut_, cut_.begin() + before, {}, &Cut::from_b);
    }
  }

  [[nodiscard]] std::size_t root(std::size_t leaf) { return sets_.root(leaf); }

 private:
  struct Cut {  // a leaf at the present A
    Duration from_b, to_a;
    std::size_t leaf;
  };
  [[nodiscard]] const ProgressBox& box(std::size_t leaf) const { return leaves_[leaf].box; }
  void join_with_cut(std::size_t leaf) {
    auto other = std::ranges::upper_bound(cut_, box(leaf).to_b, {}, &Cut::from_b);
    while (other != cut_.begin()) {
      --other;
      if (box(other->leaf).to_b < box(leaf).from_b) return;
      sets_.join(other->leaf, leaf);
    }
  }

  const std::vector<OpenLeaf>& leaves_;
  DisjointSets sets_;
  std::vector<Cut> cut_;  // by from_b
};

// Returns for each leaf the index of its component's first leaf. Precondition: leaves are sorted by
// from_a, then from_b.
std::vector<std::size_t> components_of(const std::vector<OpenLeaf>& leaves) {
  TouchingLeaves touching(leaves);
  std::vector<std::size_t> component(leaves.size());
  for (std::size_t i = 0; i < leaves.size(); ++i) component[i] = touching.root(i);
  return component;
}

ProgressBox exchanged(const ProgressBox& box) {
  return {box.from_b, box.to_b, box.from_a, box.to_a};
}

// A leaf's corner where A passes first. With A and B exchanged, its corner where B passes first.
struct Corner {
  Duration far;   // to_a
  Duration near;  // from_b
  bool at_rim;    // at the border of what remains of the motions
  std::size_t leaf;
};

// The outermost corners of a component: no other corner of the component has both a larger far and
// a smaller near. Ascending in far and in near.
struct Staircase {
  std::vector<Corner> corners;
  // The largest far - near that is proven blocked. A path on which neither motion waits must pass
  // outside of it.
  Duration certain = Duration::min() / 4;

  // Adds an outermost corner and removes corners behind it. Of equal corners, keeps the first.
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

// Returns the allowed width of each leaf where A passes first, or Duration::max() if any width is
// allowed. box_of(box) exchanges A and B if B passes first.
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
