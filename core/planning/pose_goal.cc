#include "core/planning/pose_goal.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>

#include "core/planning/halton.h"
#include "core/planning/kdl_chain.h"
#include "core/planning/pose_descent.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

using Reason = PlanRefusal::Reason;

// Number of further seeds, from the Halton sequence over the joints' ranges.
constexpr int kFurtherSeeds = 40;

class PoseSearch {
 public:
  PoseSearch(const Cell& cell, const PoseGoal& goal, const Configuration& at)
      : cell_(cell),
        goal_(goal),
        arm_(cell.arm(goal.arm)),
        at_(at),
        standing_(joints_of(at, arm_.joints)) {}

  tl::expected<std::vector<Eigen::VectorXd>, PlanRefusal> run() {
    const auto chain = find_chain();
    if (!chain) {
      return tl::unexpected(PlanRefusal{Reason::goal_not_reached,
                                        "link " + cell_.link(goal_.link).name +
                                            " is not moved by the joints of arm " + arm_.name});
    }
    for (const Eigen::VectorXd& from : seeds()) {
      take(descend(cell_, arm_, *chain, goal_.X_WL, from));
      if (solutions_.size() >= kPoseSolutionsMax) break;
    }
    if (solutions_.empty()) return tl::unexpected(refusal());
    std::ranges::stable_sort(solutions_, {}, [&](const auto& q) { return (q - standing_).norm(); });
    return solutions_;
  }

  std::optional<Eigen::VectorXd> first(
      const std::function<bool(const Eigen::VectorXd&)>& is_usable) {
    const auto chain = find_chain();
    if (!chain) return std::nullopt;
    for (const Eigen::VectorXd& from : seeds()) {
      const std::size_t known = solutions_.size();
      take(descend(cell_, arm_, *chain, goal_.X_WL, from));
      if (solutions_.size() > known && is_usable(solutions_.back())) return solutions_.back();
      if (solutions_.size() >= kPoseSolutionsMax) break;
    }
    return std::nullopt;
  }

 private:
  std::optional<KdlChain> find_chain() {
    forward_kinematics(cell_, at_, X_WL_);
    return chain_to(cell_, goal_.arm, goal_.link, X_WL_);
  }

  [[nodiscard]] std::vector<Eigen::VectorXd> seeds() const {
    std::vector<Eigen::VectorXd> seeds{standing_, arm_.home};
    for (const auto& [name, q] : arm_.named_states) seeds.push_back(q);
    for (int i = 1; i <= kFurtherSeeds; ++i) {
      Eigen::VectorXd q = halton(i, standing_.size());
      for (Eigen::Index j = 0; j < q.size(); ++j) {
        const Joint& joint = cell_.joint(arm_.joints[static_cast<std::size_t>(j)]);
        const bool ranged = joint.has_lower() && joint.has_upper();
        const double lower = ranged ? joint.lower : standing_[j] - std::numbers::pi;
        const double upper = ranged ? joint.upper : standing_[j] + std::numbers::pi;
        q[j] = lower + q[j] * (upper - lower);
      }
      seeds.push_back(std::move(q));
    }
    return seeds;
  }

  // Moves each rotating joint by whole turns, as near to its current position as its limits permit.
  void unwind(Eigen::VectorXd& q) const {
    constexpr double kTurn = 2.0 * std::numbers::pi;
    for (Eigen::Index j = 0; j < q.size(); ++j) {
      const Joint& joint = cell_.joint(arm_.joints[static_cast<std::size_t>(j)]);
      if (joint.kind == JointKind::prismatic) continue;
      q[j] -= kTurn * std::round((q[j] - standing_[j]) / kTurn);
      if (q[j] > joint.upper) q[j] -= kTurn;
      if (q[j] < joint.lower) q[j] += kTurn;
    }
  }

  void take(Eigen::VectorXd q) {
    if (!q.allFinite()) return;
    unwind(q);
    Configuration whole = at_;
    set_joints(whole, arm_.joints, q);
    forward_kinematics(cell_, whole, X_WL_);
    const Eigen::Isometry3d X_LG = X_WL_[goal_.link.index()].inverse() * goal_.X_WL;
    const double off_m = X_LG.translation().norm();
    const double off_rad = Eigen::AngleAxisd(X_LG.linear()).angle();
    if (off_m > kPoseWithin_m || off_rad > kPoseWithin_rad) {
      if (off_m + off_rad < nearest_.off_m + nearest_.off_rad) nearest_ = {off_m, off_rad, q};
      return;
    }
    const auto same = [&](const Eigen::VectorXd& other) { return (other - q).norm() < 1e-3; };
    if (std::ranges::none_of(solutions_, same)) solutions_.push_back(std::move(q));
  }

  [[nodiscard]] PlanRefusal refusal() const {
    const std::string link = cell_.link(goal_.link).name;
    PlanRefusal refusal{Reason::goal_not_reached,
                        link + " does not reach that pose within the joints' limits"};
    refusal.link = link;
    if (nearest_.q.size() == 0) return refusal;
    char text[96];
    std::snprintf(text, sizeof text, "; the nearest pose found is %.4g mm and %.3g degrees off",
                  1e3 * nearest_.off_m, nearest_.off_rad * 180.0 / std::numbers::pi);
    refusal.detail += text;
    refusal.nearest = nearest_.q;
    return refusal;
  }

  struct Nearest {
    double off_m = 1e6;
    double off_rad = 1e6;
    Eigen::VectorXd q;
  };
  const Cell& cell_;
  const PoseGoal& goal_;
  const Arm& arm_;
  const Configuration& at_;
  Eigen::VectorXd standing_;
  LinkPoses X_WL_;
  std::vector<Eigen::VectorXd> solutions_;
  Nearest nearest_;
};

}  // namespace

tl::expected<std::vector<Eigen::VectorXd>, PlanRefusal> reach_pose(const Cell& cell,
                                                                   const PoseGoal& goal,
                                                                   const Configuration& at) {
  return PoseSearch(cell, goal, at).run();
}

std::optional<Eigen::VectorXd> first_at_pose(
    const Cell& cell, const PoseGoal& goal, const Configuration& at,
    const std::function<bool(const Eigen::VectorXd&)>& is_usable) {
  return PoseSearch(cell, goal, at).first(is_usable);
}

}  // namespace armloom
