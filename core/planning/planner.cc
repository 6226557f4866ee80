#include "core/planning/planner.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "core/collision/check/line_checker.h"
#include "core/collision/scene/scene_bodies.h"
#include "core/planning/shorten.h"
#include "core/planning/tree_search.h"
#include "core/trajectory/set_joints.h"
#include "core/trajectory/validate.h"

namespace armloom {
namespace {

using Reason = PlanRefusal::Reason;

// Maximum length of a tree's edge: Euclidean, in joint space (rad, m).
constexpr double kStep = 1.2;
// Number of node comparisons that take as long as one evaluation.
constexpr std::uint64_t kCompared = 250;

std::string mm(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g mm", 1e3 * metres);
  return text;
}

constexpr const char* kStart = "start";
constexpr const char* kGoal = "goal";

std::optional<PlanRefusal> outside(const Cell& cell, const Arm& arm, const Eigen::VectorXd& q,
                                   const char* whose) {
  for (std::size_t j = 0; j < arm.joints.size(); ++j) {
    const Joint& joint = cell.joint(arm.joints[j]);
    const double value = q[static_cast<Eigen::Index>(j)];
    if (is_within_limits(joint, value)) continue;
    char text[96];
    std::snprintf(text, sizeof text, " at %.6g is outside its limits %.6g to %.6g", value,
                  joint.lower, joint.upper);
    PlanRefusal refusal{Reason::outside_limits, std::string(whose) + ": " + joint.name + text};
    refusal.outside = OutsideLimits{whose == kStart, j, value};
    return refusal;
  }
  return std::nullopt;
}

std::string in_words(const LineChecker::Answer& answer) {
  return armloom::in_words(*answer.proximity, answer.moves_m);
}

// Returns the joints inside their limits. A measured arm at a limit may exceed it a little.
Eigen::VectorXd inside(const Cell& cell, const Arm& arm, Eigen::VectorXd q) {
  for (std::size_t j = 0; j < arm.joints.size(); ++j) {
    const Joint& joint = cell.joint(arm.joints[j]);
    double& value = q[static_cast<Eigen::Index>(j)];
    const double nearest = std::clamp(value, joint.has_lower() ? joint.lower : value,
                                      joint.has_upper() ? joint.upper : value);
    if (std::abs(nearest - value) <= cell.execution.start_tolerance_rad) value = nearest;
  }
  return q;
}

// Returns the range in which samples are drawn. A joint without limits has a range of half a turn
// beyond the start and the goals.
JointRoom room_of(const Cell& cell, const Arm& arm, const Eigen::VectorXd& start,
                  const std::vector<Eigen::VectorXd>& goals) {
  JointRoom room{start, start};
  for (const Eigen::VectorXd& goal : goals) {
    room.lower = room.lower.cwiseMin(goal);
    room.upper = room.upper.cwiseMax(goal);
  }
  for (std::size_t j = 0; j < arm.joints.size(); ++j) {
    const Joint& joint = cell.joint(arm.joints[j]);
    const auto row = static_cast<Eigen::Index>(j);
    room.lower[row] = joint.has_lower() ? joint.lower : room.lower[row] - std::numbers::pi;
    room.upper[row] = joint.has_upper() ? joint.upper : room.upper[row] + std::numbers::pi;
  }
  return room;
}

class Search {
 public:
  Search(const PlanningScenePtr& scene, const PlanRequest& request)
      : request_(request),
        cell_(scene->cell()),
        arm_(cell_.arm(request.arm)),
        start_(inside(cell_, arm_, joints_of(request.at, arm_.joints))),
        lines_(scene, request.arm, request.at, TrackingErrors(cell_), request.left_out) {}

  tl::expected<JointWay, PlanRefusal> run() {
    if (auto refusal = check_ends()) return refuse(*std::move(refusal));
    for (const std::size_t goal : goals_) {
      if (is_free(start_, request_.goals[goal])) return way({start_, request_.goals[goal]});
    }
    if (start_.size() == 1) {  // then no other path exists
      const auto answer = lines_.line(start_, request_.goals[goals_.front()]);
      return refuse({Reason::not_found, "on the way, " + in_words(answer), answer.proximity});
    }
    TreeSearch search{room_of(cell_, arm_, start_, request_.goals),
                      start_,
                      {},
                      kStep,
                      request_.seed,
                      [this](const auto& a, const auto& b) { return joins(a, b); },
                      [this] { return stop(); }};
    for (const std::size_t goal : goals_) search.goals.push_back(request_.goals[goal]);
    auto points = grow_trees(search);
    if (!points) {
      if (cancelled()) return refuse({Reason::cancelled, "planning was canceled"});
      return refuse({Reason::not_found, "no path was found within " +
                                            std::to_string(request_.budget) +
                                            " evaluations; one may still exist"});
    }
    shorten(*points, {[this](const auto& a, const auto& b) { return is_free(a, b); }, search.stop,
                      request_.seed});
    return way(*std::move(points));
  }

