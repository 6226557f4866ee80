#include "core/collision/filter/pair_set.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

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

// Returns, by index in PlanningScene::Bodies::bodies, the index in ArmKinematics::bodies(), or -1.
std::vector<int> indices_of(const std::vector<KinematicBody>& own, std::size_t bodies) {
  std::vector<int> indices(bodies, -1);
  for (std::size_t i = 0; i < own.size(); ++i) indices[own[i].body] = static_cast<int>(i);
  return indices;
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

// A body of the first side that is not compared with a box.
constexpr PairId kNoPair{std::numeric_limits<std::uint32_t>::max()};

// Appends the body's capsules to `boxed`.
void add_boxed(PairSet& set, const ArmKinematics& arm, std::size_t body) {
  const KinematicBody& own = arm.bodies()[body];
  for (int c = own.capsules_begin; c < own.capsules_end; ++c) {
    const filter::Capsule& capsule = arm.capsules()[static_cast<std::size_t>(c)];
    set.boxed.push_back({c, c, capsule.radius_up, capsule.ball_up});
    set.body_of_boxed.push_back(static_cast<int>(body));
  }
}

filter::StaticBox static_box(const ConvexShape& box, const Eigen::Isometry3d& X_WS,
                             double margin_m) {
  filter::StaticBox result{};
  for (int k = 0; k < 3; ++k) {
    for (int c = 0; c < 3; ++c) result.R[3 * k + c] = static_cast<float>(X_WS.linear()(c, k));
    result.center[k] = static_cast<float>(X_WS.translation()[k]);
    result.half_up[k] = round_up(box.half_size_m[k]);
  }
  result.margin_up = round_up(margin_m * (17.0 / 16.0));
  result.ball_up = round_up(box.half_size_m.norm() * (1.0 + 1e-6) + margin_m + 1e-6);
  return result;
}

// Adds the static boxes of a group.
class AddBoxes {
 public:
  AddBoxes(PairSet& set, const ArmKinematics& a, const ArmKinematics& b) : set_(set), a_(a), b_(b) {
    for (std::size_t body = 0; body < a.bodies().size(); ++body) add_boxed(set, a, body);
    all_ = static_cast<int>(set.boxed.size());
  }

  // `pairs`: for each body of a the pair with the box, or kNoPair.
  void add(const NarrowBox& narrow, const ConvexShape& box, double margin_m,
           const std::vector<PairId>& pairs) {
    const KinematicBody& body_b = b_.bodies()[static_cast<std::size_t>(narrow.body_b)];
    filter::StaticBox entry = static_box(box, body_b.X_FP * box.X_PS, margin_m);
    entry.end = all_;
    if (std::ranges::find(pairs, kNoPair) != pairs.end()) {
      entry.begin = static_cast<int>(set_.boxed.size());
      for (std::size_t body = 0; body < pairs.size(); ++body) {
        if (pairs[body] != kNoPair) add_boxed(set_, a_, body);
      }
      entry.end = static_cast<int>(set_.boxed.size());
    }
    entry.limit_up = round_up(narrow.limit_m);
    set_.boxes.push_back(entry);
    set_.narrow_boxes.push_back(narrow);
    set_.pairs_of_boxes.insert(set_.pairs_of_boxes.end(), pairs.begin(), pairs.end());
  }

 private:
  PairSet& set_;
  const ArmKinematics& a_;
  const ArmKinematics& b_;
  int all_ = 0;  // the first entries of `boxed`: all capsules of a
};

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
  const std::vector<filter::Pair> pairs = set.pairs;
  const std::vector<NarrowPair> narrow = set.narrow;
  set.groups.clear();
  set.groups_of_second = of_second;
  for (std::size_t at = 0; at < order.size(); ++at) {
    const filter::Pair& pair = set.pairs[at] = pairs[order[at]];
    set.narrow[at] = narrow[order[at]];
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

std::size_t PairSet::box_hits_max() const {
  std::size_t most = 0;
  for (const filter::StaticBox& box : boxes) most += static_cast<std::size_t>(box.end - box.begin);
  return most;
}

NarrowPair PairSet::narrow_of(int box, int boxed_capsule) const {
  const NarrowBox& of = narrow_boxes[static_cast<std::size_t>(box)];
  const int body_a = body_of_boxed[static_cast<std::size_t>(boxed_capsule)];
  const std::size_t row = static_cast<std::size_t>(box) * bodies_of_first;
  return {pairs_of_boxes[row + static_cast<std::size_t>(body_a)], body_a, of.body_b, of.limit_m};
}

void PairSet::set_limits(const PairLimits& limits) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    narrow[i].limit_m = bodies->group_of(narrow[i].pair).limit_m(limits);
    pairs[i].limit_up = round_up(narrow[i].limit_m);
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    narrow_boxes[i].limit_m = bodies->groups[narrow_boxes[i].group].limit_m(limits);
    boxes[i].limit_up = round_up(narrow_boxes[i].limit_m);
  }
  limits_changed();
}

