#include "core/planning/tool_reach.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <thread>
#include <utility>

#include "core/base/nearest_name.h"
#include "core/collision/check/line_checker.h"
#include "core/model/kinematics.h"
#include "core/planning/pose_goal.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

Result<LinkId> tool_of(const Cell& cell, const Arm& arm, const std::optional<std::string>& name) {
  const auto is_tool = [&](LinkId id) {
    const Link& link = cell.link(id);
    if (!name) return link.driver == arm.joints.back();
    return link.name == *name || link.name == cell.robots[arm.robot.index()].prefix + *name;
  };
  const auto tool = std::ranges::find_if(arm.links, is_tool);
  if (tool != arm.links.end()) return *tool;
  std::string known;
  for (LinkId id : arm.links) known += (known.empty() ? "" : ", ") + cell.link(id).name;
  return failure(Problem{ProblemKind::invalid, "unknown-link", "--link",
                         "arm " + arm.name + " has no link " + name.value_or("of its last joint") +
                             "; it moves " + known,
                         name.value_or("")});
}

// Returns an upper bound on the tool's distance from the arm's first joint (m): the lengths of all
// links plus the travel of prismatic joints.
double farthest(const Cell& cell, const Arm& arm, LinkId tool, const LinkPoses& X_WL) {
  double sum = 0.0;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  bool is_first = true;
  for (JointId id : arm.joints) {
    const auto moved =
        std::ranges::find_if(arm.links, [&](LinkId link) { return cell.link(link).driver == id; });
    if (moved == arm.links.end()) continue;
    const Eigen::Vector3d p = X_WL[moved->index()].translation();
    if (!is_first) sum += (p - at).norm();
    is_first = false;
    at = p;
    const Joint& joint = cell.joint(id);
    if (joint.kind == JointKind::prismatic) sum += joint.upper - joint.lower;
  }
  return sum + (X_WL[tool.index()].translation() - at).norm();
}

const std::array<Eigen::Matrix3d, kReachDirections>& turns() {
  using std::numbers::pi;
  const auto about = [](double angle, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  };
  static const std::array<Eigen::Matrix3d, kReachDirections> kTurns{
      about(pi, Eigen::Vector3d::UnitX()), about(pi / 2, Eigen::Vector3d::UnitY()),
      about(-pi / 2, Eigen::Vector3d::UnitY()), about(-pi / 2, Eigen::Vector3d::UnitX()),
      about(pi / 2, Eigen::Vector3d::UnitX())};
  return kTurns;
}

// Looks for one direction of an arm's tool at all places, one after the other.
class ToolSweep {
 public:
  ToolSweep(const PlanningScenePtr& scene, ArmId arm, LinkId tool, std::size_t direction)
      : cell_(scene->cell()),
        arm_(arm),
        tool_(tool),
        turn_(turns()[direction]),
        at_(cell_.home()),
        lines_(scene, arm, at_, TrackingErrors(cell_), others()),
        stands_(cell_.arm(arm).home) {}

  // Returns true if the tool reaches this place. The search starts from the last solution.
  bool reaches(const Eigen::Vector3d& place) {
    Eigen::Isometry3d X_WL = Eigen::Isometry3d::Identity();
    X_WL.translation() = place;
    X_WL.linear() = turn_;
    set_joints(at_, cell_.arm(arm_).joints, stands_);
    const auto found =
        first_at_pose(cell_, {arm_, tool_, X_WL}, at_,
                      [this](const Eigen::VectorXd& q) { return lines_.is_free(q, q); });
    if (found) stands_ = *found;
    return found.has_value();
  }

 private:
  [[nodiscard]] std::vector<ArmId> others() const {
    std::vector<ArmId> others;
    for (std::uint32_t a = 0; a < cell_.arms.size(); ++a) {
      if (ArmId{a} != arm_) others.emplace_back(a);
    }
    return others;
  }

  const Cell& cell_;
  ArmId arm_;
  LinkId tool_;
  Eigen::Matrix3d turn_;
  Configuration at_;
  LineChecker lines_;
  Eigen::VectorXd stands_;
};

struct ReachBall {
  Eigen::Vector3d centre;
  double radius_m;
};

// Returns the grid that covers all balls. The coordinates of its points are multiples of the step.
ReachGrid grid_over(const std::vector<ReachBall>& balls, double step_m) {
  Eigen::Vector3d lower = Eigen::Vector3d::Constant(1e9), upper = -lower;
  for (const ReachBall& ball : balls) {
    lower = lower.cwiseMin((ball.centre.array() - ball.radius_m).matrix());
    upper = upper.cwiseMax((ball.centre.array() + ball.radius_m).matrix());
  }
  ReachGrid grid{.step_m = step_m};
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double first = std::ceil(lower[i] / step_m), last = std::floor(upper[i] / step_m);
    grid.first[i] = first * step_m;
    grid.count[static_cast<std::size_t>(i)] = static_cast<int>(std::max(0.0, last - first + 1.0));
  }
  return grid;
}

