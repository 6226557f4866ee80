#include "core/collision/collision_checker.h"

#include <algorithm>
#include <utility>

#include "core/collision/part_distance.h"
#include "core/collision/scene_bodies.h"
#include "core/model/kinematics.h"

namespace armloom {
namespace {

using Group = PairGroup;

bool includes(const Group& group, const std::vector<bool>& arms) {
  return arms[group.arm.index()] || (group.other && arms[group.other->index()]);
}

struct PartPlace {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // of the bounding sphere
  bool bodies_placed = false;                        // else only the sphere is
};

}  // namespace

// Where everything is for the configuration at hand.
struct CollisionChecker::Scratch {
  PlanningScenePtr scene;
  const PlanningScene::Bodies& bodies;
  LinkPoses X_WL;
  std::vector<PartPlace> parts;
  std::vector<PlacedBody> placed;            // by body
  std::vector<Eigen::AlignedBox3d> arm_box;  // around the bounding spheres of an arm's parts
  std::vector<std::pair<double, std::size_t>> by_gap;  // of closest()

  explicit Scratch(PlanningScenePtr s)
      : scene(std::move(s)),
        bodies(scene->bodies()),
        parts(bodies.parts.size()),
        placed(bodies.bodies.size()),
        arm_box(bodies.parts_of_arm.size()) {
    for (std::size_t i = bodies.held_end; i < bodies.parts.size(); ++i) {
      place_part(i, bodies.parts[i].X_CP);
    }
  }

  void place_part(std::size_t index, const Eigen::Isometry3d& X_WP) {
    parts[index].center = X_WP * bodies.parts[index].p_PC;
    parts[index].bodies_placed = false;
  }

  // Most parts are settled by their spheres: their bodies are placed when first looked at.
  void place_bodies(std::size_t index) {
    if (parts[index].bodies_placed) return;
    const Part& part = bodies.parts[index];
    const Eigen::Isometry3d X_WP = part.pose(X_WL);
    for (std::size_t i = part.bodies_begin; i < part.bodies_end; ++i) {
      place(bodies.bodies[i], X_WP, placed[i]);
    }
    parts[index].bodies_placed = true;
  }

  void move_to(const Configuration& q) {
    forward_kinematics(*bodies.cell, q, X_WL);
    for (std::size_t i = 0; i < bodies.links_end; ++i) {
      place_part(i, X_WL[bodies.parts[i].link->index()]);
    }
    for (std::size_t i = bodies.links_end; i < bodies.held_end; ++i) {
      place_part(i, bodies.parts[i].pose(X_WL));
    }
    for (std::size_t arm = 0; arm < arm_box.size(); ++arm) {
      Eigen::AlignedBox3d& box = arm_box[arm];
      box.setEmpty();
      for (const std::size_t i : bodies.parts_of_arm[arm]) {
        const Eigen::Vector3d reach = Eigen::Vector3d::Constant(bodies.parts[i].radius_m);
        box.extend(Eigen::AlignedBox3d(parts[i].center - reach, parts[i].center + reach));
      }
    }
  }

  // min(distance of the pair, limit)
  [[nodiscard]] double distance(const PartPair& pair, double limit_m) {
    const Part& a = bodies.parts[pair.a];
    const Part& b = bodies.parts[pair.b];
    const double reach = limit_m + a.radius_m + b.radius_m;
    if (reach <= 0.0) return limit_m;
    if ((parts[pair.a].center - parts[pair.b].center).squaredNorm() >= reach * reach) {
      return limit_m;
    }
    place_bodies(pair.b);
    if (b.lone_box && clears_box(parts[pair.a].center, a.radius_m, bodies.bodies[b.bodies_begin],
                                 placed[b.bodies_begin], limit_m)) {
      return limit_m;
    }
    place_bodies(pair.a);
    return part_distance(bodies.bodies, {a, a.pose(X_WL), placed.data()},
                         {b, b.pose(X_WL), placed.data()}, limit_m);
  }

  // What the group keeps where different arms keep `clearance_m`.
  [[nodiscard]] double limit_of(const Group& group, double clearance_m) const {
    return group.limit_m(PairLimits::scaled(*bodies.cell, clearance_m));
  }

  [[nodiscard]] bool far_apart(const Group& group, double limit_m) const {
    if (!group.other) return false;
    const Eigen::AlignedBox3d& a = arm_box[group.arm.index()];
    const Eigen::AlignedBox3d& b = arm_box[group.other->index()];
    return limit_m > 0.0 && a.squaredExteriorDistance(b) >= limit_m * limit_m;
  }

  // Calls visit(NearPair) for every pair of the group closer than the limit; visit returns the
  // limit to go on with.
  template <class Visit>
  void scan(const Group& group, double limit_m, const Visit& visit) {
    const double asked_m = limit_m;
    if (far_apart(group, limit_m)) return;
    for (std::size_t i = group.pairs_begin; i < group.pairs_end; ++i) {
      const double d = distance(bodies.pairs[i], limit_m);
      if (d < limit_m) limit_m = visit({PairId{static_cast<std::uint32_t>(i)}, d, asked_m});
    }
  }

