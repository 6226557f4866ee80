#include "core/collision/check/line_checker.h"

#include <algorithm>
#include <stdexcept>

#include "core/collision/scene/scene_bodies.h"

namespace armloom {
namespace {

// The first cut yields eight stretches, as many as the filter checks at once.
constexpr int kFirstLevels = 3;
// Bodies mostly move towards each other by at least this share of their motion bounds. If their
// distance exceeds the limit by less, no proof is tried.
constexpr double kLineTowardsShare = 0.25;
constexpr Duration kLength = std::chrono::seconds(1);

// Returns a node of the line together with the only node of a counterpart at rest.
TubePair::Nodes nodes_of(const TubePair& pair, const std::shared_ptr<MotionTube>& line, int node) {
  if (pair.is_self()) return {node, node};
  return pair.a() == line ? TubePair::Nodes{node, TimeTree::root()}
                          : TubePair::Nodes{TimeTree::root(), node};
}

}  // namespace

LineChecker::LineChecker(PlanningScenePtr scene, ArmId arm, const Configuration& rest,
                         const TrackingErrors& tracking_errors, const std::vector<ArmId>& left_out)
    : scene_(std::move(scene)),
      arm_(arm),
      rest_(rest),
      tracking_error_(tracking_errors.of(arm)),
      geometry_(std::make_shared<const ArmGeometry>(scene_->bodies(), arm)),
      tube_scratch_(MotionTube::make_scratch(*geometry_)),
      pair_scratch_(TubePair::make_scratch()) {
  const Cell& cell = scene_->cell();
  if (static_cast<std::size_t>(rest.size()) != cell.joints.size()) {
    throw std::invalid_argument("LineChecker: rest must have one entry per joint of the cell");
  }
  const auto add = [&](std::optional<ArmId> other, double error) {
    auto geometry = std::make_shared<const ArmGeometry>(scene_->bodies(), other);
    const bool turned = other && *other < arm;
    PairSet pairs =
        turned ? pairs_between(scene_->bodies(), geometry->kinematics, geometry_->kinematics)
               : pairs_between(scene_->bodies(), geometry_->kinematics, geometry->kinematics);
    if (pairs.empty()) return;
    counterparts_.push_back(
        {std::move(pairs), std::make_shared<MotionTube>(geometry, nullptr, rest, error)});
  };
  for (std::uint32_t a = 0; a < cell.arms.size(); ++a) {
    const bool is_out = std::ranges::find(left_out, ArmId{a}) != left_out.end();
    if (ArmId{a} != arm && !is_out) add(ArmId{a}, tracking_errors.of(ArmId{a}));
  }
  add(std::nullopt, 0.0);
  if (!geometry_->self.empty()) counterparts_.push_back({geometry_->self, nullptr});
  open_.resize(counterparts_.size());
}

std::shared_ptr<MotionTube> LineChecker::tube_along(const Eigen::VectorXd& from,
                                                    const Eigen::VectorXd& to) const {
  const Arm& arm = scene_->cell().arm(arm_);
  Segment segment{Duration{}, kLength, {}};
  segment.coefficients.setZero(from.size(), 6);
  segment.coefficients.col(0) = from;
  segment.coefficients.col(1) = (to - from) / to_seconds(kLength);
  return std::make_shared<MotionTube>(
      geometry_,
      std::make_shared<const Trajectory>(arm.joints, std::vector{arm_}, std::vector{segment}),
      rest_, tracking_error_, tube_scratch_);
}

TubePair LineChecker::pair_with(const Counterpart& other,
                                const std::shared_ptr<MotionTube>& tube) const {
  const TubePair::Setting setting{&scene_->bodies(), &other.pairs, pair_scratch_};
  if (!other.tube) return {setting, tube, tube};
  const std::optional<ArmId> arm = other.tube->kinematics().arm();
  const bool turned = arm && *arm < arm_;
  return turned ? TubePair(setting, other.tube, tube) : TubePair(setting, tube, other.tube);
}

// Decides a stretch from the pairs that the filter left undecided.
LineChecker::Stretch LineChecker::look(TubePair& pair, TubePair::Nodes at,
                                       std::vector<TubePair::Undecided>& undecided) const {
  if (undecided.empty()) return Stretch::free;
  using Undecided = TubePair::Undecided;
  // Returns by how much the distance may exceed the limit at most, according to the capsules.
  const auto room = [](const Undecided& u) {
    return std::max(u.distance_m, 0.0) + u.slack_m - u.limit_m;
  };
  std::ranges::sort(undecided, {}, [&](const Undecided& u) { return room(u) - u.moves_m(); });
  for (const Undecided& u : undecided) {
    const NarrowPair& narrow = pair.narrow(u.narrow, u.box);
    const bool hopeless = room(u) < kLineTowardsShare * u.moves_m();
    if (hopeless) {  // cannot be proven free, so only a conflict is checked
      const bool may_be = room(u) < 0.0;
      return may_be && pair.limits_kept(narrow, at, {&u.limit_m, 1}) == 0 ? Stretch::conflict
                                                                          : Stretch::open;
    }
    const double enough_m = u.limit_m + u.moves_m();
    const double some_m = u.limit_m + kLineTowardsShare * u.moves_m();
    const double limits_m[] = {u.limit_m, some_m, enough_m};
    const std::size_t kept = pair.limits_kept(narrow, at, limits_m);
    if (kept == 0) return Stretch::conflict;
    if (kept == 3) continue;
    if (kept == 2 && pair.keeps_apart(narrow, at, u.limit_m, enough_m)) continue;
    return Stretch::open;
  }
  return Stretch::free;
}

// Returns a stretch that is in conflict or undecided, or nullopt if the line is free. Halves all
// stretches level by level, so that conflicts are found early.
std::optional<LineChecker::Found> LineChecker::search(const std::shared_ptr<MotionTube>& tube,
                                                      double distance) {
  std::vector<int> level{TimeTree::root()};
  for (int i = 0; i < kFirstLevels && distance > kFinest; ++i) {
    const std::vector<int> above = std::exchange(level, {});
    for (const int node : above) {
      level.push_back(tube->first_child(node));
      level.push_back(level.back() + 1);
    }
    distance *= 0.5;
  }
  std::vector<TubePair> pairs;
  for (std::size_t c = 0; c < counterparts_.size(); ++c) {
    pairs.push_back(pair_with(counterparts_[c], tube));
    open_[c] = level;
  }
  int looked_at = 0;
  for (bool any = true; any; distance *= 0.5) {
    any = false;
    for (std::size_t c = 0; c < pairs.size(); ++c) {
      const std::vector<int> nodes = std::exchange(open_[c], {});
      for (std::size_t done = 0; done < nodes.size(); done += filter::kLanes) {
        const std::size_t count = std::min<std::size_t>(filter::kLanes, nodes.size() - done);
        TubePair::Nodes batch[filter::kLanes];
        for (std::size_t i = 0; i < count; ++i) {
          batch[i] = nodes_of(pairs[c], tube, nodes[done + i]);
        }
        pairs[c].filter({batch, count});
        evaluations_ += count;
        looked_at += static_cast<int>(count);
        for (std::size_t i = 0; i < count; ++i) {
          const int node = nodes[done + i];
          const Stretch stretch = look(pairs[c], batch[i], pairs[c].undecided(i));
          if (stretch == Stretch::free) continue;
          const bool proven = stretch == Stretch::conflict;
          if (proven || distance <= kFinest || looked_at > kStretchesMax) {
            return Found{c, node, proven};
          }
          open_[c].push_back(tube->first_child(node));
          open_[c].push_back(open_[c].back() + 1);
          any = true;
        }
      }
    }
  }
  return std::nullopt;
}

void LineChecker::let_part_from(const Eigen::VectorXd& from) {
  const auto tube = tube_along(from, from);
  for (Counterpart& other : counterparts_) {
    if (other.tube == nullptr || !other.tube->kinematics().arm()) continue;
    let_part(other.pairs, pair_with(other, tube).near_at(Duration{}, Duration{}));
  }
}

bool LineChecker::is_free(const Eigen::VectorXd& from, const Eigen::VectorXd& to) {
  return !search(tube_along(from, to), (to - from).lpNorm<Eigen::Infinity>());
}

LineChecker::Answer LineChecker::line(const Eigen::VectorXd& from, const Eigen::VectorXd& to) {
  const auto tube = tube_along(from, to);
  const auto found = search(tube, (to - from).lpNorm<Eigen::Infinity>());
  if (!found) return {};
  TubePair pair = pair_with(counterparts_[found->counterpart], tube);
  const auto [worst, moves_m] = worst_of(pair, tube, *found);
  const BodyPair& bodies = scene_->bodies().pairs[worst.pair.index()];
  Answer answer{found->proven ? Kind::conflict : Kind::undecided,
                to_seconds(tube->middle(found->node)) / to_seconds(kLength),
                proximity_of(scene_->bodies().bodies[bodies.a], scene_->bodies().bodies[bodies.b],
                             worst.distance_m),
                moves_m};
  answer.proximity->limit_m = limit_m(worst.pair);
  return answer;
}

double LineChecker::limit_m(PairId pair) const {
  return scene_->bodies().group_of(pair).limit_m(PairLimits::of(scene_->cell()));
}

LineChecker::Worst LineChecker::worst_of(TubePair& pair, const std::shared_ptr<MotionTube>& tube,
                                         const Found& found) const {
  const Duration at = tube->middle(found.node);
  const auto close = pair.too_close_at(at, at);
  const auto missing = [&](const TubePair::PairDistance& c) {
    return c.distance_m - limit_m(c.pair);
  };
  if (!close.empty()) return {*std::ranges::min_element(close, {}, missing), 0.0};
  // No pair is too close at the middle. Find the pair that is not far enough apart for its motion
  // within the stretch.
  const TubePair::Nodes nodes = nodes_of(pair, tube, found.node);
  pair.filter({&nodes, 1});
  std::optional<Worst> worst;
  double least = 0.0;
  const std::vector<TubePair::Undecided> undecided = pair.undecided(0);
  for (const TubePair::Undecided& u : undecided) {
    const NarrowPair& narrow = pair.narrow(u.narrow, u.box);
    const double enough_m = u.limit_m + u.moves_m();
    const double distance_m = pair.distance(narrow, nodes, enough_m);
    if (distance_m - enough_m >= least) continue;
    least = distance_m - enough_m;
    worst = Worst{{narrow.pair, distance_m}, u.moves_m()};
  }
  return worst.value_or(Worst{pair.closest_at(at, at), 0.0});
}

}  // namespace armloom
