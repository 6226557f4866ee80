#include "core/collision/pair_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/model/kinematics.h"

namespace armloom {
namespace {

double extent_of(const Eigen::Vector3d& p, const Eigen::Vector3d& half, double radius_m) {
  return p.norm() + half.norm() + radius_m;
}

int index_of(const std::vector<LinkagePart>& parts, std::size_t part) {
  const auto found = std::ranges::find(parts, part, &LinkagePart::part);
  return found == parts.end() ? -1 : static_cast<int>(found - parts.begin());
}

double limit_of(const PlanningScene::Bodies& bodies, const PairGroup& group) {
  return group.limit_m(PairLimits::of(*bodies.cell));
}

// All pairs of capsules of the two parts.
void add_capsules(PairSet& set, const NarrowPair& narrow, const LinkagePart& a,
                  const std::vector<filter::Capsule>& capsules_a, const LinkagePart& b,
                  const std::vector<filter::Capsule>& capsules_b, double margin_m) {
  for (int i = a.capsules_begin; i < a.capsules_end; ++i) {
    for (int j = b.capsules_begin; j < b.capsules_end; ++j) {
      set.pairs.push_back(kernel_pair(i, capsules_a[static_cast<std::size_t>(i)], j,
                                      capsules_b[static_cast<std::size_t>(j)], narrow.limit_m,
                                      margin_m));
      set.narrow.push_back(narrow);
    }
  }
}

void add_boxes(PairSet& set, const NarrowPair& narrow, const LinkagePart& a,
               const std::vector<filter::Capsule>& capsules_a, const Body& box,
               const Eigen::Isometry3d& X_WS, double margin_m) {
  for (int i = a.capsules_begin; i < a.capsules_end; ++i) {
    filter::BoxPair pair{};
    pair.a = pair.row_a = i;
    for (int k = 0; k < 3; ++k) {
      for (int c = 0; c < 3; ++c) pair.R[3 * k + c] = static_cast<float>(X_WS.linear()(c, k));
      pair.center[k] = static_cast<float>(X_WS.translation()[k]);
      pair.half_up[k] = round_up(box.half_size_m[k]);
    }
    pair.limit_up = round_up(narrow.limit_m);
    pair.radius_up =
        round_up(static_cast<double>(capsules_a[static_cast<std::size_t>(i)].radius_up) + margin_m);
    set.boxes.push_back(pair);
    set.narrow_boxes.push_back(narrow);
  }
}

// Calls visit(pair id, part pair, group) for each pair of the groups of this arm that `wanted`
// names.
template <class Visit>
void for_pairs(const PlanningScene::Bodies& bodies, ArmId a, std::optional<ArmId> b,
               const Visit& visit) {
  for (const PairGroup& group : bodies.groups) {
    const bool wanted =
        b ? group.kind == PairGroup::Kind::arms && group.arm == a && group.other == b
          : group.kind != PairGroup::Kind::arms && group.arm == a;
    if (!wanted) continue;
    for (std::size_t i = group.pairs_begin; i < group.pairs_end; ++i) {
      visit(PairId{static_cast<std::uint32_t>(i)}, bodies.pairs[i], group);
    }
  }
}

// Brings the pairs of one capsule of the side that `of_second` names together, as groups.
void group(PairSet& set, const std::vector<filter::Capsule>& capsules, bool of_second,
           double margin_m) {
  const auto capsule_of = [of_second](const filter::Pair& pair) {
    return of_second ? pair.b : pair.a;
  };
  std::vector<std::size_t> order(set.pairs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return capsule_of(set.pairs[i]); });
  const PairSet unsorted = set;
  set.groups.clear();
  set.groups_of_second = of_second;
  for (std::size_t at = 0; at < order.size(); ++at) {
    const filter::Pair& pair = set.pairs[at] = unsorted.pairs[order[at]];
    set.narrow[at] = unsorted.narrow[order[at]];
    const int capsule = capsule_of(pair);
    const int begin = static_cast<int>(at);
    if (set.groups.empty() || set.groups.back().capsule != capsule) {
      const filter::Capsule& own = capsules[static_cast<std::size_t>(capsule)];
      const double size_m = static_cast<double>(own.ball_up) + margin_m + 1e-6;
      set.groups.push_back(
          {capsule, of_second ? pair.row_b : pair.row_a, begin, begin, 0.0F, round_up(size_m)});
    }
    set.groups.back().end = begin + 1;
  }
  set.limits_changed();
}

// The second side's capsules, unless they are too many for the kernel.
void add_others(PairSet& set, const std::vector<filter::Capsule>& capsules, double margin_m) {
  if (capsules.size() > 64) return;
  for (std::size_t c = 0; c < capsules.size(); ++c) {
    const auto capsule = static_cast<int>(c);
    const double size_m = static_cast<double>(capsules[c].ball_up) + margin_m + 1e-6;
    set.others.push_back({capsule, capsule, 0, 0, 0.0F, round_up(size_m)});
  }
  set.limits_changed();
}

}  // namespace