// Sweeps each direction of each arm on its own, so that the result does not depend on the number of
// threads.
void sweep_all(const PlanningScenePtr& scene, const std::vector<ReachBall>& balls,
               const std::function<void(double)>& on_progress, ToolReach& reach) {
  const std::size_t places = reach.grid.places();
  const std::size_t sweeps = reach.arms.size() * kReachDirections;
  std::vector<std::vector<std::uint8_t>> reached(sweeps, std::vector<std::uint8_t>(places, 0));
  std::atomic<std::size_t> next{0}, done{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < sweeps; i = next++) {
      const std::size_t a = i / kReachDirections;
      ToolSweep sweep(scene, reach.arms[a].arm, reach.arms[a].tool, i % kReachDirections);
      for (std::size_t place = 0; place < places; ++place) {
        const Eigen::Vector3d p = reach.grid.at(place);
        const bool is_near = (p - balls[a].centre).norm() <= balls[a].radius_m;
        reached[i][place] = is_near && sweep.reaches(p) ? 1 : 0;
        const std::size_t count = ++done;
        if (on_progress) {
          on_progress(static_cast<double>(count) / static_cast<double>(sweeps * places));
        }
      }
    }
  };
  {
    std::vector<std::jthread> threads;
    for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) threads.emplace_back(work);
    work();
  }
  for (std::size_t a = 0; a < reach.arms.size(); ++a) {
    std::vector<std::uint8_t>& directions = reach.arms[a].directions;
    directions.assign(places, 0);
    for (std::size_t d = 0; d < kReachDirections; ++d) {
      for (std::size_t place = 0; place < places; ++place) {
        directions[place] += reached[a * kReachDirections + d][place];
      }
    }
  }
}

}  // namespace

std::size_t ReachGrid::places() const {
  std::size_t places = 1;
  for (const int n : count) places *= static_cast<std::size_t>(n);
  return places;
}

Eigen::Vector3d ReachGrid::at(std::size_t place) const {
  const auto nx = static_cast<std::size_t>(count[0]), ny = static_cast<std::size_t>(count[1]);
  const Eigen::Vector3d cell(static_cast<double>(place % nx), static_cast<double>(place / nx % ny),
                             static_cast<double>(place / nx / ny));
  return first + step_m * cell;
}

std::size_t ToolReach::poses(const ArmReach& arm) const {
  std::size_t sum = 0;
  for (const std::uint8_t n : arm.directions) sum += n;
  return sum;
}

std::size_t ToolReach::places(const ArmReach& arm) const {
  return static_cast<std::size_t>(
      std::ranges::count_if(arm.directions, [](std::uint8_t n) { return n > 0; }));
}

std::size_t ToolReach::shared(const ArmReach& a, const ArmReach& b) const {
  std::size_t sum = 0;
  for (std::size_t i = 0; i < a.directions.size(); ++i) {
    if (a.directions[i] > 0 && b.directions[i] > 0) ++sum;
  }
  return sum;
}

Result<ToolReach> tool_reach(const PlanningScenePtr& scene, const ReachQuestion& question) {
  const Cell& cell = scene->cell();
  LinkPoses X_WL;
  forward_kinematics(cell, cell.home(), X_WL);
  ToolReach reach;
  std::vector<ReachBall> balls;
  for (std::uint32_t a = 0; a < cell.arms.size(); ++a) {
    const Arm& arm = cell.arms[a];
    auto tool = tool_of(cell, arm, question.link);
    if (!tool) return failure(std::move(tool.error()));
    const auto moved = std::ranges::find_if(
        arm.links, [&](LinkId link) { return cell.link(link).driver == arm.joints.front(); });
    const Eigen::Vector3d base = X_WL[moved->index()].translation();
    balls.push_back({base, farthest(cell, arm, *tool, X_WL)});
    reach.arms.push_back({ArmId{a}, *tool, base, {}});
  }
  reach.grid = grid_over(balls, question.step_m);
  if (reach.grid.places() > kReachPlacesMax) {
    return failure(Problem{ProblemKind::invalid, "too-many-places", "--step",
                           "the grid has " + std::to_string(reach.grid.places()) +
                               " places, but at most " + std::to_string(kReachPlacesMax) +
                               " are checked: give a larger step",
                           question.step_m});
  }
  sweep_all(scene, balls, question.on_progress, reach);
  return reach;
}

}  // namespace armloom
