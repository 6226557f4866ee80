#include "test/guard/chaos.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace armloom {
namespace {

constexpr double kSpeed_m_s = 0.5;
constexpr double kTracking_m = 0.001;
constexpr double kObject_m = 0.05;  // radius
// Largest lag between arms of one motion that the executive allows.
constexpr Duration kInStep = std::chrono::milliseconds(50);

TrajectoryPtr motion_of(const Cell& cell, const std::vector<ArmId>& arms,
                        const std::vector<double>& from, const std::vector<double>& to) {
  std::vector<JointId> joints;
  double farthest_m = 0.01;
  for (std::size_t i = 0; i < arms.size(); ++i) {
    joints.push_back(cell.arm(arms[i]).joints[0]);
    farthest_m = std::max(farthest_m, std::abs(to[i] - from[i]));
  }
  const Duration takes = from_seconds(farthest_m / kSpeed_m_s);
  Segment segment{Duration{}, takes, {}};
  segment.coefficients.setZero(static_cast<Eigen::Index>(joints.size()), 6);
  for (std::size_t i = 0; i < arms.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    segment.coefficients(row, 0) = from[i];
    segment.coefficients(row, 1) = (to[i] - from[i]) / to_seconds(takes);
  }
  return std::make_shared<const Trajectory>(joints, arms, std::vector<Segment>{segment});
}

double on_path(const Trajectory& motion, JointId joint, Duration progress) {
  Eigen::VectorXd position;
  motion.sample_positions(progress, position);
  return position[std::ranges::find(motion.joints(), joint) - motion.joints().begin()];
}

std::vector<AuthorityGuard::GuardedArm> guarded_arms(const Cell& cell) {
  std::vector<AuthorityGuard::GuardedArm> arms;
  for (const Arm& arm : cell.arms) arms.push_back({arm.joints});
  return arms;
}

}  // namespace

RailCell::RailCell(std::size_t arms) {
  const std::vector<std::pair<Eigen::Vector3d, double>> all{
      {{0, 0, 0}, 0.0}, {{0, 0, 0}, 90.0}, {{0.1, 0, 0}, 45.0}, {{0, 0.1, 0}, 135.0}};
  Cell made;
  made.clearances.clearance_m = kClearance_m;
  for (std::size_t a = 0; a < arms; ++a) {
    const auto& [through, degrees] = all[a];
    Eigen::Isometry3d X_WB = small::at_xyz(through.x(), through.y(), 0);
    X_WB.linear() = Eigen::AngleAxisd(degrees / 180 * small::kHalfTurn, Eigen::Vector3d::UnitZ())
                        .toRotationMatrix();
    const ArmId arm = small::add_robot(made, "arm" + std::to_string(a), X_WB,
                                       {Eigen::Vector3d::UnitX()}, {0.0, kRadius_m});
    Joint& joint = made.joints.back();
    joint.kind = JointKind::prismatic;
    joint.lower = -2.0;
    joint.upper = 2.0;
    Link& link = made.links.back();
    link.motion = JointKind::prismatic;
    link.shapes.clear();
    small::add_shape(link, Sphere{kRadius_m}, small::at_xyz(0, 0, 0));
    made.arms[arm.index()].home[0] = -kEnd_m;
    begins.push_back(X_WB.translation());
    along.push_back(X_WB.linear().col(0));
  }
  cell = small::shared(std::move(made));
  scene = *PlanningScene::build(cell);
}

Eigen::Vector3d RailCell::center(ArmId arm, double q) const {
  return begins[arm.index()] + q * along[arm.index()];
}

Chaos::Chaos(const RailCell& rails, MotionChecker& checker, std::uint64_t seed, bool guarded)
    : rails_(rails),
      checker_(checker),
      random_(seed),
      guarded_(guarded),
      scene_(rails.scene),
      arms_(rails.cell->arms.size(), RailArm{.q = -RailCell::kEnd_m}),
      guard_(guarded_arms(*rails.cell), rails.cell->home(), rails.scene->fingerprint()) {
  checker_.look_at(scene_);
}

std::size_t Chaos::pick(std::size_t below) { return static_cast<std::size_t>(random_() % below); }
double Chaos::share() { return static_cast<double>(random_() >> 11U) * 0x1.0p-53; }