StillParts::StillParts(const PlanningScene::Bodies& bodies) : placed(bodies.bodies.size()) {
  LinkPoses X_WL;
  forward_kinematics(*bodies.cell, bodies.cell->home(), X_WL);
  for (std::size_t i = 0; i < bodies.parts.size(); ++i) {
    const Part& part = bodies.parts[i];
    if (part.arm) continue;
    LinkagePart still{.part = i,
                      .frame = -1,
                      .X_FP = part.pose(X_WL),
                      .capsules_begin = static_cast<int>(capsules.size()),
                      .capsules_end = 0};
    for (const LinkCapsule& capsule : part.capsules) {
      capsules.push_back(kernel_capsule(still.X_FP, capsule.p_PA, capsule.p_PB, capsule.radius_m));
      const Eigen::Vector3d center(capsules.back().center);
      const Eigen::Vector3d half(capsules.back().half);
      extent_m = std::max(extent_m, extent_of(center, half, capsule.radius_m));
      for (const Eigen::Vector3d& v : {center, half}) {
        for (int k = 0; k < 3; ++k) {
          lanes.insert(lanes.end(), filter::kLanes, static_cast<float>(v[k]));
        }
      }
    }
    still.capsules_end = static_cast<int>(capsules.size());
    for (std::size_t b = part.bodies_begin; b < part.bodies_end; ++b) {
      place(bodies.bodies[b], still.X_FP, placed[b]);
    }
    parts.push_back(still);
  }
  at_rest.assign(capsules.size() * filter::kLanes, 0.0F);
}

PairSet cross_pairs(const PlanningScene::Bodies& bodies, const Linkage& a, const Linkage& b) {
  const bool turned = b.arm() < a.arm();  // groups name the smaller id first
  const double margin_m =
      static_cast<double>(filter::rounding_margin(std::max(a.extent_m(), b.extent_m())));
  PairSet set;
  for_pairs(bodies, turned ? b.arm() : a.arm(), turned ? a.arm() : b.arm(),
            [&](PairId id, const PartPair& pair, const PairGroup& group) {
              const int i = index_of(a.parts(), turned ? pair.b : pair.a);
              const int j = index_of(b.parts(), turned ? pair.a : pair.b);
              const NarrowPair narrow{id, i, j, limit_of(bodies, group)};
              add_capsules(set, narrow, a.parts()[static_cast<std::size_t>(i)], a.capsules(),
                           b.parts()[static_cast<std::size_t>(j)], b.capsules(), margin_m);
            });
  group(set, a.capsules(), false, margin_m);
  add_others(set, b.capsules(), margin_m);
  return set;
}

