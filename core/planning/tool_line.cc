#include "core/planning/tool_line.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "core/collision/check/line_checker.h"
#include "core/collision/check/motion_checker.h"
#include "core/planning/nearest_free.h"
#include "core/planning/pose_descent.h"
#include "core/planning/shorten.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

using Reason = PlanRefusal::Reason;

// The link moves about this far between samples.
constexpr double kLook_m = 1e-4;
constexpr double kLook_rad = 1e-3;
// Maximum deviation at softened corners of the joints' path (TimingOptions::off_path, rad or m).
// Even for a long arm, the link then deviates by less than a tenth of the tolerance.
constexpr double kOffPath = 1e-4;

class ToolLine {
 public:
  ToolLine(const Cell& cell, const PoseGoal& goal, const Configuration& at)
      : cell_(cell), goal_(goal), arm_(cell.arm(goal.arm)), at_(at) {
    from_ = pose_at(joints_of(at, arm_.joints));
    const Eigen::AngleAxisd turn(from_.linear().transpose() * goal.X_WL.linear());
    axis_ = turn.axis();
    angle_ = turn.angle();
    length_ = (goal.X_WL.translation() - from_.translation()).norm();
  }

  [[nodiscard]] tl::expected<std::vector<Eigen::VectorXd>, PlanRefusal> follow() {
    const auto chain = chain_to(cell_, goal_.arm, goal_.link, X_WL_);
    if (!chain) {
      return tl::unexpected(PlanRefusal{Reason::goal_not_reached,
                                        "link " + cell_.link(goal_.link).name +
                                            " is not moved by the joints of arm " + arm_.name});
    }
    // Bounds the number of steps, also for lines longer than any arm.
    const double steps =
        std::min(1e6, std::max(length_ / kLineStep_m, std::abs(angle_) / kLineStep_rad));
    const int count = std::max(4, static_cast<int>(std::ceil(steps)));
    std::vector<Eigen::VectorXd> points{joints_of(at_, arm_.joints)};
    for (int i = 1; i <= count; ++i) {
      const double share = static_cast<double>(i) / count;
      Eigen::VectorXd q = descend(cell_, arm_, *chain, along(share), points.back());
      if (auto broken = break_at(share, points.back(), q)) {
        broken->nearest = points.back();
        return tl::unexpected(*std::move(broken));
      }
      points.push_back(std::move(q));
    }
    return points;
  }

  // Returns a refusal if the motion leaves the line. The deviation between two samples is at most
  // that of the nearer sample plus half of the link's motion between them.
  [[nodiscard]] std::optional<PlanRefusal> leaves(const Trajectory& motion,
                                                  const std::vector<Eigen::VectorXd>& points) {
    const double looks = std::max({length_ / kLook_m, std::abs(angle_) / kLook_rad, 100.0});
    const auto count = static_cast<std::int64_t>(std::ceil(looks));
    Eigen::VectorXd q;
    Eigen::Isometry3d before = from_;
    for (std::int64_t i = 1; i <= count; ++i) {
      motion.sample_positions(motion.duration() * i / count, q);
      const Eigen::Isometry3d here = pose_at(q);
      const double goes_m = (here.translation() - before.translation()).norm();
      const double goes_rad =
          Eigen::AngleAxisd(before.linear().transpose() * here.linear()).angle();
      const double share = share_of(here);
      const Eigen::Isometry3d off = along(share).inverse() * here;
      const double off_m = off.translation().norm() + goes_m / 2;
      const double off_rad = Eigen::AngleAxisd(off.linear()).angle() + goes_rad / 2;
      if (off_m > kLineWithin_m || off_rad > kLineWithin_rad) {
        PlanRefusal left =
            refusal(share, "the link may leave the line by " + text(1e3 * off_m) + " mm and " +
                               text(off_rad) + " rad; " + text(1e3 * kLineWithin_m) + " mm and " +
                               text(kLineWithin_rad) + " rad are allowed");
        const auto steps = static_cast<double>(points.size() - 1);
        left.nearest = points[static_cast<std::size_t>(share * steps)];
        return left;
      }
      before = here;
    }
    return std::nullopt;
  }

  // Returns a refusal whose text states this share of the line (0 to 1).
  [[nodiscard]] PlanRefusal refusal(double share, const std::string& why) const {
    const std::string& link = cell_.link(goal_.link).name;
    PlanRefusal broken{Reason::line_broken, link + ", " + place(share) + ": " + why};
    broken.link = link;
    return broken;
  }
  // Describes where on the line the link is at the time `when`.
  [[nodiscard]] std::string place_of(const Trajectory& motion, Duration when) {
    Eigen::VectorXd q;
    motion.sample_positions(when, q);
    return place(share_of(pose_at(q)));
  }

 private:
  [[nodiscard]] Eigen::Isometry3d along(double share) const {
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.translation() =
        from_.translation() + share * (goal_.X_WL.translation() - from_.translation());
    X.linear() = from_.linear() * Eigen::AngleAxisd(share * angle_, axis_).toRotationMatrix();
    return X;
  }

