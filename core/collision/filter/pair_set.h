#pragma once

#include <cstdint>
#include <vector>

#include "core/collision/filter/arm_kinematics.h"
#include "core/collision/scene/scene_bodies.h"

namespace armloom {

// The bodies of a pair of capsules; they must not come closer than limit_m.
struct NarrowPair {
  PairId pair;  // in PlanningScene::Bodies::pairs
  int body_a;   // in the kinematics of the first side
  int body_b;   // in that of the second side
  double limit_m;
};

// The pairs of one comparison, for the broad phase and the narrow phase. Entry i of `pairs` belongs
// to narrow[i], entry i of `boxes` to narrow_boxes[i].
struct PairSet {
  std::vector<filter::Pair> pairs;
  std::vector<NarrowPair> narrow;
  std::vector<filter::BoxPair> boxes;
  std::vector<NarrowPair> narrow_boxes;
  std::vector<filter::Group> groups;  // of pairs: by the first side's capsules, or ...
  bool groups_of_second = false;      // ... by the second side's
  std::vector<filter::Group> others;  // filter::Groups::others
  float limit_up = 0.0F;              // largest limit of pairs

  [[nodiscard]] bool empty() const { return pairs.empty() && boxes.empty(); }
  // For the broad phase: balls may skip whole groups, or every pair is compared.
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

// Returns the pairs to check, with the cell's limits: of two arms (the first has the smaller id),
// an arm and static bodies, or an arm and itself (a and b are the same). Rows in motion_bound: one
// per capsule; for an arm and itself those of its kinematics, without the motion that both capsules
// share.
[[nodiscard]] PairSet pairs_between(const PlanningScene::Bodies& bodies, const ArmKinematics& a,
                                    const ArmKinematics& b);
}  // namespace armloom
