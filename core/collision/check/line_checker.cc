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

using Undecided = TubePair::Undecided;

// Returns by how much the distance may exceed the limit at most, according to the capsules.
double room_m(const Undecided& u) { return std::max(u.distance_m, 0.0) + u.slack_m - u.limit_m; }

// Returns a place of the line as a share of its length.
double share_of(Duration place, Duration length) {
  return length > Duration{} ? to_seconds(place) / to_seconds(length) : 0.0;
}

}  // namespace

LineChecker::LineChecker(PlanningScenePtr scene, ArmId arm, const Configuration& rest,
                         const TrackingErrors& tracking_errors, const std::vector<ArmId>& left_out)
    : scene_(std::move(scene)), arm_(arm), pair_scratch_(TubePair::make_scratch()) {
  const PlanningScene::Bodies& bodies = scene_->bodies();
  const Cell& cell = scene_->cell();
  if (static_cast<std::size_t>(rest.size()) != cell.joints.size()) {
    throw std::invalid_argument("LineChecker: rest must have one entry per joint of the cell");
  }
  const auto geometry = std::make_shared<const ArmGeometry>(bodies, arm);
  line_ = std::make_shared<MotionTube>(geometry, nullptr, rest, tracking_errors.of(arm));
  const auto add_other = [&](std::optional<ArmId> other, double error) {
    const auto of_other = std::make_shared<const ArmGeometry>(bodies, other);
    const auto tube = std::make_shared<MotionTube>(of_other, nullptr, rest, error);
    if (other && *other < arm) {
      add(pairs_between(bodies, of_other->kinematics, geometry->kinematics), tube, line_);
    } else {
      add(pairs_between(bodies, geometry->kinematics, of_other->kinematics), line_, tube);
    }
  };
  for (std::uint32_t a = 0; a < cell.arms.size(); ++a) {
    const bool is_out = std::ranges::find(left_out, ArmId{a}) != left_out.end();
    if (ArmId{a} != arm && !is_out) add_other(ArmId{a}, tracking_errors.of(ArmId{a}));
  }
  add_other(std::nullopt, 0.0);
  add(geometry->self, line_, line_);
}

void LineChecker::add(PairSet pairs, std::shared_ptr<MotionTube> a, std::shared_ptr<MotionTube> b) {
  if (pairs.empty()) return;
  auto kept = std::make_unique<PairSet>(std::move(pairs));
  TubePair tubes({&scene_->bodies(), kept.get(), pair_scratch_}, std::move(a), std::move(b));
  counterparts_.push_back({std::move(kept), std::move(tubes), {}});
}

// Returns a node of the line together with the only node of a counterpart at rest.
TubePair::Nodes LineChecker::nodes_of(const TubePair& pair, int node) const {
  if (pair.is_self()) return {node, node};
  return pair.a() == line_ ? TubePair::Nodes{node, TimeTree::root()}
                           : TubePair::Nodes{TimeTree::root(), node};
}

// Filters up to eight stretches. Adds those that stay undecided to `looks_`. If one of them is
// proven to be in conflict, returns it. Tries the deepest overlap of capsules first.
std::optional<LineChecker::Found> LineChecker::filter(std::size_t counterpart,
                                                      std::span<const int> nodes, bool finest) {
  TubePair& pair = counterparts_[counterpart].tubes;
  TubePair::Nodes batch[filter::kLanes];
  for (std::size_t i = 0; i < nodes.size(); ++i) batch[i] = nodes_of(pair, nodes[i]);
  pair.filter({batch, nodes.size()});
  evaluations_ += nodes.size();
  deep_.clear();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::vector<Undecided>& undecided = pair.undecided(i);
    if (undecided.empty()) continue;
    const std::size_t begin = undecided_.size();
    undecided_.insert(undecided_.end(), undecided.begin(), undecided.end());
    looks_.push_back({counterpart, nodes[i], begin, undecided_.size()});
    for (const Undecided& u : undecided) {
      const double over_m = u.distance_m + (finest ? 0.0 : u.slack_m) - u.limit_m;
      if (over_m < 0.0) deep_.push_back({over_m, i, u});
    }
  }
  std::ranges::sort(deep_, {}, &Deep::over_m);
  for (const Deep& deep : deep_) {
    const NarrowPair narrow = pair.narrow(deep.u.narrow, deep.u.box);
    if (pair.limits_kept(narrow, batch[deep.of_batch], {&deep.u.limit_m, 1}) == 0) {
      return Found{counterpart, nodes[deep.of_batch], true};
    }
  }
  return std::nullopt;
}

// Decides a stretch from the pairs that the filter left undecided.
LineChecker::Stretch LineChecker::look(const Look& at) {
  TubePair& pair = counterparts_[at.counterpart].tubes;
  const TubePair::Nodes nodes = nodes_of(pair, at.node);
  const std::span undecided = std::span(undecided_).subspan(at.begin, at.end - at.begin);
  std::ranges::sort(undecided, {}, [&](const Undecided& u) { return room_m(u) - u.moves_m(); });
  for (const Undecided& u : undecided) {
    // Cannot be proven free.
    if (room_m(u) < kLineTowardsShare * u.moves_m()) return Stretch::open;
    const NarrowPair narrow = pair.narrow(u.narrow, u.box);
    const double enough_m = u.limit_m + u.moves_m();
    const double some_m = u.limit_m + kLineTowardsShare * u.moves_m();
    const double limits_m[] = {u.limit_m, some_m, enough_m};
    const std::size_t kept = pair.limits_kept(narrow, nodes, limits_m);
    if (kept == 0) return Stretch::conflict;
    if (kept == 3) continue;
    if (kept == 2 && pair.keeps_apart(narrow, nodes, u.limit_m, enough_m)) continue;
    return Stretch::open;
  }
  return Stretch::free;
}

