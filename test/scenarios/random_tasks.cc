#include "test/scenarios/random_tasks.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "core/executive/live_scene.h"
#include "core/executive/signals.h"
#include "core/model/kinematics.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;

constexpr double kPart_m = 0.03;   // radius of a part
constexpr double kBall_m = 0.1;    // radius of a slider's ball
constexpr double kGap_m = 0.004;   // between a hand and its part
constexpr double kHeavy_kg = 1.2;  // more for each arm
constexpr double kStep_m = 0.01;   // of the search for places of a handover
constexpr double kWithin_m = 0.015;

std::string name_of(std::size_t part) { return "part_" + std::to_string(part); }

}  // namespace

void RandomTasks::equip(CellDescription& cell) {
  cell.io.signals = {{.name = "valve", .direction = SignalDirection::output},
                     {.name = "ready", .direction = SignalDirection::input}};
  for (RobotDescription& robot : cell.robots) {
    for (ArmDescription& arm : robot.arms) arm.payload = PayloadDescription{4.0, 0.4, 0.5};
  }
}

RandomTasks::RandomTasks(const Cell& cell, Random& random, RandomJobs& jobs,
                         std::function<Executive&()> executive)
    : cell_(cell), random_(random), jobs_(jobs), executive_(std::move(executive)) {
  for (const Arm& arm : cell.arms) {
    hands_.push_back(cell.link(arm.links.back()).name);
    for (const LinkId link : arm.links) {
      if (cell.link(link).name.ends_with("hand")) hands_.back() = cell.link(link).name;
    }
  }
}

std::vector<double> RandomTasks::joints_of(std::size_t arm, const Configuration& q) const {
  std::vector<double> joints;
  for (const JointId joint : cell_.arms[arm].joints) joints.push_back(q[joint.value()]);
  return joints;
}

Eigen::Isometry3d RandomTasks::hand_at(std::size_t arm, const std::vector<double>& q) const {
  Configuration all = cell_.home();
  for (std::size_t j = 0; j < q.size(); ++j) all[cell_.arms[arm].joints[j].value()] = q[j];
  LinkPoses X_WL;
  forward_kinematics(cell_, all, X_WL);
  return X_WL[cell_.find_link(hands_[arm])->index()];
}

void RandomTasks::place_parts() {
  for (std::size_t arm = 0; arm < cell_.arms.size(); ++arm) {
    const bool slides = cell_.arms[arm].joints.size() == 1;
    for (int tries = 0; tries < 20; ++tries) {
      const std::vector<double> q = jobs_.anywhere(jobs_.arms()[arm]);
      const double turned = random_.uniform(0.0, 2.0 * std::numbers::pi);
      CollisionObject part{.name = name_of(arm), .shape = Sphere{kPart_m}};
      part.mass.kg = kHeavy_kg * static_cast<double>(arm);
      part.X_WO = hand_at(arm, q);
      Eigen::Vector3d beside = part.X_WO.linear() * Eigen::Vector3d(0.0, 0.0, 0.12);
      if (slides) {
        beside =
            (kBall_m + kPart_m + kGap_m) * Eigen::Vector3d(std::cos(turned), std::sin(turned), 0.0);
      }
      part.X_WO.translation() += beside;
      part.X_WO.linear().setIdentity();
      if (is_at_part(part.name, part.X_WO)) continue;
      if (!executive_().scene().add(part)) continue;  // too close to an arm
      parts_.insert(part.name);
      X_W_part_[part.name] = part.X_WO;
      grasps_[part.name] = {arm, q};
      starts_[part.name] = {part, {arm, q}};
      break;
    }
  }
}

std::vector<std::string> RandomTasks::see(const SceneView& scene) {
  std::map<std::string, int> places;
  for (const std::string& part : parts_) places[part] = 0;
  std::map<std::string, std::size_t> held;
  shared_with_.clear();
  for (const HeldView& view : scene.held) {
    ++places[view.object.name];
    for (const HeldView::Other& other : view.shared_with) {
      shared_with_[view.object.name] = cell_.find_arm(other.arm)->index();
    }
    held[view.object.name] = cell_.find_arm(view.arm)->index();
  }
  for (const CollisionObject& object : scene.objects()) {
    if (!parts_.contains(object.name)) continue;
    ++places[object.name];
    X_W_part_[object.name] = object.X_WO;
    const auto by = held_.find(object.name);
    if (by == held_.end()) continue;
    grasps_[object.name] = {by->second, executive_().arms()[by->second].q};
  }
  held_ = std::move(held);
  std::vector<std::string> lost;
  for (const auto& [part, count] : places) {
    if (count != 1) lost.push_back(part);
  }
  return lost;
}

