#include "core/collision/state_check.h"

#include <stdexcept>
#include <utility>
#include <vector>

#include "core/collision/pair_set.h"
#include "core/collision/part_distance.h"
#include "core/collision/scene_bodies.h"

namespace armloom {
namespace {

constexpr auto kLanes = static_cast<std::size_t>(filter::kLanes);

// One arm with room for eight placements.
struct PlacedArm {
  explicit PlacedArm(const PlanningScene::Bodies& bodies, ArmId arm)
      : linkage(bodies, arm),
        q(linkage.joints().size() * kLanes),
        frames(linkage.frames().size() * 12 * kLanes),
        axes(linkage.frames().size() * 6 * kLanes),
        capsules(linkage.capsules().size() * 6 * kLanes),
        ball(4 * kLanes) {}

  [[nodiscard]] filter::Side side() const { return {capsules.data(), nullptr, ball.data()}; }

  Linkage linkage;
  std::vector<double> q;
  std::vector<double> frames;
  std::vector<float> axes;
  std::vector<float> capsules;
  std::vector<float> ball;
};

// The pairs of two arms, of an arm and itself (b == a), or of an arm and what stands still.
struct Comparison {
  std::size_t a;
  std::size_t b;
  bool still;
  PairSet pairs;
};

void set_limits(const PlanningScene::Bodies& bodies, const StateCheck::Limits& limits,
                PairSet& set) {
  const auto set_all = [&](auto& entries, std::vector<NarrowPair>& narrow) {
    for (std::size_t i = 0; i < entries.size(); ++i) {
      narrow[i].limit_m = bodies.group_of(narrow[i].pair).limit_m(limits);
      entries[i].limit_up = round_up(narrow[i].limit_m);
    }
  };
  set_all(set.pairs, set.narrow);
  set_all(set.boxes, set.narrow_boxes);
  set.limits_changed();
}

}  // namespace

struct StateCheck::Scratch {
  // A pair that the filter leaves open, in one lane.
  struct Open {
    PlacedPart a;
    PlacedPart b;
    double limit_m;
    std::size_t lane;
  };

  PlanningScenePtr scene;
  const PlanningScene::Bodies& bodies;
  const filter::Kernel& kernel;
  StillParts still;
  std::vector<PlacedArm> arms;
  std::vector<Comparison> comparisons;
  std::vector<filter::Hit> hits;
  std::vector<Open> open;  // of meshes, which take long

  Scratch(PlanningScenePtr s, const Limits& limits, const filter::Kernel& k)
      : scene(std::move(s)), bodies(scene->bodies()), kernel(k), still(bodies) {
    const std::size_t count = scene->cell().arms.size();
    for (std::uint32_t a = 0; a < count; ++a) arms.emplace_back(bodies, ArmId{a});
    for (std::size_t a = 0; a < count; ++a) {
      for (std::size_t b = a + 1; b < count; ++b) {
        add({a, b, false, cross_pairs(bodies, arms[a].linkage, arms[b].linkage)}, limits);
      }
      add({a, a, false, self_pairs(bodies, arms[a].linkage)}, limits);
      add({a, a, true, still_pairs(bodies, arms[a].linkage, still)}, limits);
    }
  }

  void add(Comparison comparison, const Limits& limits) {
    if (comparison.pairs.empty()) return;
    set_limits(bodies, limits, comparison.pairs);
    hits.resize(std::max(
        hits.size(), std::max(comparison.pairs.pairs.size(), comparison.pairs.boxes.size()) + 1));
    comparisons.push_back(std::move(comparison));
  }

  void place(std::span<const Configuration* const> states) {
    if (states.empty() || states.size() > kLanes) {
      throw std::invalid_argument("StateCheck: one to eight states");
    }
    for (PlacedArm& arm : arms) {
      const std::vector<JointId>& joints = arm.linkage.joints();
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const Configuration& q = *states[std::min(lane, states.size() - 1)];
        for (std::size_t row = 0; row < joints.size(); ++row) {
          arm.q[row * kLanes + lane] = q[static_cast<Eigen::Index>(joints[row].index())];
        }
      }
      kernel.place(arm.linkage.view(), arm.q.data(),
                   {arm.frames.data(), arm.axes.data(), arm.capsules.data()});
      kernel.enclose(arm.linkage.view(), arm.capsules.data(), nullptr, nullptr, arm.ball.data());
    }
  }

  [[nodiscard]] filter::Side other_side(const Comparison& c) const {
    return c.still ? filter::Side{still.lanes.data(), nullptr, nullptr} : arms[c.b].side();
  }

