#pragma once

#include <cstdint>
#include <vector>

#include "core/collision/collision_checker.h"
#include "core/collision/linkage.h"
#include "core/collision/scene_bodies.h"

namespace armloom {

// Everything that stands still in the world, as the kernels want it: static links and objects.
struct StillParts {
  explicit StillParts(const PlanningScene::Bodies& bodies);

  std::vector<LinkagePart> parts;  // by place in `parts`; frame -1
  std::vector<filter::Capsule> capsules;
  std::vector<float> lanes;        // [capsule][6][kLanes], the same in all lanes
  std::vector<float> at_rest;      // [capsule][kLanes]: zeros
  std::vector<PlacedBody> placed;  // by body of the scene; those of still parts are filled
  double extent_m = 0.0;
};

// What stands behind a pair of capsules: two parts that must not come closer than limit_m.
struct NarrowPair {
  PairId pair;  // in PlanningScene::Bodies::pairs
  int part_a;   // in the linkage of the first side
  int part_b;   // in the linkage of the second side, or in StillParts
  double limit_m;
};

// The pairs of one comparison, for the filter and for what comes behind it. Entry i of `pairs`
// belongs to narrow[i], entry i of `boxes` to narrow_boxes[i].
struct PairSet {
  std::vector<filter::Pair> pairs;
  std::vector<NarrowPair> narrow;
  std::vector<filter::BoxPair> boxes;
  std::vector<NarrowPair> narrow_boxes;
  std::vector<filter::Group> groups;  // of pairs: by the first side's capsules, or ...
  bool groups_of_second = false;      // ... by the second side's
  std::vector<filter::Group> others;  // filter::Groups::others
  float limit_up = 0.0F;              // the largest of pairs

  [[nodiscard]] bool empty() const { return pairs.empty() && boxes.empty(); }
  [[nodiscard]] filter::Groups grouped() const;
  // To be called when pairs have got other limits.
  void limits_changed();
};

// Limits: those of the cell for the pairs' groups (PairGroup::limit_m). Rows of the sides'
// inflation arrays: one for each capsule (cross_pairs, still_pairs), or those of the linkage's
// motion bounds (self_pairs), where what both capsules share does not count.
[[nodiscard]] PairSet cross_pairs(const PlanningScene::Bodies& bodies, const Linkage& a,
                                  const Linkage& b);
[[nodiscard]] PairSet self_pairs(const PlanningScene::Bodies& bodies, const Linkage& arm);
[[nodiscard]] PairSet still_pairs(const PlanningScene::Bodies& bodies, const Linkage& arm,
                                  const StillParts& still);

// What every pair of different arms, and of an arm and what stands still, is held to; at most
// `most_m`.
[[nodiscard]] double least_limit_m(const PlanningScene::Bodies& bodies, const PairSet& set,
                                   double most_m);

}  // namespace armloom