Configuration Chaos::where() const {
  Configuration q(static_cast<Eigen::Index>(arms_.size()));
  for (std::size_t a = 0; a < arms_.size(); ++a) q[static_cast<Eigen::Index>(a)] = arms_[a].q;
  return q;
}

Chaos::Outcome Chaos::run(int steps) {
  for (int i = 0; i < steps; ++i) step();
  return std::move(outcome_);
}

void Chaos::step() {
  const double what = share();
  if (what < 0.40) return advance();
  if (what < 0.60) return extend();
  if (what < 0.80) return begin();
  if (what < 0.88) return stop();
  if (what < 0.94) return resume();
  if (what < 0.97) return forget();
  change_scene();
}

void Chaos::begin() {
  std::vector<ArmId> arms;
  for (std::uint32_t a = 0; a < arms_.size(); ++a) {
    if (arms_[a].stopped) arms.emplace_back(a);
  }
  if (arms.empty()) return;
  std::ranges::shuffle(arms, random_);
  arms.erase(arms.begin() + (arms.size() > 1 && chance(0.15) ? 2 : 1), arms.end());
  std::ranges::sort(arms);
  std::vector<double> from, to;
  for (const ArmId arm : arms) {
    // The motion mostly starts at the arm's position, sometimes up to 5 mm away.
    from.push_back(at(arm).q + (chance(0.05) ? 0.01 * (share() - 0.5) : 0.0));
    to.push_back(RailCell::kEnd_m * (2 * share() - 1));
  }
  const TrajectoryPtr motion = motion_of(*rails_.cell, arms, from, to);
  if (chance(0.95)) ask(motion, {});
  grant(motion, {}, from_seconds(share() * to_seconds(motion->duration())));
}

// Asks the checker. Its answer may be used late or never.
void Chaos::ask(const TrajectoryPtr& motion, Duration from) {
  Question question{.version = 0,
                    .start_at = {},
                    .candidates = {Motion{StepId{JobId{1}}, motion, from}},
                    .others = {},
                    .rest = where(),
                    .method = Coordinated{kTracking_m}};
  std::uint64_t job = 2;
  for (std::uint32_t a = 0; a < arms_.size(); ++a) {
    const RailArm& other = arms_[a];
    const bool is_own = std::ranges::find(motion->arms(), ArmId{a}) != motion->arms().end();
    if (is_own || !other.motion || chance(0.1)) continue;
    const bool is_there = std::ranges::any_of(
        question.others, [&](const Motion& known) { return known.trajectory == other.motion; });
    const bool shares_arm = std::ranges::any_of(other.motion->arms(), [&](ArmId arm) {
      return std::ranges::find(motion->arms(), arm) != motion->arms().end();
    });
    if (!is_there && !shares_arm) {
      question.others.push_back(Motion{StepId{JobId{job++}}, other.motion, other.progress});
    }
  }
  Verdict verdict = checker_.judge(question);
  if (chance(0.9)) {
    guard_.take(verdict.certificates);
  } else {
    old_ = std::move(verdict.certificates);
  }
}

void Chaos::grant(const TrajectoryPtr& motion, Duration from, Duration authority) {
  if (guarded_ && guard_.grant(motion, from, authority)) {
    ++outcome_.refusals;
    return;
  }
  ++outcome_.grants;
  for (const ArmId arm : motion->arms()) {
    RailArm& own = at(arm);
    if (own.motion != motion) own.progress = own.authority = from;
    own.motion = motion;
    own.authority = std::max(own.authority, authority);
    own.stopped = false;
  }
}

void Chaos::extend() {
  const RailArm& own = at(any_arm());
  if (!own.motion || own.stopped) return;
  if (chance(0.2)) ask(own.motion, own.progress);
  if (chance(0.2)) guard_.take(old_);
  const double left = to_seconds(own.motion->duration() - own.authority);
  grant(own.motion, own.progress, own.authority + from_seconds(share() * std::max(0.0, left)));
}

void Chaos::resume() {
  const RailArm& own = at(any_arm());
  if (!own.motion || !own.stopped || own.progress >= own.motion->duration()) return;
  const bool all_stand = std::ranges::all_of(own.motion->arms(), [&](ArmId arm) {
    return at(arm).stopped && at(arm).motion == own.motion;
  });
  if (!all_stand) return;
  const TrajectoryPtr motion = own.motion;
  grant(motion, own.progress,
        own.progress + from_seconds(share() * to_seconds(motion->duration() - own.progress)));
}

