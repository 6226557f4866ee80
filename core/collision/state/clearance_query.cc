#include "core/collision/state/clearance_query.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "core/collision/state/objects_below.h"
#include "core/collision/state/placed_cell.h"
#include "core/model/kinematics.h"

namespace armloom {
namespace {

// A pair of an arm with its mount counts as near below this multiple of the required clearance.
constexpr double kNear = 3.0;

constexpr auto kAnyDistance = [](const PairGroup&, std::size_t) {
  return std::numeric_limits<double>::infinity();
};

bool includes(const PairGroup& group, const std::vector<bool>& arms) {
  return arms[group.arm.index()] || (group.other && arms[group.other->index()]);
}

}  // namespace

struct ClearanceQuery::Scratch {
  // A pair that is undecided in one lane.
  struct Open {
    PlacedBody a;
    PlacedBody b;
    double limit_m;
    std::size_t lane;
    float least_m;  // lower bound of the distance, from the capsules
  };
  struct Candidate {
    double least_m;  // lower bound of the distance
    std::size_t pair;
  };

  PlanningScenePtr scene;
  const PlanningScene::Bodies& bodies;
  PlacedCell placed;
  PairId last{0};                  // pair of the last hit
  unsigned looked_at = 0;          // lanes in which `last` is decided or in `open`
  std::vector<Open> open;          // undecided pairs of meshes, which take longest
  std::vector<std::size_t> order;  // indices in `open`: deepest overlap of capsules first
  LinkPoses X_WL;
  std::vector<Candidate> candidates;
  std::vector<std::pair<ArmId, std::size_t>> stands_on;  // an arm, and an object (Bodies::bodies)

  Scratch(PlanningScenePtr s, const PairLimits& limits)
      : scene(std::move(s)),
        bodies(scene->bodies()),
        placed(bodies, limits),
        stands_on(objects_below(bodies)) {}

  // ---- Many states ----

  [[nodiscard]] bool closer_than_limit(const Open& o) const {
    return bodies_closer_than(bodies.shapes, o.a, o.b, o.limit_m);
  }

  // Adds to `close` the lanes in which the hit is too close. If inner balls do not decide a pair of
  // meshes, adds the pair to `open`. Deciding it can wait, because most states that are too close
  // also have a pair that overlaps deeply.
  void decide_soon(const PlacedCell::Comparison& c, const filter::Hit& hit, const NarrowPair& pair,
                   unsigned& close) {
    if (pair.pair != last) looked_at = 0;  // several capsules of one pair may be near
    last = pair.pair;
    for (std::size_t lane = 0; lane < kStatesAtOnce; ++lane) {
      const unsigned bit = 1U << lane;
      if ((hit.lanes & ~close & ~looked_at & bit) == 0) continue;
      looked_at |= bit;
      const Open o{placed.body(c.a, pair.body_a, lane), placed.body(c.b, pair.body_b, lane),
                   pair.limit_m, lane, hit.distance[lane]};
      const bool meshes = o.a.body.has_pieces || o.b.body.has_pieces;
      if (meshes ? bodies_surely_closer_than(bodies.shapes, o.a, o.b, o.limit_m)
                 : closer_than_limit(o)) {
        close |= bit;
      } else if (meshes) {
        open.push_back(o);
      }
    }
  }

  unsigned too_close(std::span<const Configuration* const> states) {
    placed.place(states);
    const unsigned all = (1U << states.size()) - 1U;
    unsigned close = looked_at = 0;
    open.clear();
    for (const PlacedCell::Comparison& c : placed.comparisons()) {
      if (close == all) return close;
      placed.filter(c, all & ~close, [&](const filter::Hit& hit, const NarrowPair& pair) {
        decide_soon(c, hit, pair, close);
      });
    }
    order.resize(open.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return open[i].least_m; });
    for (const std::size_t i : order) {
      const Open& o = open[i];
      const unsigned bit = 1U << o.lane;
      if ((~close & bit) != 0 && closer_than_limit(o)) close |= bit;
    }
    return close;
  }

  // ---- One state ----