  // Returns the share of the line (0 to 1) up to a pose near the line. If the link only turns, it
  // is the share of the angle.
  [[nodiscard]] double share_of(const Eigen::Isometry3d& X) const {
    double share = 0.0;
    if (length_ > kLineWithin_m) {
      const Eigen::Vector3d way = goal_.X_WL.translation() - from_.translation();
      share = way.dot(X.translation() - from_.translation()) / way.squaredNorm();
    } else if (angle_ > kLineWithin_rad) {
      const Eigen::AngleAxisd turned(from_.linear().transpose() * X.linear());
      share = turned.angle() * turned.axis().dot(axis_) / angle_;
    }
    return std::clamp(share, 0.0, 1.0);
  }

  Eigen::Isometry3d pose_at(const Eigen::VectorXd& q) {
    Configuration whole = at_;
    set_joints(whole, arm_.joints, q);
    forward_kinematics(cell_, whole, X_WL_);
    return X_WL_[goal_.link.index()];
  }

  [[nodiscard]] std::optional<PlanRefusal> break_at(double share, const Eigen::VectorXd& before,
                                                    const Eigen::VectorXd& q) {
    Eigen::Index farthest = 0;
    const double jump = (q - before).cwiseAbs().maxCoeff(&farthest);
    const Joint& joint = cell_.joint(arm_.joints[static_cast<std::size_t>(farthest)]);
    if (jump > kLineJump || !q.allFinite()) {
      return refusal(share, joint.name + " would have to jump by " + text(jump) + " " +
                                joint.unit() + " within one step: the line passes a singularity");
    }
    const Eigen::Isometry3d off = along(share).inverse() * pose_at(q);
    const double off_rad = Eigen::AngleAxisd(off.linear()).angle();
    if (off.translation().norm() <= kPoseWithin_m && off_rad <= kPoseWithin_rad) return {};
    for (Eigen::Index j = 0; j < q.size(); ++j) {
      const Joint& at = cell_.joint(arm_.joints[static_cast<std::size_t>(j)]);
      if (q[j] > at.lower && q[j] < at.upper) continue;
      return refusal(share, at.name + " is at its limit there");
    }
    return refusal(share, "the arm cannot reach farther");
  }

  [[nodiscard]] static std::string text(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
  }
  [[nodiscard]] std::string place(double share) const {
    char text[96];
    std::snprintf(text, sizeof text, "after %.3f of %.3f m of the straight line (%.0f %%)",
                  share * length_, length_, 100 * share);
    return text;
  }
  const Cell& cell_;
  const PoseGoal& goal_;
  const Arm& arm_;
  const Configuration& at_;
  LinkPoses X_WL_;
  Eigen::Isometry3d from_;
  Eigen::Vector3d axis_;
  double angle_ = 0.0;
  double length_ = 0.0;
};

// Returns the last point up to which the arm keeps its clearances, or nullopt if it does not keep
// them at the first point.
NearestFree last_free(const PlanningScenePtr& scene, const PlanRequest& request,
                      const std::vector<Eigen::VectorXd>& points) {
  LineChecker lines(scene, request.arm, request.at, TrackingErrors(scene->cell()),
                    request.left_out);
  std::optional<Eigen::VectorXd> last;
  for (const Eigen::VectorXd& q : points) {
    if (!lines.is_free(last.value_or(q), q)) break;
    last = q;
  }
  return {std::move(last), lines.evaluations()};
}

PlanRefusal blocked_by(const Conflict& found, const std::string& place, NearestFree nearest) {
  const std::string what = found.proximity.body_a.empty() ? "clearance could not be certified"
                                                          : in_words(found.proximity);
  PlanRefusal blocked{Reason::line_blocked, what + ", " + place};
  if (!found.proximity.body_a.empty()) blocked.proximity = found.proximity;
  blocked.nearest = std::move(nearest.q);
  blocked.evaluations = nearest.evaluations;
  return blocked;
}

}  // namespace

tl::expected<PlannedMotion, PlanRefusal> plan_line(const PlanningScenePtr& scene,
                                                   const PoseGoal& goal, const PlanRequest& request,
                                                   const TimingOptions& options) {
  const Cell& cell = scene->cell();
  ToolLine line(cell, goal, request.at);
  auto points = line.follow();
  if (!points) return tl::unexpected(std::move(points.error()));
  const auto& joints = cell.arm(goal.arm).joints;
  const TimingOptions close{.shares = options.shares, .off_path = kOffPath};
  auto timed = length_of(*points) < 1e-9
                   ? time_line(cell, joints, points->front(), points->back(), close)
                   : time_path(cell, joints, JointPath::spline_through(*points), close);
  if (!timed) {
    return tl::unexpected(line.refusal(1.0, timed.error().front().detail));
  }
  if (auto left = line.leaves(*timed->trajectory, *points)) return tl::unexpected(std::move(*left));
  MotionChecker checker(scene);
  if (const auto found = found_in_the_way(checker, request, timed->trajectory)) {
    return tl::unexpected(blocked_by(*found, line.place_of(*timed->trajectory, found->own_time),
                                     last_free(scene, request, *points)));
  }
  JointWay way{.points = *std::move(points), .goal = 0, .evaluations = 1};
  return PlannedMotion{std::move(way), *std::move(timed), 0.0};
}

}  // namespace armloom
