#include "core/guard/authority_guard.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace armloom {
namespace {

using Why = GuardRefusal::Why;

// Returns true if an arm's interval overlaps a rectangle's side. If they only share an end, this is
// no overlap: free states next to a rectangle certify its edge, and an interval across the common
// edge of two rectangles overlaps the inside of one of them. So a shared end matters only if the
// arm rests (the interval has no length) or the rectangle has no width.
bool overlap(Duration from, Duration to, Duration box_from, Duration box_to) {
  if (from < to && box_from < box_to) return box_from < to && from < box_to;
  return box_from <= to && from <= box_to;
}

template <class T>
void keep_latest(std::vector<T>& all, const T& one, std::size_t most) {
  if (all.size() >= most) all.erase(all.begin());
  all.push_back(one);
}

}  // namespace

AuthorityGuard::AuthorityGuard(std::vector<GuardedArm> arms, Configuration rest,
                               SceneFingerprint present)
    : arms_(std::move(arms)),
      arm_of_(static_cast<std::size_t>(rest.size())),
      q_(std::move(rest)),
      present_(std::move(present)),
      positions_(arms_.size()) {
  for (std::uint32_t arm = 0; arm < arms_.size(); ++arm) {
    for (const JointId joint : arms_[arm].joints) arm_of_[joint.index()] = ArmId{arm};
  }
}

// ---- Certificates ----

void AuthorityGuard::take(std::span<const Certificate> certificates) {
  for (const Certificate& certificate : certificates) {
    if (const auto* pair = std::get_if<PairCertificate>(&certificate)) {
      if (pair->a.motion) take(*pair);
      if (pair->b.motion) take(turned(*pair));
    } else if (const auto* apart = std::get_if<ApartCertificate>(&certificate)) {
      apart_[std::minmax(apart->a, apart->b)] = apart->geometry;
    } else if (const auto* scene = std::get_if<SceneCertificate>(&certificate)) {
      keep_latest(known(scene->side.motion).scene, *scene, kScenesKept);
    } else if (const auto* together = std::get_if<TogetherCertificate>(&certificate)) {
      known(together->side.motion).together = *together;
    }
  }
  drop_old();
}

// Keeps two certificates of the same two sides: the first, on which passing orders are based,
// and the latest.
void AuthorityGuard::take(const PairCertificate& pair) {
  for (const ArmId arm : pair.b.arms) {
    auto& all = known(pair.a.motion).pairs[arm];
    std::erase_if(all, [&](const PairCertificate& old) {
      // A forgotten motion's certificate still covers an arm that rests at an end of the motion.
      const bool is_left = old.b.motion && !motions_.contains(old.b.motion.get()) &&
                           !covers(old.b, arm, positions_[arm.index()]);
      return is_left || !is_valid(old);
    });
    const auto is_same = [&](const PairCertificate& old) {
      return old.b.motion == pair.b.motion && old.b.still == pair.b.still;
    };
    const auto first = std::ranges::find_if(all, is_same);
    const auto second = first == all.end() ? first : std::find_if(first + 1, all.end(), is_same);
    if (second != all.end()) all.erase(second);
    keep_latest(all, pair, kPairsKept);
  }
}

AuthorityGuard::Known& AuthorityGuard::known(const TrajectoryPtr& motion) {
  Known& of = motions_[motion.get()];
  of.motion = motion;
  of.taken_at = ++taken_;
  return of;
}

void AuthorityGuard::forget(const TrajectoryPtr& motion) {
  const auto of = motions_.find(motion.get());
  if (of != motions_.end()) of->second.is_forgotten = true;
  drop_left(motion.get());
}

// Erases the motion's certificates if it is forgotten and no arm is on it.
void AuthorityGuard::drop_left(const Trajectory* motion) {
  const auto left = motions_.find(motion);
  if (left != motions_.end() && left->second.is_forgotten && !is_on(motion)) motions_.erase(left);
}

// Drops motions that were checked but never started, such as unused retreats.
void AuthorityGuard::drop_old() {
  while (motions_.size() > kMotionsKept * positions_.size()) {
    const auto age = [&](const Motions::value_type& of) {
      return std::pair(is_on(of.first), of.second.taken_at);
    };
    forget(std::ranges::min_element(motions_, {}, age)->second.motion);
  }
}

bool AuthorityGuard::is_on(const Trajectory* motion) const {
  return std::ranges::any_of(
      positions_, [&](const ArmPosition& position) { return position.motion.get() == motion; });
}

// ---- Feedback ----