// Moves line_ along the line, and lists its first stretches in `level_`. Each of them is one
// stretch of the tube. Returns the largest motion of a joint in one of them (rad, m).
double LineChecker::cut(const Eigen::VectorXd& from, const Eigen::VectorXd& to) {
  double distance = (to - from).lpNorm<Eigen::Infinity>();
  Duration length = distance > 0.0 ? MotionTube::kStretch : Duration{};
  int levels = 0;
  for (; levels < kFirstLevels && distance > kFinest; ++levels) {
    distance *= 0.5;
    length *= 2;
  }
  line_->move_along(scene_->cell().arm(arm_).joints, from, to, length);
  level_.assign(1, TimeTree::root());
  for (int i = 0; i < levels; ++i) {
    halves_.clear();
    for (const int node : level_) {
      halves_.push_back(line_->first_child(node));
      halves_.push_back(halves_.back() + 1);
    }
    std::swap(level_, halves_);
  }
  return distance;
}

// Returns a stretch that is in conflict or undecided, or nullopt if the line is free. Halves all
// stretches level by level, so that conflicts are found early. On each level, the filter looks for
// conflicts with all counterparts before anything is proven free.
std::optional<LineChecker::Found> LineChecker::search(const Eigen::VectorXd& from,
                                                      const Eigen::VectorXd& to) {
  double distance = cut(from, to);
  line_->place(level_, true);  // at once, because most lines are also compared with the arm itself
  for (Counterpart& each : counterparts_) each.open = level_;
  int looked_at = 0;
  for (bool any = true; any; distance *= 0.5) {
    any = false;
    looks_.clear();
    undecided_.clear();
    for (std::size_t c = 0; c < counterparts_.size(); ++c) {
      for (std::span<const int> left = counterparts_[c].open; !left.empty();) {
        const auto batch = left.first(std::min<std::size_t>(filter::kLanes, left.size()));
        if (auto found = filter(c, batch, distance <= kFinest)) return found;
        looked_at += static_cast<int>(batch.size());
        left = left.subspan(batch.size());
      }
      counterparts_[c].open.clear();
    }
    for (const Look& at : looks_) {
      const Stretch stretch = look(at);
      if (stretch == Stretch::free) continue;
      const bool proven = stretch == Stretch::conflict;
      if (proven || distance <= kFinest || looked_at > kStretchesMax) {
        return Found{at.counterpart, at.node, proven};
      }
      std::vector<int>& open = counterparts_[at.counterpart].open;
      open.push_back(line_->first_child(at.node));
      open.push_back(open.back() + 1);
      any = true;
    }
  }
  return std::nullopt;
}

void LineChecker::let_part_from(const Eigen::VectorXd& from) {
  (void)cut(from, from);
  for (Counterpart& other : counterparts_) {
    const bool is_first = other.tubes.a() == line_;
    const auto& tube = is_first ? other.tubes.b() : other.tubes.a();
    if (tube == line_ || !tube->kinematics().arm()) continue;
    let_part(*other.pairs, other.tubes.near_at(Duration{}, Duration{}));
  }
}

bool LineChecker::is_free(const Eigen::VectorXd& from, const Eigen::VectorXd& to) {
  return !search(from, to);
}

LineChecker::Answer LineChecker::line(const Eigen::VectorXd& from, const Eigen::VectorXd& to) {
  const auto found = search(from, to);
  if (!found) return {};
  const auto [worst, moves_m] = worst_of(*found);
  const BodyPair& bodies = scene_->bodies().pairs[worst.pair.index()];
  Answer answer{found->proven ? Kind::conflict : Kind::undecided,
                share_of(line_->middle(found->node), line_->duration()),
                proximity_of(scene_->bodies().bodies[bodies.a], scene_->bodies().bodies[bodies.b],
                             worst.distance_m),
                moves_m};
  answer.proximity->limit_m = limit_m(worst.pair);
  return answer;
}

double LineChecker::limit_m(PairId pair) const {
  return scene_->bodies().group_of(pair).limit_m(PairLimits::of(scene_->cell()));
}

LineChecker::Worst LineChecker::worst_of(const Found& found) {
  TubePair& pair = counterparts_[found.counterpart].tubes;
  const Duration at = line_->middle(found.node);
  const auto close = pair.too_close_at(at, at);
  const auto missing = [&](const TubePair::PairDistance& c) {
    return c.distance_m - limit_m(c.pair);
  };
  if (!close.empty()) return {*std::ranges::min_element(close, {}, missing), 0.0};
  // No pair is too close at the middle. Find the pair that is not far enough apart for its motion
  // within the stretch.
  const TubePair::Nodes nodes = nodes_of(pair, found.node);
  pair.filter({&nodes, 1});
  std::optional<Worst> worst;
  double least = 0.0;
  const std::vector<Undecided> undecided = pair.undecided(0);
  for (const Undecided& u : undecided) {
    const NarrowPair narrow = pair.narrow(u.narrow, u.box);
    const double enough_m = u.limit_m + u.moves_m();
    const double distance_m = pair.distance(narrow, nodes, enough_m);
    if (distance_m - enough_m >= least) continue;
    least = distance_m - enough_m;
    worst = Worst{{narrow.pair, distance_m}, u.moves_m()};
  }
  return worst.value_or(Worst{pair.closest_at(at, at), 0.0});
}

}  // namespace armloom