  // Returns true if some pairs of the comparison are of this group.
  [[nodiscard]] bool compares(const PlacedCell::Comparison& c, const PairGroup& group) const {
    if (group.arm.index() != c.a) return false;
    if (group.other) return group.other->index() == c.b;
    return c.b == (group.kind == PairGroup::Kind::self ? c.a : bodies.cell->arms.size());
  }

  // Writes to `candidates` the pairs that the filter leaves undecided, if `wanted` selects their
  // group, and may_count(group, pair) returns a distance (m) above their lower bound. Sorted by
  // pair, each pair once.
  template <class Wanted, class MayCount>
  void find_candidates(const Configuration& q, const Wanted& wanted, const MayCount& may_count) {
    const Configuration* const state[] = {&q};
    forward_kinematics(*bodies.cell, q, X_WL);
    placed.place(state);
    candidates.clear();
    for (const PlacedCell::Comparison& c : placed.comparisons()) {
      const bool is_wanted = std::ranges::any_of(bodies.groups, [&](const PairGroup& group) {
        return compares(c, group) && wanted(group);
      });
      if (!is_wanted) continue;
      placed.filter(c, 1U, [&](const filter::Hit& hit, const NarrowPair& narrow) {
        const PairGroup& group = bodies.group_of(narrow.pair);
        const auto least_m = static_cast<double>(hit.distance[0]);
        if (!wanted(group) || least_m >= may_count(group, narrow.pair.index())) return;
        candidates.push_back({least_m, narrow.pair.index()});
      });
    }
    std::ranges::sort(candidates, {},
                      [](const Candidate& c) { return std::pair(c.pair, c.least_m); });
    const auto doubled = std::ranges::unique(candidates, {}, &Candidate::pair);
    candidates.erase(doubled.begin(), doubled.end());
  }

  // Returns min(distance of the pair, limit_m).
  [[nodiscard]] double distance(std::size_t pair, double limit_m) const {
    const CollisionBody& a = bodies.bodies[bodies.pairs[pair].a];
    const CollisionBody& b = bodies.bodies[bodies.pairs[pair].b];
    return body_distance(bodies.shapes, {a, a.pose(X_WL)}, {b, b.pose(X_WL)}, limit_m);
  }

  // Returns the closest pair of the group that is closer than `limit_of(pair)`, or nullopt. Tries
  // pairs with a small lower bound first.
  template <class LimitOf>
  [[nodiscard]] std::optional<NearPair> closest(const PairGroup& group, const LimitOf& limit_of) {
    std::optional<NearPair> found;
    const auto begin =
        std::ranges::lower_bound(candidates, group.pairs_begin, {}, &Candidate::pair);
    const auto end = std::ranges::lower_bound(candidates, group.pairs_end, {}, &Candidate::pair);
    std::sort(begin, end, [](const Candidate& x, const Candidate& y) {
      return std::pair(x.least_m, x.pair) < std::pair(y.least_m, y.pair);
    });
    for (auto at = begin; at != end && (!found || at->least_m < found->clearance_m); ++at) {
      const double asked_m = limit_of(at->pair);
      const double limit_m = found ? std::min(asked_m, found->clearance_m) : asked_m;
      if (at->least_m >= limit_m) continue;
      const double d = distance(at->pair, limit_m);
      if (d < limit_m) found = {PairId{static_cast<std::uint32_t>(at->pair)}, d, asked_m};
    }
    // Restore the order by pair, which the other groups need.
    std::sort(begin, end, [](const Candidate& x, const Candidate& y) { return x.pair < y.pair; });
    return found;
  }

  [[nodiscard]] bool is_at_mount(const PairGroup& group, std::size_t pair) const {
    if (group.kind == PairGroup::Kind::mount) return true;
    if (group.kind != PairGroup::Kind::still) return false;
    const auto& [a, b] = bodies.pairs[pair];
    return is_first_link(a) ||
           std::ranges::find(stands_on, std::pair(group.arm, b)) != stands_on.end();
  }

