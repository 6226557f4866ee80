#include "core/collision/scene/swept_link.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace armloom {
namespace {

constexpr double kPi = std::numbers::pi;

Eigen::Isometry3d moved(const Link& link, double value) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  if (link.motion == JointKind::prismatic) {
    X.translation() = link.axis * value;
  } else {
    X.linear() = Eigen::AngleAxisd(value, link.axis).toRotationMatrix();
  }
  return X;
}

}  // namespace

SweptLink::SweptLink(const PlanningScene::Bodies& bodies, LinkId link, double beyond) {
  for (std::size_t i = 0; i < bodies.links_end; ++i) {
    const CollisionBody& body = bodies.bodies[i];
    if (body.link != link) continue;
    capsules_.insert(capsules_.end(), body.fitted.capsules.begin(), body.fitted.capsules.end());
  }
  std::vector<JointId> drivers;
  add_steps(*bodies.cell, link, drivers);
  add_intervals(*bodies.cell, drivers, beyond);
  bound_reach();
  place(parts_.front());
}

void SweptLink::add_steps(const Cell& cell, LinkId id, std::vector<JointId>& drivers) {
  std::vector<LinkId> from_root;
  for (auto next = std::optional(id); next; next = cell.link(*next).parent) {
    from_root.insert(from_root.begin(), *next);
  }
  const Configuration home = cell.home();
  for (const LinkId each : from_root) {
    const Link& link = cell.link(each);
    X_FL_ = X_FL_ * link.X_PJ;
    if (!link.driver) continue;
    if (!cell.joint(*link.driver).arm) {
      const double q = home[static_cast<Eigen::Index>(link.driver->index())];
      X_FL_ = X_FL_ * moved(link, link.multiplier * q + link.offset);
      continue;
    }
    auto row = std::ranges::find(drivers, *link.driver);
    if (row == drivers.end()) row = drivers.insert(row, *link.driver);
    steps_.push_back({.X_PJ = X_FL_,
                      .axis = link.axis,
                      .prismatic = link.motion == JointKind::prismatic,
                      .multiplier = link.multiplier,
                      .offset = link.offset,
                      .interval = static_cast<std::size_t>(row - drivers.begin())});
    X_FL_ = Eigen::Isometry3d::Identity();
  }
}

void SweptLink::add_intervals(const Cell& cell, const std::vector<JointId>& drivers,
                              double beyond) {
  Part& whole = parts_.emplace_back();
  for (std::size_t i = 0; i < drivers.size(); ++i) {
    const Joint& joint = cell.joint(drivers[i]);
    const double lower = std::max(joint.lower, -kFarthestPosition) - beyond;
    const double upper = std::min(joint.upper, kFarthestPosition) + beyond;
    Interval interval{0.5 * (lower + upper), 0.5 * (upper - lower)};
    // A full turn covers all poses of the link if only one step follows the joint, turns, and does
    // so at rate 1 or -1.
    const auto turns_by_itself = [&](const Step& step) {
      return step.interval != i || (!step.prismatic && std::abs(step.multiplier) == 1.0);
    };
    const bool once = std::ranges::count(steps_, i, &Step::interval) == 1;
    if (interval.half > kPi && once && std::ranges::all_of(steps_, turns_by_itself)) {
      interval = {0.0, kPi};
    }
    whole.intervals.push_back(interval);
  }
}

void SweptLink::bound_reach() {
  double reach_m = 0.0;
  for (const LinkCapsule& capsule : capsules_) {
    reach_m = std::max({reach_m, (X_FL_ * capsule.p_PA).norm() + capsule.radius_m,
                        (X_FL_ * capsule.p_PB).norm() + capsule.radius_m});
  }
  for (auto step = steps_.rbegin(); step != steps_.rend(); ++step) {
    if (step->prismatic) {
      const Interval& interval = parts_.front().intervals[step->interval];
      reach_m += std::abs(step->multiplier) * (std::abs(interval.center) + interval.half) +
                 std::abs(step->offset);
    }
    step->reach_m = reach_m;
    reach_m += step->X_PJ.translation().norm();
  }
}

// Returns the largest distance by which the step's joint moves a point that is far_m from its axis.
// All later joints are at the center of their intervals.
double SweptLink::shift(const Step& step, const Part& part, double far_m) const {
  const double half = std::abs(step.multiplier) * part.intervals[step.interval].half;
  if (step.prismatic) return half;
  return half >= kPi ? 2.0 * far_m : 2.0 * far_m * std::sin(0.5 * half);
}