void RandomTasks::set_input() { (void)executive_().signals().set("ready", random_.chance(0.7)); }

// Returns true if another part of the scene is too close to this place.
bool RandomTasks::is_at_part(const std::string& part, const Eigen::Isometry3d& X_WO) const {
  return std::ranges::any_of(X_W_part_, [&](const auto& other) {
    const Eigen::Vector3d apart = other.second.translation() - X_WO.translation();
    return other.first != part && apart.norm() < 2 * kPart_m + 0.03;
  });
}

void RandomTasks::tidy_up() {
  // The server knows where an arm without a link was; the operator of a cell sees where it is.
  const auto may_move = [](const ArmView& arm) {
    return arm.state == ArmState::moving || arm.link != ArmLink::State::up;
  };
  if (std::ranges::any_of(executive_().arms(), may_move)) return;
  for (const auto& [part, start] : starts_) {
    if (held_.contains(part) && !executive_().detach(part)) continue;
    held_.erase(part);
    if (is_at_part(part, start.object.X_WO)) continue;
    if (!executive_().scene().replace(start.object)) continue;  // an arm is there
    X_W_part_[part] = start.object.X_WO;
    grasps_[part] = start.grasp;
  }
}

StepRequest RandomTasks::move(std::size_t arm, std::vector<double> q) const {
  MotionStepRequest motion{.trajectory = {}, .arm = cell_.arms[arm].name};
  motion.move_to = PlanGoal{.joints = std::move(q), .named = {}, .pose = {}};
  return {"", motion};
}

StepRequest RandomTasks::move_anywhere(std::size_t arm) {
  StepRequest step = move(arm, jobs_.anywhere(jobs_.arms()[arm]));
  if (random_.chance(0.2)) {
    std::get<MotionStepRequest>(step.what).triggers = {
        {random_.uniform(0.0, 1.0), "valve", random_.chance(0.5)}};
  }
  return step;
}

StepRequest RandomTasks::attach(const std::string& part, std::size_t arm) const {
  return {"", AttachRequest{part, hands_[arm]}};
}

// Adds an action that may take time.
void RandomTasks::add_pause(Steps& steps) {
  const double what = random_.uniform(0.0, 1.0);
  if (what < 0.2) {
    steps.push_back({"", WaitRequest{from_seconds(random_.uniform(0.0, 1.0))}});
  } else if (what < 0.4) {
    steps.push_back({"", SetIoRequest{"valve", random_.chance(0.5)}});
  } else if (what < 0.6) {
    steps.push_back({"", WaitIoRequest{"ready", true, from_seconds(random_.uniform(1.0, 20.0))}});
  }
}

// The arm carries the part somewhere, and perhaps lets go of it.
void RandomTasks::place(Steps& steps, const std::string& part, std::size_t arm) {
  if (random_.chance(0.8)) steps.push_back(move_anywhere(arm));
  if (random_.chance(0.2)) return;
  add_pause(steps);
  steps.push_back({"", DetachRequest{part}});
  if (random_.chance(0.8)) steps.push_back(move_anywhere(arm));
}

void RandomTasks::pick(Steps& steps, const std::string& part, std::size_t arm) {
  // A wrong place: no hand is near the part, so the step fails.
  const bool misses = random_.chance(0.05);
  steps.push_back(misses ? move_anywhere(arm) : move(arm, grasps_.at(part).q));
  add_pause(steps);
  steps.push_back(attach(part, arm));
  std::vector<std::size_t> others;
  for (std::size_t other = 0; other < hands_.size(); ++other) {
    if (other != arm) others.push_back(other);
  }
  if (random_.chance(0.8)) steps.push_back(move_anywhere(arm));
  const std::size_t to = others[random_.index(others.size())];
  if (random_.chance(0.4) && hand_over(steps, part, arm, to)) return;
  place(steps, part, arm);
}