  // The closest pair of the group, when closer than the limit. Those whose spheres are closest are
  // asked first: what they keep settles most of the others by their spheres alone.
  [[nodiscard]] std::optional<NearPair> closest(const Group& group, double limit_m) {
    std::optional<NearPair> found;
    if (far_apart(group, limit_m)) return found;
    const double asked_m = limit_m;
    by_gap.clear();
    for (std::size_t i = group.pairs_begin; i < group.pairs_end; ++i) {
      const double gap_m = sphere_gap(bodies.pairs[i]);
      if (gap_m < limit_m) by_gap.emplace_back(gap_m, i);
    }
    std::sort(by_gap.begin(), by_gap.end());
    for (const auto& [gap_m, i] : by_gap) {
      if (gap_m >= limit_m) break;
      const double d = distance(bodies.pairs[i], limit_m);
      if (d >= limit_m) continue;
      limit_m = d;
      found = {PairId{static_cast<std::uint32_t>(i)}, d, asked_m};
    }
    return found;
  }

  [[nodiscard]] double sphere_gap(const PartPair& pair) const {
    return (parts[pair.a].center - parts[pair.b].center).norm() - bodies.parts[pair.a].radius_m -
           bodies.parts[pair.b].radius_m;
  }
};

CollisionChecker::CollisionChecker(PlanningScenePtr scene)
    : scratch_(std::make_unique<Scratch>(std::move(scene))) {}
CollisionChecker::CollisionChecker(CollisionChecker&&) noexcept = default;
CollisionChecker& CollisionChecker::operator=(CollisionChecker&&) noexcept = default;
CollisionChecker::~CollisionChecker() = default;

const PlanningScene& CollisionChecker::scene() const { return *scratch_->scene; }

std::optional<Proximity> CollisionChecker::first_closer_than(const Configuration& q,
                                                             double clearance_m,
                                                             const std::vector<bool>& arms) {
  scratch_->move_to(q);
  for (const Group& group : scratch_->bodies.groups) {
    if (!includes(group, arms)) continue;
    std::optional<NearPair> first;
    scratch_->scan(group, scratch_->limit_of(group, clearance_m), [&](const NearPair& pair) {
      if (!first) first = pair;
      return -1e9;  // nothing is that deep: the rest is passed over
    });
    if (first) return describe(*first);
  }
  return std::nullopt;
}

std::vector<Proximity> CollisionChecker::all_closer_than(const Configuration& q,
                                                         double clearance_m) {
  scratch_->move_to(q);
  std::vector<Proximity> found;
  for (const Group& group : scratch_->bodies.groups) {
    const double limit_m = scratch_->limit_of(group, clearance_m);
    if (const auto pair = scratch_->closest(group, limit_m)) found.push_back(describe(*pair));
  }
  return found;
}

std::vector<Proximity> CollisionChecker::closest_apart(const Configuration& q, double horizon_m) {
  scratch_->move_to(q);
  std::vector<Proximity> found;
  for (const Group& group : scratch_->bodies.groups) {
    if (group.kind == Group::Kind::self) continue;
    // The mount is one of the things that stand still, whose group comes just before.
    const bool goes_on = group.kind == Group::Kind::mount && !found.empty() &&
                         !found.back().arm_b && found.back().arm_a == group.arm;
    const double limit_m = goes_on ? found.back().clearance_m : horizon_m;
    const auto pair = scratch_->closest(group, limit_m);
    if (!pair) continue;
    if (goes_on) found.pop_back();
    found.push_back(describe(*pair));
  }
  return found;
}

void CollisionChecker::near_pairs(const Configuration& q, double clearance_m,
                                  const std::vector<bool>& of, const std::vector<bool>& moved,
                                  std::vector<NearPair>& near) {
  near.clear();
  scratch_->move_to(q);
  for (const Group& group : scratch_->bodies.groups) {
    if (!includes(group, of) || !includes(group, moved)) continue;
    const double limit_m = scratch_->limit_of(group, clearance_m);
    scratch_->scan(group, limit_m, [&](const NearPair& pair) {
      near.push_back(pair);
      return limit_m;
    });
  }
}

bool CollisionChecker::looks_at(PairId pair, const std::vector<bool>& of,
                                const std::vector<bool>& moved) const {
  const Group& group = scratch_->bodies.group_of(pair);
  return includes(group, of) && includes(group, moved);
}

Proximity CollisionChecker::describe(const NearPair& near) const {
  const PartPair& pair = scratch_->bodies.pairs[near.pair.index()];
  const Part& a = scratch_->bodies.parts[pair.a];
  const Part& b = scratch_->bodies.parts[pair.b];
  Proximity proximity = proximity_of(a, b, near.clearance_m);
  proximity.limit_m = near.limit_m;
  return proximity;
}

bool CollisionChecker::is_self(PairId pair) const {
  return scratch_->bodies.group_of(pair).kind == Group::Kind::self;
}

bool CollisionChecker::is_mount(PairId pair) const {
  return scratch_->bodies.group_of(pair).kind == Group::Kind::mount;
}

}  // namespace armloom
