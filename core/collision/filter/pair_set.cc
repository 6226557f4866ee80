#include "core/collision/filter/pair_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/model/kinematics.h"

namespace armloom {
namespace {

// Returns an upper bound of the world coordinates of the static body's capsule axes (m).
double extent_of(const KinematicBody& body, const ArmKinematics& still) {
  double extent_m = 0.0;
  for (int c = body.capsules_begin; c < body.capsules_end; ++c) {
    const filter::Capsule& capsule = still.capsules()[static_cast<std::size_t>(c)];
    extent_m = std::max(extent_m, Eigen::Map<const Eigen::Vector3d>(capsule.center).norm() +
                                      Eigen::Map<const Eigen::Vector3d>(capsule.half).norm());
  }
  return extent_m;
}

int index_of(const std::vector<KinematicBody>& bodies, std::size_t body) {
  const auto found = std::ranges::find(bodies, body, &KinematicBody::body);
  return found == bodies.end() ? -1 : static_cast<int>(found - bodies.begin());
}

double limit_of(const PlanningScene::Bodies& bodies, const PairGroup& group) {
  return group.limit_m(PairLimits::of(*bodies.cell));
}

struct BodyCapsules {
  const KinematicBody& body;
  const std::vector<filter::Capsule>& of_side;

  [[nodiscard]] int begin() const { return body.capsules_begin; }
  [[nodiscard]] int end() const { return body.capsules_end; }
  [[nodiscard]] const filter::Capsule& operator[](int index) const {
    return of_side[static_cast<std::size_t>(index)];
  }
};

void add_capsules(PairSet& set, const NarrowPair& narrow, const BodyCapsules& a,
                  const BodyCapsules& b, double margin_m) {
  for (int i = a.begin(); i < a.end(); ++i) {
    for (int j = b.begin(); j < b.end(); ++j) {
      set.pairs.push_back(kernel_pair({i, a[i]}, {j, b[j]}, narrow.limit_m, margin_m));
      set.narrow.push_back(narrow);
    }
  }
}

struct StandingBox {
  const ConvexShape& box;
  Eigen::Isometry3d X_WS;
};
void add_boxes(PairSet& set, const NarrowPair& narrow, const BodyCapsules& a, const StandingBox& b,
               double margin_m) {
  for (int i = a.begin(); i < a.end(); ++i) {
    filter::BoxPair pair{};
    pair.a = pair.row_a = i;
    for (int k = 0; k < 3; ++k) {
      for (int c = 0; c < 3; ++c) pair.R[3 * k + c] = static_cast<float>(b.X_WS.linear()(c, k));
      pair.center[k] = static_cast<float>(b.X_WS.translation()[k]);
      pair.half_up[k] = round_up(b.box.half_size_m[k]);
    }
    pair.limit_up = round_up(narrow.limit_m);
    pair.radius_up = round_up(static_cast<double>(a[i].radius_up) + margin_m);
    set.boxes.push_back(pair);
    set.narrow_boxes.push_back(narrow);
  }
}

// Groups the pairs by their capsule of one side: of the second side if `of_second`, else of the
// first.
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

// Sets `others` to the second side's capsules, unless there are too many for the kernel.
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

filter::Pairs PairSet::grouped() const {
  filter::Pairs all = ungrouped();
  all.groups = {groups.data(), static_cast<int>(groups.size()), groups_of_second,
                others.data(), static_cast<int>(others.size()), limit_up};
  return all;
}

filter::Pairs PairSet::ungrouped() const {
  return {pairs.data(), static_cast<int>(pairs.size()), {}};
}

PairSet pairs_between(const PlanningScene::Bodies& bodies, const ArmKinematics& a,
                      const ArmKinematics& b) {
  const bool self = b.arm() == a.arm();
  double margin_m = 0.0;
  PairSet set;
  for (const PairGroup& group : bodies.groups) {
    if (group.arm != *a.arm() || group.other != (self ? std::nullopt : b.arm())) continue;
    for (std::size_t i = group.pairs_begin; i < group.pairs_end; ++i) {
      const BodyPair& pair = bodies.pairs[i];
      const NarrowPair narrow{PairId{static_cast<std::uint32_t>(i)}, index_of(a.bodies(), pair.a),
                              index_of(b.bodies(), pair.b), limit_of(bodies, group)};
      if (narrow.body_b < 0) continue;  // a group of another kind: body b is not in `b`
      const KinematicBody& body_a = a.bodies()[static_cast<std::size_t>(narrow.body_a)];
      const KinematicBody& body_b = b.bodies()[static_cast<std::size_t>(narrow.body_b)];
      const double extent_m = std::max(a.extent_m(), b.arm() ? b.extent_m() : extent_of(body_b, b));
      const auto of_pair_m = static_cast<double>(filter::rounding_margin(extent_m));
      margin_m = std::max(margin_m, of_pair_m);
      const CollisionBody& other = bodies.bodies[pair.b];
      if (!b.arm() && other.lone_box) {
        const ConvexShape& box = bodies.shapes[other.shapes_begin];
        add_boxes(set, narrow, {body_a, a.capsules()}, {box, body_b.X_FP * box.X_PS}, of_pair_m);
      } else {
        add_capsules(set, narrow, {body_a, a.capsules()}, {body_b, b.capsules()}, of_pair_m);
      }
    }
  }
  if (self) {
    for (filter::Pair& pair : set.pairs) {
      const int common = a.common_ancestors(pair.a, pair.b);
      pair.row_a = a.capsules()[static_cast<std::size_t>(pair.a)].motion_bounds_begin + common;
      pair.row_b = a.capsules()[static_cast<std::size_t>(pair.b)].motion_bounds_begin + common;
    }
    return set;
  }
  group(set, (b.arm() ? a : b).capsules(), !b.arm(), margin_m);
  if (b.arm()) add_others(set, b.capsules(), margin_m);
  return set;
}

}  // namespace armloom