  // Returns true if the body is a link that the first movable joint of its arm moves, and no other.
  [[nodiscard]] bool is_first_link(std::size_t body) const {
    const CollisionBody& of = bodies.bodies[body];
    if (!of.link) return false;
    int joints = 0;
    for (std::optional<LinkId> at = of.link; at; at = bodies.cell->link(*at).parent) {
      joints += bodies.cell->link(*at).driver ? 1 : 0;
    }
    return joints == 1;
  }

  // An arm's mount and its other static bodies are one counterpart. The mount's group follows
  // directly after the group of the other static bodies.
  [[nodiscard]] static bool goes_on(const PairGroup& group, const PairGroup* before) {
    return group.kind == PairGroup::Kind::mount && before != nullptr &&
           before->kind == PairGroup::Kind::still && before->arm == group.arm;
  }

  // By counterpart, without self: the closest pair.
  using ClosestPairs = std::vector<std::optional<NearPair>>;

  // Fills those of `found` that are missing, from pairs closer than limit_of(group, pair,
  // horizon_m), which is at most horizon_m. Skips groups that `wanted` does not select. Returns
  // true if none is missing any more.
  template <class Wanted, class LimitOf>
  bool find_closest(const Configuration& q, double horizon_m, const Wanted& wanted,
                    const LimitOf& limit_of, ClosestPairs& found) {
    std::vector<std::size_t> counterpart(bodies.groups.size());
    std::size_t count = 0;
    const PairGroup* before = nullptr;
    for (std::size_t g = 0; g < bodies.groups.size(); ++g) {
      const PairGroup& group = bodies.groups[g];
      if (group.kind == PairGroup::Kind::self || !wanted(group)) continue;
      count += goes_on(group, before) ? 0 : 1;
      counterpart[g] = count - 1;
      before = &group;
    }
    found.resize(count);
    const ClosestPairs known = found;
    const auto is_missing = [&](const PairGroup& group) {
      const auto g = static_cast<std::size_t>(&group - bodies.groups.data());
      return group.kind != PairGroup::Kind::self && wanted(group) && !known[counterpart[g]];
    };
    if (std::ranges::none_of(bodies.groups, is_missing)) return true;
    placed.set_limits({horizon_m, 0.0, horizon_m});
    find_candidates(q, is_missing, [&](const PairGroup& group, std::size_t pair) {
      return limit_of(group, pair, horizon_m);
    });
    for (const PairGroup& group : bodies.groups) {
      if (!is_missing(group)) continue;
      auto& own = found[counterpart[static_cast<std::size_t>(&group - bodies.groups.data())]];
      const auto pair = closest(group, [&](std::size_t p) {
        const double limit_m = limit_of(group, p, horizon_m);
        return own ? std::min(limit_m, own->clearance_m) : limit_m;
      });
      if (pair) own = pair;
    }
    return std::ranges::all_of(found, [](const auto& pair) { return pair.has_value(); });
  }

  // Does this for near horizons first, because among thousands of objects most are far away.
  template <class Wanted, class LimitOf>
  ClosestPairs closest_pairs(const Configuration& q, double horizon_m, const Wanted& wanted,
                             const LimitOf& limit_of) {
    constexpr double kNearer_m[] = {0.1, 0.4};
    const PairLimits limits = placed.limits();
    ClosestPairs found;
    bool is_complete = false;
    for (const double nearer_m : kNearer_m) {
      if (is_complete || nearer_m >= horizon_m) break;
      is_complete = find_closest(q, nearer_m, wanted, limit_of, found);
    }
    if (!is_complete) (void)find_closest(q, horizon_m, wanted, limit_of, found);
    placed.set_limits(limits);
    std::erase_if(found, [](const auto& pair) { return !pair; });
    for (auto& pair : found) pair->limit_m = horizon_m;
    return found;
  }
};

ClearanceQuery::ClearanceQuery(PlanningScenePtr scene)
    : ClearanceQuery(scene, PairLimits::of(scene->cell())) {}
ClearanceQuery::ClearanceQuery(PlanningScenePtr scene, const PairLimits& limits)
    : scratch_(std::make_unique<Scratch>(std::move(scene), limits)) {}