 private:
  [[nodiscard]] bool cancelled() const {
    return request_.cancelled != nullptr && request_.cancelled->load(std::memory_order_relaxed);
  }
  [[nodiscard]] bool stop() const {
    return lines_.evaluations() + compared_ / kCompared >= request_.budget || cancelled();
  }
  // Before each edge, RRT-Connect compares a sample with all nodes of a tree. With few joints these
  // comparisons take longer than the checks of edges, so the budget includes them.
  [[nodiscard]] bool joins(const Eigen::VectorXd& from, const Eigen::VectorXd& to) {
    compared_ += nodes_;
    const bool free = is_free(from, to);
    nodes_ += free ? 1 : 0;
    return free;
  }
  [[nodiscard]] bool is_free(const Eigen::VectorXd& from, const Eigen::VectorXd& to) {
    return lines_.is_free(from, to);
  }
  [[nodiscard]] tl::unexpected<PlanRefusal> refuse(PlanRefusal refusal) const {
    refusal.evaluations = lines_.evaluations();
    return tl::unexpected(std::move(refusal));
  }
  [[nodiscard]] JointWay way(std::vector<Eigen::VectorXd> points) const {
    const auto reached = std::ranges::find(request_.goals, points.back());
    const auto goal = static_cast<std::size_t>(reached - request_.goals.begin());
    return {std::move(points), goal, lines_.evaluations()};
  }

  // Fills goals_ with the free goals, nearest first. Returns a refusal if the start or every goal
  // is unusable.
  std::optional<PlanRefusal> check_ends() {
    if (auto refusal = outside(cell_, arm_, start_, kStart)) return refusal;
    std::optional<PlanRefusal> first;
    for (std::size_t g = 0; g < request_.goals.size(); ++g) {
      auto refusal = outside(cell_, arm_, request_.goals[g], kGoal);
      if (!refusal) {
        const auto answer = lines_.state(request_.goals[g]);
        if (answer.kind == LineChecker::Kind::free) {
          goals_.push_back(g);
          continue;
        }
        refusal = PlanRefusal{Reason::goal_in_collision, "at the goal " + in_words(answer),
                              answer.proximity};
      }
      if (!first) first = std::move(refusal);
    }
    LineChecker::Answer at_start = lines_.state(start_);
    if (at_start.kind != LineChecker::Kind::free) {
      lines_.let_part_from(start_);
      at_start = lines_.state(start_);
    }
    if (at_start.kind != LineChecker::Kind::free) {
      return PlanRefusal{Reason::start_in_collision, "at the start " + in_words(at_start),
                         at_start.proximity};
    }
    std::ranges::stable_sort(goals_, {},
                             [&](std::size_t g) { return (request_.goals[g] - start_).norm(); });
    return goals_.empty() ? first : std::nullopt;
  }

  const PlanRequest& request_;
  const Cell& cell_;
  const Arm& arm_;
  Eigen::VectorXd start_;
  LineChecker lines_;
  std::vector<std::size_t> goals_;
  std::uint64_t nodes_ = 0, compared_ = 0;  // of the trees: nodes, comparisons
};

}  // namespace

double JointWay::length() const {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) length += (points[i + 1] - points[i]).norm();
  return length;
}

std::string reason_name(Reason reason) {
  switch (reason) {
    case Reason::outside_limits:
      return "outside-limits";
    case Reason::start_in_collision:
      return "start-in-collision";
    case Reason::goal_in_collision:
      return "goal-in-collision";
    case Reason::goal_not_reached:
      return "goal-not-reached";
    case Reason::not_found:
      return "not-found";
    case Reason::line_broken:
      return "line-broken";
    case Reason::line_blocked:
      return "line-blocked";
    case Reason::cancelled:
      return "cancelled";
  }
  return "";
}

std::string in_words(const Proximity& p, double moves_m) {
  const std::string distance = p.clearance_m > 0.0   ? " is " + mm(p.clearance_m) + " from "
                               : p.clearance_m < 0.0 ? " overlaps "
                                                     : " touches ";
  std::string text = p.body_a + distance + p.body_b;
  if (p.clearance_m < 0.0) text += " by " + mm(-p.clearance_m);
  const bool is_contact_alone = p.limit_m <= kTouching_m;  // the required clearance is zero
  text += "; " + (is_contact_alone ? "contact is not allowed" : mm(p.limit_m) + " are required");
  if (p.clearance_m < p.limit_m) return text;
  if (moves_m > 0.0) return text + ", plus " + mm(moves_m) + " for the tracking error";
  return text + ", which could not be certified with the tracking error added";
}

tl::expected<JointWay, PlanRefusal> Planner::plan(const PlanRequest& request) const {
  const Arm& arm = scene_->cell().arm(request.arm);
  if (request.goals.empty()) throw std::invalid_argument("Planner: no goal");
  for (const Eigen::VectorXd& goal : request.goals) {
    if (goal.size() != static_cast<Eigen::Index>(arm.joints.size())) {
      throw std::invalid_argument("Planner: a goal has one position for each joint of the arm");
    }
  }
  return Search(scene_, request).run();
}

}  // namespace armloom