void PairSet::limits_changed() {
  for (filter::Group& group : groups) {
    group.limit_up = 0.0F;
    for (int p = group.begin; p < group.end; ++p) {
      group.limit_up = std::max(group.limit_up, pairs[static_cast<std::size_t>(p)].limit_up);
    }
  }
  limit_up = 0.0F;
  for (const filter::Pair& pair : pairs) limit_up = std::max(limit_up, pair.limit_up);
  for (filter::Group& other : others) other.limit_up = limit_up;
}

filter::Groups PairSet::grouped() const {
  return {groups.data(), static_cast<int>(groups.size()), groups_of_second,
          others.data(), static_cast<int>(others.size()), limit_up};
}

PairSet self_pairs(const PlanningScene::Bodies& bodies, const Linkage& arm) {
  const auto margin_m = static_cast<double>(filter::rounding_margin(arm.extent_m()));
  PairSet set;
  for_pairs(bodies, arm.arm(), std::nullopt,
            [&](PairId id, const PartPair& pair, const PairGroup& group) {
              const int i = index_of(arm.parts(), pair.a);
              const int j = index_of(arm.parts(), pair.b);
              if (j < 0) return;  // stands still
              const NarrowPair narrow{id, i, j, limit_of(bodies, group)};
              add_capsules(set, narrow, arm.parts()[static_cast<std::size_t>(i)], arm.capsules(),
                           arm.parts()[static_cast<std::size_t>(j)], arm.capsules(), margin_m);
            });
  for (filter::Pair& pair : set.pairs) {
    const int common = arm.common_ancestors(pair.a, pair.b);
    pair.row_a = arm.capsules()[static_cast<std::size_t>(pair.a)].suffix_begin + common;
    pair.row_b = arm.capsules()[static_cast<std::size_t>(pair.b)].suffix_begin + common;
  }
  return set;
}

PairSet still_pairs(const PlanningScene::Bodies& bodies, const Linkage& arm,
                    const StillParts& still) {
  PairSet set;
  double margin_max_m = 0.0;
  for_pairs(bodies, arm.arm(), std::nullopt,
            [&](PairId id, const PartPair& pair, const PairGroup& group) {
              const int i = index_of(arm.parts(), pair.a);
              const int j = index_of(still.parts, pair.b);
              if (j < 0) return;  // the arm's own
              const LinkagePart& a = arm.parts()[static_cast<std::size_t>(i)];
              const LinkagePart& b = still.parts[static_cast<std::size_t>(j)];
              const NarrowPair narrow{id, i, j, limit_of(bodies, group)};
              const Part& part = bodies.parts[pair.b];
              double extent_m = arm.extent_m();
              for (int c = b.capsules_begin; c < b.capsules_end; ++c) {
                const filter::Capsule& capsule = still.capsules[static_cast<std::size_t>(c)];
                extent_m = std::max(extent_m, extent_of(Eigen::Vector3d(capsule.center),
                                                        Eigen::Vector3d(capsule.half), 0.0));
              }
              const auto margin_m = static_cast<double>(filter::rounding_margin(extent_m));
              margin_max_m = std::max(margin_max_m, margin_m);
              if (part.lone_box) {
                add_boxes(set, narrow, a, arm.capsules(), bodies.bodies[part.bodies_begin],
                          still.placed[part.bodies_begin].X_WS, margin_m);
              } else {
                add_capsules(set, narrow, a, arm.capsules(), b, still.capsules, margin_m);
              }
            });
  group(set, still.capsules, true, margin_max_m);
  return set;
}

double least_limit_m(const PlanningScene::Bodies& bodies, const PairSet& set, double most_m) {
  for (const std::vector<NarrowPair>* pairs : {&set.narrow, &set.narrow_boxes}) {
    for (const NarrowPair& pair : *pairs) {
      if (bodies.group_of(pair.pair).kind == PairGroup::Kind::self) continue;
      most_m = std::min(most_m, pair.limit_m);
    }
  }
  return most_m;
}

}  // namespace armloom
