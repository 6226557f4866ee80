#pragma once

#include <cstdint>
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

// The pairs of one comparison of two sides. The filter (broad phase) compares `pairs` and `boxes`;
// exact distances (narrow phase) are computed for `narrow` and `narrow_boxes`. Entry i of `pairs`
// belongs to narrow[i], entry i of `boxes` to narrow_boxes[i].
struct PairSet {
  std::vector<filter::Pair> pairs;
  std::vector<NarrowPair> narrow;
  std::vector<filter::BoxPair> boxes;
  std::vector<NarrowPair> narrow_boxes;
  std::vector<filter::Group> groups;  // `pairs`, grouped by a capsule of one side
  bool groups_of_second = false;      // that side is the second
  std::vector<filter::Group> others;  // see filter::Groups::others
  float limit_up = 0.0F;              // largest limit of `pairs`

  [[nodiscard]] bool empty() const { return pairs.empty() && boxes.empty(); }
  // Return the pairs for the filter. With grouped(), the filter may skip whole groups; with
  // ungrouped(), it compares every pair.
  [[nodiscard]] filter::Pairs grouped() const;
  [[nodiscard]] filter::Pairs ungrouped() const;
  // Sets the limit of each pair to limit_m(pair).
  template <class Limit>
  void set_limits(const Limit& limit_m) {
    const auto set_all = [&](auto& entries, std::vector<NarrowPair>& of) {
      for (std::size_t i = 0; i < entries.size(); ++i) {
        of[i].limit_m = limit_m(of[i]);
        entries[i].limit_up = round_up(of[i].limit_m);
      }
    };
    set_all(pairs, narrow);
    set_all(boxes, narrow_boxes);
    limits_changed();
  }
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