// Both arms move to places at which the part touches the other hand, too. Returns false if there
// are none. Only for arms with one axis.
bool RandomTasks::hand_over(Steps& steps, const std::string& part, std::size_t from,
                            std::size_t to) {
  if (cell_.arms[from].joints.size() != 1 || cell_.arms[to].joints.size() != 1) return false;
  const Grasp& grasp = grasps_.at(part);
  const Eigen::Vector3d in_hand =
      X_W_part_.at(part).translation() - hand_at(from, grasp.q).translation();
  const auto line = [this](std::size_t arm) {
    const Eigen::Vector3d origin = hand_at(arm, {0.0}).translation();
    return std::pair{origin, Eigen::Vector3d(hand_at(arm, {1.0}).translation() - origin)};
  };
  const auto [giver_at_0, giver_along] = line(from);
  const auto [taker_at_0, taker_along] = line(to);
  std::vector<std::pair<double, double>> places;
  for (double qa = -1.2; qa < 1.2; qa += kStep_m) {
    const Eigen::Vector3d giver = giver_at_0 + qa * giver_along;
    for (double qb = -1.2; qb < 1.2; qb += kStep_m) {
      const Eigen::Vector3d taker = taker_at_0 + qb * taker_along;
      const double gap_m = (giver + in_hand - taker).norm() - kBall_m - kPart_m;
      const bool is_apart = (giver - taker).norm() > 2 * kBall_m + 0.03;
      if (is_apart && gap_m > 0.0 && gap_m < kWithin_m) places.emplace_back(qa, qb);
    }
  }
  if (places.empty()) return false;
  const auto [qa, qb] = places[random_.index(places.size())];
  steps.push_back(move(from, {qa}));
  steps.push_back(move(to, {qb}));
  if (random_.chance(0.5)) {
    steps.push_back({"", AttachRequest{part, hands_[to], {}, true}});
    add_pause(steps);
    if (random_.chance(0.5)) carry_together(steps, from, qa, to, qb);
    add_pause(steps);
    let_one_go(steps, part, from, to);
    return true;
  }
  steps.push_back(attach(part, to));
  steps.push_back(move_anywhere(from));
  place(steps, part, to);
  return true;
}

// As far as arms can whose axes are not parallel: within the tolerance of their hands.
void RandomTasks::carry_together(Steps& steps, std::size_t from, double qa, std::size_t to,
                                 double qb) {
  constexpr double kLittle_m = 2e-4;
  MotionStepRequest motion;
  for (const std::size_t arm : {from, to}) {
    motion.trajectory.joint_names.push_back(cell_.joint(cell_.arms[arm].joints[0]).name);
  }
  const std::vector<double> zero{0.0, 0.0};
  motion.trajectory.points = {{{qa, qb}, zero, zero, 0.0},
                              {{qa + kLittle_m, qb - kLittle_m}, zero, zero, 0.5}};
  steps.push_back({"", std::move(motion)});
}

void RandomTasks::let_one_go(Steps& steps, const std::string& part, std::size_t first,
                             std::size_t second) {
  if (random_.chance(0.3)) std::swap(first, second);
  steps.push_back({"", DetachRequest{part, {}, hands_[first]}});
  steps.push_back(move_anywhere(first));
  steps.push_back(move_anywhere(second));
  place(steps, part, second);
}

std::optional<JobRequest> RandomTasks::any() {
  const std::size_t arm = random_.index(hands_.size());
  JobRequest request{.key = "t" + std::to_string(next_), .name = "", .trajectory = {}};
  for (const auto& [part, by] : held_) {
    if (by != arm || !request.steps.empty()) continue;
    if (shared_with_.contains(part)) {
      let_one_go(request.steps, part, arm, shared_with_.at(part));
    } else {
      place(request.steps, part, arm);
    }
  }
  for (const auto& [part, grasp] : grasps_) {
    const bool is_here = grasp.arm == arm && !held_.contains(part);
    if (is_here && request.steps.empty()) pick(request.steps, part, arm);
  }
  if (request.steps.empty()) return std::nullopt;
  for (StepRequest& step : request.steps) {
    const bool can_fail = !std::holds_alternative<WaitRequest>(step.what) &&
                          !std::holds_alternative<SetIoRequest>(step.what);
    if (can_fail && random_.chance(0.2)) step.retry = 1 + static_cast<int>(random_.index(3));
  }
  ++next_;
  if (random_.chance(0.3)) request.terms.priority = static_cast<int>(random_.index(3)) - 1;
  return request;
}

}  // namespace armloom