void AuthorityGuard::moves(ArmId arm, Duration measured) {
  ArmPosition& position = positions_[arm.index()];
  position.measured = std::max(position.measured, measured);
  position.authority = std::max(position.authority, position.measured);
}

void AuthorityGuard::acknowledges(ArmId arm, Duration authority) {
  ArmPosition& position = positions_[arm.index()];
  if (!position.motion || position.at_rest) return;
  position.authority =
      std::max(position.authority, std::min(authority, position.motion->duration()));
}

void AuthorityGuard::rests(ArmId arm, Duration progress, const Configuration& measured) {
  ArmPosition& position = positions_[arm.index()];
  if (position.motion) {
    position.measured = std::max(position.measured, progress);
    position.authority = position.measured;
  }
  position.at_rest = position.is_known = true;
  position.left_path = 0.0;
  for (const JointId joint : arms_[arm.index()].joints) q_[joint.value()] = measured[joint.value()];
  if (position.motion) position.off_path = off(*position.motion, arm, position.measured);
}

void AuthorityGuard::leaves_path(ArmId arm, double distance) {
  ArmPosition& position = positions_[arm.index()];
  if (!position.at_rest) position.left_path = std::max(position.left_path, distance);
}

// ---- Authority ----

bool AuthorityGuard::certifies(ArmId arm, ArmId other) const {
  if (are_apart(arm, other)) return true;
  const auto from = [&](ArmId one, ArmId two) {
    const ArmPosition& own = positions_[one.index()];
    const auto of = motions_.find(own.motion.get());
    return of != motions_.end() && !between(of->second, one, own, two);
  };
  return from(arm, other) || from(other, arm);
}

bool AuthorityGuard::certifies_scene(ArmId arm) const {
  const ArmPosition& own = positions_[arm.index()];
  const auto of = motions_.find(own.motion.get());
  return of != motions_.end() && sees_scene(of->second, arm, own);
}

bool AuthorityGuard::is_valid(const PairCertificate& pair) const {
  return present_.of(pair.a.arms, pair.b.arms) == pair.geometry;
}

bool AuthorityGuard::are_apart(ArmId a, ArmId b) const {
  const auto apart = apart_.find(std::minmax(a, b));
  return apart != apart_.end() && apart->second == present_.of({&a, 1}, {&b, 1});
}

// Returns how far (rad, m) the arm's joints, as last measured at rest, are from the motion.
double AuthorityGuard::off(const Trajectory& motion, ArmId arm, Duration progress) const {
  Eigen::VectorXd at;
  motion.sample_positions(progress, at);
  double largest = 0.0;
  for (std::size_t row = 0; row < motion.joints().size(); ++row) {
    const JointId joint = motion.joints()[row];
    if (arm_of_[joint.index()] != arm) continue;
    largest = std::max(largest, std::abs(q_[joint.value()] - at[static_cast<Eigen::Index>(row)]));
  }
  return largest;
}

// Returns the arm's position after the grant. A start before the measured progress restarts the
// motion, if it moves a single arm. Arms of a synchronous motion may rest at different progress, so
// that a start before an arm's progress is no restart.
ArmPosition AuthorityGuard::as_granted(const TrajectoryPtr& motion, ArmId arm, From from,
                                       Duration authority) const {
  ArmPosition position = positions_[arm.index()];
  const Duration set_out = from.value_or(Duration{});
  const bool again = from && position.at_rest && motion->arms().size() == 1 &&
                     set_out < position.measured - arms_[arm.index()].report_age;
  if (position.motion != motion || again) position = {motion, set_out, set_out};
  if (position.at_rest) position.off_path = off(*motion, arm, position.measured);
  position.at_rest = false;
  position.authority = std::max(position.authority, authority);
  return position;
}

// Returns the arm's interval of progress on this side of a certificate, or nullopt if the side does
// not cover the arm.
std::optional<AuthorityGuard::Interval> AuthorityGuard::covers(const CertifiedSide& side, ArmId arm,
                                                               const ArmPosition& position) const {
  if (!position.is_known) return std::nullopt;
  const bool is_still = std::ranges::all_of(side.still, [&](const auto& joint) {
    const auto& [id, at] = joint;
    if (arm_of_[id.index()] && arm_of_[id.index()] != arm) return true;  // another arm's joint
    return std::abs(q_[id.value()] - at) <= side.error_of(arm);
  });
  if (!is_still) return std::nullopt;
  if (!side.motion) return position.at_rest ? std::optional(Interval{}) : std::nullopt;
  if (side.motion == position.motion) {
    const bool holds = side.from <= position.measured && position.error() <= side.error_of(arm);
    return holds ? std::optional(Interval{position.measured, position.authority}) : std::nullopt;
  }
  for (const Duration end : {Duration{}, side.motion->duration()}) {
    if (position.at_rest && side.from <= end && off(*side.motion, arm, end) <= side.error_of(arm))
      return Interval{end, end};
  }
  return std::nullopt;
}