  int near_pairs(const Comparison& c, unsigned lanes) {
    return kernel.near_pairs(arms[c.a].side(), other_side(c), c.pairs.pairs.data(),
                             static_cast<int>(c.pairs.pairs.size()), c.pairs.grouped(), lanes,
                             hits.data());
  }

  [[nodiscard]] Open placed(const Comparison& c, const NarrowPair& pair, std::size_t lane) const {
    const auto pose = [lane](const LinkagePart& part, const double* frames) {
      return part_pose(part, frames + lane, filter::kLanes);
    };
    const LinkagePart& a = arms[c.a].linkage.parts()[static_cast<std::size_t>(pair.part_a)];
    const auto b = static_cast<std::size_t>(pair.part_b);
    const LinkagePart& other = c.still ? still.parts[b] : arms[c.b].linkage.parts()[b];
    const double* frames_b = c.still ? nullptr : arms[c.b].frames.data();
    const Eigen::Isometry3d X_WB = c.still ? other.X_FP : pose(other, frames_b);
    return {{bodies.parts[a.part], pose(a, arms[c.a].frames.data())},
            {bodies.parts[other.part], X_WB},
            pair.limit_m,
            lane};
  }

  [[nodiscard]] bool closer_than_limit(const Open& o) const {
    return parts_closer_than(bodies.bodies, o.a, o.b, o.limit_m);
  }

  // Lanes in which one of the first `found` hits is too close indeed. Meshes that balls do not
  // settle are left open: most states that are too close have some pair that overlaps deeply.
  unsigned decide_soon(const Comparison& c, const std::vector<NarrowPair>& narrow, int found,
                       unsigned lanes) {
    unsigned close = 0;
    for (int h = 0; h < found; ++h) {
      const filter::Hit& hit = hits[static_cast<std::size_t>(h)];
      const NarrowPair& pair = narrow[static_cast<std::size_t>(hit.pair)];
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const unsigned bit = 1U << lane;
        if ((hit.lanes & lanes & ~close & bit) == 0) continue;
        const Open o = placed(c, pair, lane);
        const bool meshes = o.a.part.has_pieces || o.b.part.has_pieces;
        if (meshes ? parts_surely_closer_than(bodies.bodies, o.a, o.b, o.limit_m)
                   : closer_than_limit(o)) {
          close |= bit;
        } else if (meshes) {
          open.push_back(o);
        }
      }
    }
    return close;
  }

  // Of all that was left open, the lanes that are too close indeed.
  unsigned decide_open(unsigned lanes) {
    unsigned close = 0;
    for (const Open& o : open) {
      const unsigned bit = 1U << o.lane;
      if ((lanes & ~close & bit) != 0 && closer_than_limit(o)) close |= bit;
    }
    open.clear();
    return close;
  }
};

StateCheck::StateCheck(PlanningScenePtr scene, const filter::Kernel& kernel)
    : StateCheck(scene, PairLimits::of(scene->cell()), kernel) {}
StateCheck::StateCheck(PlanningScenePtr scene, Limits limits, const filter::Kernel& kernel)
    : scratch_(std::make_unique<Scratch>(std::move(scene), limits, kernel)) {}
StateCheck::~StateCheck() = default;
StateCheck::StateCheck(StateCheck&&) noexcept = default;
StateCheck& StateCheck::operator=(StateCheck&&) noexcept = default;

unsigned StateCheck::too_close(std::span<const Configuration* const> states) {
  Scratch& s = *scratch_;
  s.place(states);
  const unsigned all = (1U << states.size()) - 1U;
  unsigned close = 0;
  for (const Comparison& c : s.comparisons) {
    const unsigned lanes = all & ~close;
    if (lanes == 0) break;
    close |= s.decide_soon(c, c.pairs.narrow, s.near_pairs(c, lanes), lanes);
    if (c.pairs.boxes.empty()) continue;
    const int found =
        s.kernel.near_boxes(s.arms[c.a].side(), c.pairs.boxes.data(),
                            static_cast<int>(c.pairs.boxes.size()), lanes, s.hits.data());
    close |= s.decide_soon(c, c.pairs.narrow_boxes, found, lanes & ~close);
  }
  return close | s.decide_open(all & ~close);
}

unsigned StateCheck::open_by_capsules(std::span<const Configuration* const> states) {
  Scratch& s = *scratch_;
  s.place(states);
  const unsigned all = (1U << states.size()) - 1U;
  unsigned open = 0;
  for (const Comparison& c : s.comparisons) {
    if (c.still) continue;
    const int found = s.near_pairs(c, all);
    for (int h = 0; h < found; ++h) open |= s.hits[static_cast<std::size_t>(h)].lanes;
  }
  return open;
}

}  // namespace armloom