// Brakes a random motion on its path before its authority ends. Arms of one motion stay in step.
void Chaos::stop() {
  const TrajectoryPtr motion = at(any_arm()).motion;
  if (!motion || at(motion->arms().front()).motion != motion) return;
  const RailArm& leader = at(motion->arms().front());
  const Duration reach =
      from_seconds(0.3 * share() * to_seconds(leader.authority - leader.progress));
  for (const ArmId arm : motion->arms()) {
    RailArm& own = at(arm);
    if (own.motion != motion || own.stopped) continue;
    own.progress = std::min(own.progress + reach, own.authority);
    come_to_rest(arm);
  }
  look();
}

void Chaos::forget() {
  const RailArm& own = at(any_arm());
  if (own.motion) guard_.forget(own.motion);
}

void Chaos::advance() {
  for (std::size_t a = 0; a < arms_.size(); ++a) {
    const RailArm& own = arms_[a];
    if (own.motion && !own.stopped && own.motion->arms().front().index() == a) advance(own.motion);
  }
}

void Chaos::advance(const TrajectoryPtr& motion) {
  Duration last = motion->duration();
  for (const ArmId arm : motion->arms()) last = std::min(last, at(arm).progress);
  const bool together = motion->arms().size() > 1;
  Duration next =
      last + from_seconds(share() * to_seconds(at(motion->arms().front()).authority - last));
  for (const ArmId arm : motion->arms()) {
    RailArm& own = at(arm);
    if (own.motion != motion || own.stopped) continue;
    const Duration lag = together ? from_seconds(share() * to_seconds(kInStep)) : Duration{};
    own.progress = std::clamp(next - lag, own.progress, own.authority);
    guard_.moves(arm, own.progress);
    if (own.progress >= motion->duration()) come_to_rest(arm);
  }
  ++outcome_.advances;
  look();
}

void Chaos::come_to_rest(ArmId arm) {
  RailArm& own = at(arm);
  own.stopped = true;
  own.authority = own.progress;
  own.q = on_path(*own.motion, rails_.cell->arm(arm).joints[0], own.progress);
  guard_.rests(arm, own.progress, where());
}

void Chaos::change_scene() {
  if (!std::ranges::all_of(arms_, &RailArm::stopped)) return;
  std::vector<CollisionObject> objects;
  object_.reset();
  if (chance(0.8)) {
    object_ = Eigen::Vector3d(2 * share() - 1, 2 * share() - 1, 0);
    for (std::uint32_t a = 0; a < arms_.size(); ++a) {
      const double apart_m = (rails_.center(ArmId{a}, arms_[a].q) - *object_).norm();
      if (apart_m < RailCell::kRadius_m + kObject_m + 2 * RailCell::kClearance_m) object_.reset();
      if (!object_) break;
    }
  }
  if (object_) {
    CollisionObject ball{.name = "ball", .shape = Sphere{kObject_m}};
    ball.X_WO.translation() = *object_;
    objects.push_back(std::move(ball));
  }
  scene_ = *rails_.scene->with_objects(std::move(objects));
  checker_.look_at(scene_);
  guard_.look_at(scene_->fingerprint());
}

void Chaos::look() {
  for (std::uint32_t a = 0; a < arms_.size(); ++a) {
    RailArm& own = arms_[a];
    if (own.motion) {
      own.q = on_path(*own.motion, rails_.cell->arm(ArmId{a}).joints[0], own.progress);
    }
    const Eigen::Vector3d center = rails_.center(ArmId{a}, own.q);
    if (object_) {
      outcome_.closest_m = std::min(outcome_.closest_m,
                                    (center - *object_).norm() - RailCell::kRadius_m - kObject_m);
    }
  }
  for (std::uint32_t a = 0; a < arms_.size(); ++a) {
    for (std::uint32_t b = a + 1; b < arms_.size(); ++b) {
      const double apart_m =
          (rails_.center(ArmId{a}, arms_[a].q) - rails_.center(ArmId{b}, arms_[b].q)).norm();
      outcome_.closest_m = std::min(outcome_.closest_m, apart_m - 2 * RailCell::kRadius_m);
    }
  }
  outcome_.states.push_back(where());
}

}  // namespace armloom