bool AuthorityGuard::sees_scene(const Known& known, ArmId arm, const ArmPosition& own) const {
  return std::ranges::any_of(known.scene, [&](const SceneCertificate& scene) {
    const auto at = std::ranges::find(scene.side.arms, arm) - scene.side.arms.begin();
    return present_.of(scene.side.arms) == scene.geometry && covers(scene.side, arm, own) &&
           std::ranges::includes(scene.objects[at], present_.objects[arm.index()]);
  });
}

// Returns nullopt if a certificate proves that the two arms keep their clearance. Otherwise returns
// the conflict with the last certificate that covers both arms, or Why::uncertified if no
// certificate does.
std::optional<GuardRefusal> AuthorityGuard::between(const Known& known, ArmId arm,
                                                    const ArmPosition& own, ArmId other) const {
  GuardRefusal refusal{Why::uncertified, arm, other, {own.measured, own.authority}};
  const auto all = known.pairs.find(other);
  if (all == known.pairs.end()) return refusal;
  for (const PairCertificate& pair : all->second) {
    if (!is_valid(pair)) continue;
    const auto at = covers(pair.a, arm, own);
    const auto other_at = covers(pair.b, other, positions_[other.index()]);
    if (!at || !other_at) continue;
    const auto met = std::ranges::find_if(pair.blocked, [&](const ProgressBox& box) {
      return overlap(at->from, at->to, box.from_a, box.to_a) &&
             overlap(other_at->from, other_at->to, box.from_b, box.to_b);
    });
    if (met == pair.blocked.end()) return std::nullopt;
    refusal = {Why::region, arm, other, {at->from, at->to, other_at->from, other_at->to}, *met};
  }
  return refusal;
}

// Checks if the first arm of a motion may be at progress `first` while the last arm is at `last`.
std::optional<GuardRefusal> AuthorityGuard::together(const Known& known, Duration last,
                                                     Duration first) const {
  const auto& of = known.together;
  const bool holds = of && of->side.from <= last && present_.of(of->side.arms) == of->geometry;
  if (holds && first - last <= of->apart) return std::nullopt;
  const Why why = holds ? Why::out_of_step : Why::uncertified;
  return GuardRefusal{why, known.motion->arms().front(), {}, {last, first, last, first}};
}

std::optional<GuardRefusal> AuthorityGuard::refuses(const TrajectoryPtr& motion, From from,
                                                    Duration authority) const {
  const auto& arms = motion->arms();
  const auto of = motions_.find(motion.get());
  Duration last = motion->duration(), first{};
  for (const ArmId arm : arms) {
    const ArmPosition own = as_granted(motion, arm, from, authority);
    const ArmPosition& now = positions_[arm.index()];
    const bool is_busy = now.motion != motion && !now.at_rest;
    if (is_busy || of == motions_.end() || !sees_scene(of->second, arm, own)) {
      const Why why = is_busy ? Why::busy : Why::uncertified;
      return GuardRefusal{why, arm, {}, {own.measured, own.authority}};
    }
    for (std::uint32_t a = 0; a < positions_.size(); ++a) {
      const ArmId other{a};
      if (std::ranges::count(arms, other) > 0 || are_apart(arm, other)) continue;
      if (auto refusal = between(of->second, arm, own, other)) return refusal;
    }
    last = std::min(last, own.measured);
    first = std::max(first, own.measured);
  }
  return arms.size() > 1 ? together(of->second, last, first) : std::nullopt;
}

std::optional<GuardRefusal> AuthorityGuard::grant(const TrajectoryPtr& motion, From from,
                                                  Duration authority) {
  if (auto refusal = refuses(motion, from, authority)) return refusal;
  hold(motion, from, authority);
  return std::nullopt;
}

void AuthorityGuard::hold(const TrajectoryPtr& motion, From from, Duration authority) {
  for (const ArmId arm : motion->arms()) {
    const TrajectoryPtr before = positions_[arm.index()].motion;
    positions_[arm.index()] = as_granted(motion, arm, from, authority);
    drop_left(before.get());
  }
}

double AuthorityGuard::off_path(const TrajectoryPtr& motion, From from) const {
  double largest = 0.0;
  for (const ArmId arm : motion->arms()) {
    largest = std::max(largest, as_granted(motion, arm, from, Duration{}).off_path);
  }
  return largest;
}

}  // namespace armloom
