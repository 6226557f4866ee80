#include "core/guard/authority_guard.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace armloom {
namespace {

bool contains(const std::vector<ArmId>& arms, ArmId arm) {
  return std::ranges::find(arms, arm) != arms.end();
}

// A state on the edge of a rectangle is certified by the free state beside it; of two rectangles
// side by side a stretch meets one of them inside. So only where an arm rests, or a rectangle has
// no width, the edge counts.
bool overlap(Duration from, Duration to, Duration box_from, Duration box_to) {
  if (from < to && box_from < box_to) return box_from < to && from < box_to;
  return box_from <= to && from <= box_to;
}

// The first rectangle that the product meets.
template <class Interval>
std::optional<ProgressBox> first_met(const std::vector<ProgressBox>& boxes, const Interval& a,
                                     const Interval& b) {
  const auto met = std::ranges::find_if(boxes, [&](const ProgressBox& box) {
    return overlap(a.from, a.to, box.from_a, box.to_a) &&
           overlap(b.from, b.to, box.from_b, box.to_b);
  });
  return met == boxes.end() ? std::nullopt : std::optional(*met);
}

template <class T>
void keep_latest(std::vector<T>& all, T one, std::size_t most) {
  if (all.size() >= most) all.erase(all.begin());
  all.push_back(std::move(one));
}

ProgressBox turned(const ProgressBox& box) { return {box.from_b, box.to_b, box.from_a, box.to_a}; }

}  // namespace

AuthorityGuard::AuthorityGuard(std::vector<std::vector<JointId>> joints, Configuration rest,
                               SceneFingerprint present)
    : joints_(std::move(joints)),
      arm_of_(static_cast<std::size_t>(rest.size())),
      q_(std::move(rest)),
      present_(std::move(present)),
      positions_(joints_.size()) {
  for (std::uint32_t arm = 0; arm < joints_.size(); ++arm) {
    for (const JointId joint : joints_[arm]) arm_of_[joint.index()] = ArmId{arm};
  }
}

// ---- Certificates ----