void PairSet::set_each_limit(const std::function<double(const NarrowPair&)>& limit_m) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    narrow[i].limit_m = limit_m(narrow[i]);
    pairs[i].limit_up = round_up(narrow[i].limit_m);
  }
  const std::size_t count = boxes.size();
  for (std::size_t i = 0; i < count; ++i) {
    const filter::StaticBox whole = boxes[i];
    for (int c = whole.begin, end = c; c < whole.end; c = end) {
      const double limit = limit_m(narrow_of(static_cast<int>(i), c));
      for (end = c + 1; end < whole.end; ++end) {
        const bool is_same_body = body_of_boxed[static_cast<std::size_t>(end)] ==
                                  body_of_boxed[static_cast<std::size_t>(end) - 1];
        if (!is_same_body && limit_m(narrow_of(static_cast<int>(i), end)) != limit) break;
      }
      std::size_t entry = i;
      if (c > whole.begin) {
        entry = boxes.size();
        boxes.push_back(whole);
        narrow_boxes.push_back(narrow_boxes[i]);
        for (std::size_t body = 0; body < bodies_of_first; ++body) {
          pairs_of_boxes.push_back(pairs_of_boxes[i * bodies_of_first + body]);
        }
      }
      boxes[entry].begin = c;
      boxes[entry].end = end;
      boxes[entry].limit_up = round_up(limit);
      narrow_boxes[entry].limit_m = limit;
    }
  }
  limits_changed();
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
  set.bodies = &bodies;
  set.bodies_of_first = a.bodies().size();
  const std::vector<int> index_in_a = indices_of(a.bodies(), bodies.bodies.size());
  const std::vector<int> index_in_b = indices_of(b.bodies(), bodies.bodies.size());
  std::optional<AddBoxes> add_boxes;
  for (std::size_t g = 0; g < bodies.groups.size(); ++g) {
    const PairGroup& group = bodies.groups[g];
    if (group.arm != *a.arm() || group.other != (self ? std::nullopt : b.arm())) continue;
    const double limit_m = limit_of(bodies, group);
    std::vector<std::vector<PairId>> boxed(bodies.bodies.size());  // by body: of this box
    for (std::size_t i = group.pairs_begin; i < group.pairs_end; ++i) {
      const BodyPair& pair = bodies.pairs[i];
      const NarrowPair narrow{PairId{static_cast<std::uint32_t>(i)}, index_in_a[pair.a],
                              index_in_b[pair.b], limit_m};
      if (narrow.body_b < 0) continue;  // a group of another kind: body b is not in `b`
      if (!b.arm() && bodies.bodies[pair.b].lone_box) {
        boxed[pair.b].resize(a.bodies().size(), kNoPair);
        boxed[pair.b][static_cast<std::size_t>(narrow.body_a)] = narrow.pair;
        continue;
      }
      const KinematicBody& body_a = a.bodies()[static_cast<std::size_t>(narrow.body_a)];
      const KinematicBody& body_b = b.bodies()[static_cast<std::size_t>(narrow.body_b)];
      const double extent_m = std::max(a.extent_m(), b.arm() ? b.extent_m() : extent_of(body_b, b));
      const auto of_pair_m = static_cast<double>(filter::rounding_margin(extent_m));
      margin_m = std::max(margin_m, of_pair_m);
      add_capsules(set, narrow, {body_a, a.capsules()}, {body_b, b.capsules()}, of_pair_m);
    }
    for (std::size_t body = 0; body < boxed.size(); ++body) {
      if (boxed[body].empty()) continue;
      if (!add_boxes) add_boxes.emplace(set, a, b);
      const KinematicBody& body_b = b.bodies()[static_cast<std::size_t>(index_in_b[body])];
      const double extent_m = std::max(a.extent_m(), extent_of(body_b, b));
      const auto of_box_m = static_cast<double>(filter::rounding_margin(extent_m));
      margin_m = std::max(margin_m, of_box_m);
      add_boxes->add({g, index_in_b[body], limit_m},
                     bodies.shapes[bodies.bodies[body].shapes_begin], of_box_m, boxed[body]);
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