ClearanceQuery::ClearanceQuery(ClearanceQuery&&) noexcept = default;
ClearanceQuery& ClearanceQuery::operator=(ClearanceQuery&&) noexcept = default;
ClearanceQuery::~ClearanceQuery() = default;

const PlanningScene& ClearanceQuery::scene() const { return *scratch_->scene; }
void ClearanceQuery::set_limits(const PairLimits& limits) { scratch_->placed.set_limits(limits); }

unsigned ClearanceQuery::too_close(std::span<const Configuration* const> states) {
  return scratch_->too_close(states);
}

void ClearanceQuery::near_pairs(const Configuration& q, const std::vector<bool>& of,
                                const std::vector<bool>& moved, std::vector<NearPair>& near) {
  near.clear();
  scratch_->find_candidates(
      q, [&](const PairGroup& group) { return includes(group, of) && includes(group, moved); },
      kAnyDistance);
  for (const auto& [least_m, pair] : scratch_->candidates) {
    const PairId id{static_cast<std::uint32_t>(pair)};
    const double limit_m = scratch_->bodies.group_of(id).limit_m(scratch_->placed.limits());
    const double d = scratch_->distance(pair, limit_m);
    if (d < limit_m) near.push_back({id, d, limit_m});
  }
}

std::vector<NearPair> ClearanceQuery::near_pairs(const Configuration& q) {
  const std::vector<bool> all(scene().cell().arms.size(), true);
  std::vector<NearPair> near;
  near_pairs(q, all, all, near);
  return near;
}

bool ClearanceQuery::looks_at(PairId pair, const std::vector<bool>& of,
                              const std::vector<bool>& moved) const {
  const PairGroup& group = scratch_->bodies.group_of(pair);
  return includes(group, of) && includes(group, moved);
}

std::vector<Proximity> ClearanceQuery::closest_too_close(const Configuration& q) {
  scratch_->find_candidates(
      q, [](const PairGroup&) { return true; }, kAnyDistance);
  std::vector<Proximity> found;
  for (const PairGroup& group : scratch_->bodies.groups) {
    const double limit_m = group.limit_m(scratch_->placed.limits());
    const auto pair = scratch_->closest(group, [&](std::size_t) { return limit_m; });
    if (pair) found.push_back(describe(*pair));
  }
  return found;
}

ClearanceQuery::Closest ClearanceQuery::closest_apart(const Configuration& q, double horizon_m) {
  const double near_m = kNear * scratch_->bodies.cell->clearances.clearance_m;
  const auto apart = scratch_->closest_pairs(
      q, horizon_m, [](const PairGroup&) { return true; },
      [&](const PairGroup& group, std::size_t pair, double within_m) {
        return scratch_->is_at_mount(group, pair) ? std::min(near_m, within_m) : within_m;
      });
  const auto at_mount = scratch_->closest_pairs(
      q, horizon_m, [](const PairGroup& group) { return group.kind != PairGroup::Kind::arms; },
      [&](const PairGroup& group, std::size_t pair, double within_m) {
        return scratch_->is_at_mount(group, pair) ? within_m : 0.0;
      });
  Closest found;
  for (const auto& pair : apart) found.apart.push_back(describe(*pair));
  for (const auto& pair : at_mount) {
    if (pair->clearance_m >= near_m) found.at_mount.push_back(describe(*pair));
  }
  return found;
}

Proximity ClearanceQuery::describe(const NearPair& near) const {
  const BodyPair& pair = scratch_->bodies.pairs[near.pair.index()];
  Proximity proximity = proximity_of(scratch_->bodies.bodies[pair.a],
                                     scratch_->bodies.bodies[pair.b], near.clearance_m);
  proximity.limit_m = near.limit_m;
  return proximity;
}

bool ClearanceQuery::is_self(PairId pair) const {
  return scratch_->bodies.group_of(pair).kind == PairGroup::Kind::self;
}

bool ClearanceQuery::is_mount(PairId pair) const {
  return scratch_->bodies.group_of(pair).kind == PairGroup::Kind::mount;
}

}  // namespace armloom