void AuthorityGuard::take(std::span<const Certificate> certificates) {
  ++taken_;
  for (const Certificate& certificate : certificates) {
    if (const auto* pair = std::get_if<PairCertificate>(&certificate)) {
      take(*pair);
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

// For each side that moves. Of the same two sides the first one stays, which orders were made by,
// and the latest.
void AuthorityGuard::take(const PairCertificate& pair) {
  const auto taken = std::make_shared<const PairCertificate>(pair);
  for (const auto& [own, other] : {std::pair(&pair.a, &pair.b), std::pair(&pair.b, &pair.a)}) {
    if (!own->motion) continue;
    for (const ArmId arm : other->arms) {
      auto& all = known(own->motion).pairs[arm];
      std::erase_if(all,
                    [&](const PairPtr& old) { return !is_valid(old->a, &old->b, old->geometry); });
      const auto is_same = [&](const PairPtr& old) {
        const CertifiedSide& side = old->a.motion == own->motion ? old->b : old->a;
        return side.motion == other->motion && side.still == other->still;
      };
      const auto first = std::ranges::find_if(all, is_same);
      const auto second = first == all.end() ? first : std::find_if(first + 1, all.end(), is_same);
      if (second != all.end()) all.erase(second);
      keep_latest(all, taken, kPairsKept);
    }
  }
}

AuthorityGuard::Known& AuthorityGuard::known(const TrajectoryPtr& motion) {
  Known& of = motions_[motion.get()];
  of.motion = motion;
  of.taken_at = taken_;
  return of;
}

void AuthorityGuard::forget(const TrajectoryPtr& motion) {
  const auto of = motions_.find(motion.get());
  if (of == motions_.end()) return;
  of->second.is_forgotten = true;
  if (!is_on(motion.get())) drop(of);
}

void AuthorityGuard::drop(std::unordered_map<const Trajectory*, Known>::iterator known) {
  const TrajectoryPtr motion = known->second.motion;
  const auto pairs = std::move(known->second.pairs);
  motions_.erase(known);
  for (const auto& [arm, all] : pairs) {
    for (const PairPtr& pair : all) {
      const TrajectoryPtr& other = pair->a.motion == motion ? pair->b.motion : pair->a.motion;
      const auto of = motions_.find(other.get());
      if (of == motions_.end()) continue;
      for (const ArmId own : motion->arms()) std::erase(of->second.pairs[own], pair);
    }
  }
}

// Motions that were asked about and never started, as ways aside that were not taken.
void AuthorityGuard::drop_old() {
  while (motions_.size() > kMotionsKept * positions_.size()) {
    auto oldest = motions_.end();
    for (auto of = motions_.begin(); of != motions_.end(); ++of) {
      if (is_on(of->first)) continue;
      if (oldest == motions_.end() || of->second.taken_at < oldest->second.taken_at) oldest = of;
    }
    if (oldest == motions_.end()) return;
    drop(oldest);
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

void AuthorityGuard::rests(ArmId arm, Duration progress, const Configuration& measured) {
  ArmPosition& position = positions_[arm.index()];
  if (position.motion) {
    position.measured = std::max(position.measured, progress);
    position.authority = position.measured;
  }
  position.at_rest = true;
  for (const JointId joint : joints_[arm.index()]) {
    const auto j = static_cast<Eigen::Index>(joint.index());
    q_[j] = measured[j];
  }
}

// ---- The gate ----

bool AuthorityGuard::is_valid(const CertifiedSide& a, const CertifiedSide* b,
                              Fingerprint geometry) const {
  std::vector<ArmId> arms = a.arms;
  if (b != nullptr) arms.insert(arms.end(), b->arms.begin(), b->arms.end());
  std::ranges::sort(arms);
  return present_.of(arms) == geometry;
}

// How far the arm's joints, as last seen at rest, are from the motion there. rad, m.
double AuthorityGuard::off(const Trajectory& motion, ArmId arm, Duration progress) const {
  Eigen::VectorXd at;
  motion.sample_positions(progress, at);
  double largest = 0.0;
  for (std::size_t row = 0; row < motion.joints().size(); ++row) {
    const JointId joint = motion.joints()[row];
    if (arm_of_[joint.index()] != arm) continue;
    largest = std::max(largest, std::abs(q_[static_cast<Eigen::Index>(joint.index())] -
                                         at[static_cast<Eigen::Index>(row)]));
  }
  return largest;
}

ArmPosition AuthorityGuard::as_granted(const TrajectoryPtr& motion, ArmId arm, Duration from,
                                       Duration authority) const {
  ArmPosition position = positions_[arm.index()];
  if (position.motion != motion) position = {.motion = motion, .measured = from, .authority = from};
  if (position.at_rest) position.off_path = off(*motion, arm, position.measured);
  position.at_rest = false;
  position.authority = std::max(position.authority, authority);
  return position;
}

// Where the arm is on this side of a certificate; nullopt if that says nothing about it there.
std::optional<AuthorityGuard::Interval> AuthorityGuard::covers(const CertifiedSide& side, ArmId arm,
                                                               const ArmPosition& position) const {
  const bool is_still = std::ranges::all_of(side.still, [&](const auto& joint) {
    const auto& [id, at] = joint;
    if (arm_of_[id.index()] && arm_of_[id.index()] != arm) return true;  // of a sibling
    return std::abs(q_[static_cast<Eigen::Index>(id.index())] - at) <= side.error;
  });
  if (!is_still) return std::nullopt;
  if (!side.motion) return position.at_rest ? std::optional(Interval{}) : std::nullopt;
  if (side.motion == position.motion) {
    const bool holds = side.from <= position.measured && position.off_path <= side.error;
    return holds ? std::optional(Interval{position.measured, position.authority}) : std::nullopt;
  }
  if (!position.at_rest) return std::nullopt;
  for (const Duration end : {Duration{}, side.motion->duration()}) {
    if (side.from <= end && off(*side.motion, arm, end) <= side.error) return Interval{end, end};
  }
  return std::nullopt;
}

bool AuthorityGuard::sees_scene(const Known& known, ArmId arm, const ArmPosition& own) const {
  return std::ranges::any_of(known.scene, [&](const SceneCertificate& scene) {
    return is_valid(scene.side, nullptr, scene.geometry) && covers(scene.side, arm, own) &&
           std::ranges::includes(scene.objects, present_.objects);
  });
}

AuthorityGuard::Answer AuthorityGuard::between(const Known& known, ArmId arm,
                                               const ArmPosition& own, ArmId other) const {
  Answer answer;
  const auto all = known.pairs.find(other);
  if (all == known.pairs.end()) return answer;
  for (const PairPtr& pair : all->second) {
    const bool is_a = pair->a.motion == known.motion;
    const CertifiedSide& side = is_a ? pair->a : pair->b;
    const CertifiedSide& other_side = is_a ? pair->b : pair->a;
    if (!is_valid(pair->a, &pair->b, pair->geometry)) continue;
    const auto at = covers(side, arm, own);
    const auto other_at = covers(other_side, other, positions_[other.index()]);
    if (!at || !other_at) continue;
    const auto met =
        is_a ? first_met(pair->blocked, *at, *other_at) : first_met(pair->blocked, *other_at, *at);
    answer.covered = true;
    answer.other = *other_at;
    if (!met) return {.covered = true, .free = true, .other = *other_at};
    answer.met = is_a ? *met : turned(*met);
  }
  return answer;
}

std::optional<GuardRefusal> AuthorityGuard::refuses(const TrajectoryPtr& motion, Duration from,
                                                    Duration authority) const {
  using Why = GuardRefusal::Why;
  const auto& arms = motion->arms();
  const auto of = motions_.find(motion.get());
  Duration last = motion->duration(), first{};
  for (const ArmId arm : arms) {
    const ArmPosition own = as_granted(motion, arm, from, authority);
    const auto refusal = [&](Why why, std::optional<ArmId> other = {}, const Answer& answer = {}) {
      return GuardRefusal{why,
                          arm,
                          other,
                          {own.measured, own.authority, answer.other.from, answer.other.to},
                          answer.met};
    };
    const ArmPosition& now = positions_[arm.index()];
    if (now.motion != motion && !now.at_rest) return refusal(Why::busy);
    if (of == motions_.end() || !sees_scene(of->second, arm, own)) return refusal(Why::uncertified);
    for (std::uint32_t a = 0; a < positions_.size(); ++a) {
      const ArmId other{a};
      if (contains(arms, other)) continue;
      const auto apart = apart_.find(std::minmax(arm, other));
      if (apart != apart_.end() &&
          apart->second == present_.of({std::min(arm, other), std::max(arm, other)})) {
        continue;
      }
      const Answer answer = between(of->second, arm, own, other);
      if (!answer.free) {
        return refusal(answer.covered ? Why::region : Why::uncertified, other, answer);
      }
    }
    last = std::min(last, own.measured);
    first = std::max(first, own.measured);
  }
  if (arms.size() == 1) return std::nullopt;
  const auto& together = of->second.together;
  const bool holds = together && together->side.from <= last &&
                     is_valid(together->side, nullptr, together->geometry);
  const GuardRefusal apart{holds ? Why::out_of_step : Why::uncertified,
                           arms.front(),
                           std::nullopt,
                           {last, authority, first, authority},
                           std::nullopt};
  return holds && first - last <= together->apart ? std::nullopt : std::optional(apart);
}

std::optional<GuardRefusal> AuthorityGuard::grant(const TrajectoryPtr& motion, Duration from,
                                                  Duration authority) {
  if (auto refusal = refuses(motion, from, authority)) return refusal;
  hold(motion, from, authority);
  return std::nullopt;
}

void AuthorityGuard::hold(const TrajectoryPtr& motion, Duration from, Duration authority) {
  for (const ArmId arm : motion->arms()) {
    const TrajectoryPtr before = positions_[arm.index()].motion;
    positions_[arm.index()] = as_granted(motion, arm, from, authority);
    const auto of = motions_.find(before.get());
    const bool is_left = of != motions_.end() && of->second.is_forgotten && !is_on(before.get());
    if (is_left) drop(of);
  }
}

double AuthorityGuard::off_path(const TrajectoryPtr& motion, Duration from) const {
  double largest = 0.0;
  for (const ArmId arm : motion->arms()) {
    largest = std::max(largest, as_granted(motion, arm, from, from).off_path);
  }
  return largest;
}

}  // namespace armloom
