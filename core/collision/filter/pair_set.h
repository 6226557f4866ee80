#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/collision/filter/arm_kinematics.h"
#include "core/collision/scene/scene_bodies.h"

namespace armloom {

// The two bodies of a pair of capsules. They must keep a distance of limit_m.
struct NarrowPair {
  PairId pair;  // index in PlanningScene::Bodies::pairs
  int body_a;   // index in ArmKinematics::bodies() of the first side
  int body_b;   // index in ArmKinematics::bodies() of the second side
  double limit_m;
};

// A static box, with the pairs of capsules that StaticBox::begin and end name.
struct NarrowBox {
  std::size_t group;  // index in PlanningScene::Bodies::groups
  int body_b;         // index in ArmKinematics::bodies() of the second side
  double limit_m;
};

// The pairs of one comparison of two sides. The filter (broad phase) compares `pairs` and `boxes`;
// exact distances (narrow phase) are computed for `narrow` and narrow_of(). Entry i of `pairs`
// belongs to narrow[i], entry i of `boxes` to narrow_boxes[i]. A static box is one entry for all
// capsules, so that thousands of boxes are cheap to keep and to skip.
struct PairSet {
  const PlanningScene::Bodies* bodies = nullptr;  // outlives this object
  std::vector<filter::Pair> pairs;
  std::vector<NarrowPair> narrow;
  std::vector<filter::StaticBox> boxes;
  std::vector<NarrowBox> narrow_boxes;
  std::vector<filter::BoxedCapsule> boxed;
  std::vector<int> body_of_boxed;  // by entry of `boxed`: as NarrowPair::body_a
  // A row for each entry of `boxes`: by NarrowPair::body_a, the pair with the box.
  std::vector<PairId> pairs_of_boxes;
  std::size_t bodies_of_first = 0;    // length of a row
  std::vector<filter::Group> groups;  // `pairs`, grouped by a capsule of one side
  bool groups_of_second = false;      // that side is the second
  std::vector<filter::Group> others;  // see filter::Groups::others
  float limit_up = 0.0F;              // largest limit of `pairs`

  [[nodiscard]] bool empty() const { return pairs.empty() && boxes.empty(); }
  // Returns the largest number of hits that the filter can find.
  [[nodiscard]] std::size_t hits_max() const { return std::max(pairs.size(), box_hits_max()); }
  [[nodiscard]] std::size_t box_hits_max() const;
  [[nodiscard]] filter::Boxes all_boxes() const {
    return {boxes.data(), static_cast<int>(boxes.size()), boxed.data()};
  }
  [[nodiscard]] NarrowPair narrow_of(int box, int boxed_capsule) const;
  // Calls visit(pair) for each capsule of each static box, in the order of `boxes`.
  template <class Visit>
  void each_boxed(const Visit& visit) const {
    for (int b = 0; b < static_cast<int>(boxes.size()); ++b) {
      const filter::StaticBox& box = boxes[static_cast<std::size_t>(b)];
      for (int c = box.begin; c < box.end; ++c) visit(narrow_of(b, c));
    }
  }
  // Return the pairs for the filter. With grouped(), the filter may skip whole groups; with
  // ungrouped(), it compares every pair.
  [[nodiscard]] filter::Pairs grouped() const;
  [[nodiscard]] filter::Pairs ungrouped() const;
  // Sets the limit of each pair to that of its group.
  void set_limits(const PairLimits& limits);
  // Sets the limit of each pair to limit_m(pair). Boxes whose pairs have different limits become
  // several entries.
  void set_each_limit(const std::function<double(const NarrowPair&)>& limit_m);
  void limits_changed();
};

// Returns the pairs to check between two sides, with the cell's limits. The sides are
// - two arms, the first with the smaller id,
// - an arm and the static bodies, or
// - an arm and itself (a and b are the same).
// Side::motion_bound must have one row per capsule. For an arm and itself, it must have the rows of
// filter::MotionBounds; each pair uses rows without the motion that both capsules share.
[[nodiscard]] PairSet pairs_between(const PlanningScene::Bodies& bodies, const ArmKinematics& a,
                                    const ArmKinematics& b);
}  // namespace armloom