// Bounds how far any point of the capsules moves from its place at the center of all intervals. Let
// the joints leave the center one after the other, from the root on. Each joint then turns the rest
// of the chain while all later joints are still at the center. So each joint moves a point at most
// as far as shift() says for the distance from its axis at the center. The sum over all joints is
// the bound.
void SweptLink::place(Part& part) const {
  std::vector<PlacedStep> placed;
  Eigen::Isometry3d X_WF = Eigen::Isometry3d::Identity();
  for (const Step& step : steps_) {
    X_WF = X_WF * step.X_PJ;
    placed.push_back({X_WF.translation(), X_WF.linear() * step.axis});
    const double value = step.multiplier * part.intervals[step.interval].center + step.offset;
    if (step.prismatic) {
      X_WF.translation() += placed.back().axis * value;
    } else {
      X_WF.linear() =
          (X_WF.linear() * Eigen::AngleAxisd(value, step.axis).toRotationMatrix()).eval();
    }
  }
  const Eigen::Isometry3d X_WL = X_WF * X_FL_;
  for (const LinkCapsule& capsule : capsules_) {
    const Eigen::Vector3d a = X_WL * capsule.p_PA;
    const Eigen::Vector3d b = X_WL * capsule.p_PB;
    part.capsules.push_back({{0.5 * (a + b), 0.5 * (b - a)}, capsule.radius_m});
  }
  std::vector<double> moved_m(part.intervals.size(), 0.0);
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    double far_m = 0.0;
    for (const Part::Segment& capsule : part.capsules) {
      const CenteredSegment& line = capsule.line;
      far_m = std::max({far_m, placed[i].far(line.center + line.half) + capsule.radius_m,
                        placed[i].far(line.center - line.half) + capsule.radius_m});
    }
    const double way_m = shift(steps_[i], part, far_m);
    part.motion_m += way_m;
    moved_m[steps_[i].interval] += way_m;
  }
  if (!moved_m.empty()) {
    part.widest = static_cast<std::size_t>(std::ranges::max_element(moved_m) - moved_m.begin());
  }
  enclose(part, placed);
}

// Sets part.ball to the smallest of several balls. One encloses the capsules and their motion. One
// per joint is centered at the joint's origin, and covers the link's reach from there and the
// origin's own motion.
void SweptLink::enclose(Part& part, const std::vector<PlacedStep>& placed) const {
  part.ball = {part.capsules.front().line.center, 0.0};
  for (const Part::Segment& capsule : part.capsules) {
    const double ends_m =
        (capsule.line.center - part.ball.center).norm() + capsule.line.half.norm();
    part.ball.radius_m = std::max(part.ball.radius_m, ends_m + capsule.radius_m + part.motion_m);
  }
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    double radius_m = steps_[k].reach_m;
    for (std::size_t i = 0; i < k; ++i) {
      radius_m += shift(steps_[i], part, placed[i].far(placed[k].p));
    }
    if (radius_m < part.ball.radius_m) part.ball = {placed[k].p, radius_m};
  }
}

std::optional<std::size_t> SweptLink::halve(std::size_t number) {
  if (parts_[number].halves != 0) return parts_[number].halves;
  if (parts_[number].motion_m < kFinest_m || parts_.size() + 2 > kPartsMax) return std::nullopt;
  const std::size_t widest = parts_[number].widest;
  const Interval interval = parts_[number].intervals[widest];
  parts_[number].halves = parts_.size();
  for (const double side : {-0.5, 0.5}) {
    Part half{.intervals = parts_[number].intervals, .capsules = {}, .ball = {}};
    half.intervals[widest] = {interval.center + side * interval.half, 0.5 * interval.half};
    place(half);
    parts_.push_back(std::move(half));
  }
  return parts_[number].halves;
}

PartGap gap_between(const SweptLink::Part& a, const SweptLink::Part& b) {
  double at_centers_m = std::numeric_limits<double>::infinity();
  for (const auto& x : a.capsules) {
    for (const auto& y : b.capsules) {
      const double gap_m = segment_segment_distance(x.line, y.line) - x.radius_m - y.radius_m;
      at_centers_m = std::min(at_centers_m, gap_m);
    }
  }
  const double balls_m = (a.ball.center - b.ball.center).norm() - a.ball.radius_m - b.ball.radius_m;
  return {std::max(at_centers_m - a.motion_m - b.motion_m, balls_m), at_centers_m};
}

}  // namespace armloom
