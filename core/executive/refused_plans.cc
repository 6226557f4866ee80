#include "core/executive/refused_plans.h"

#include <algorithm>
#include <utility>

namespace armloom {
namespace {

bool is_same(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return a.size() == b.size() && (a.array() == b.array()).all();
}
bool is_same(const LinkTarget& a, const LinkTarget& b) {
  return a.link == b.link && a.X_WL.matrix() == b.X_WL.matrix();
}
bool is_same(const ClearOf& a, const ClearOf& b) {
  return a.motion == b.motion && a.progress == b.progress;
}

bool is_same(const MotionGoal& a, const MotionGoal& b) {
  if (a.arm != b.arm || a.straight != b.straight || a.to.index() != b.to.index()) return false;
  return std::visit([&b]<class To>(const To& to) { return is_same(to, std::get<To>(b.to)); }, a.to);
}

// Joints of arms that are left out, and are not its own, may be anywhere.
bool stand_alike(const Cell& cell, const std::vector<ArmId>& left_out, const Configuration& a,
                 const Configuration& b) {
  std::vector<bool> counts(static_cast<std::size_t>(a.size()), true);
  for (ArmId arm : left_out) {
    for (JointId joint : cell.arm(arm).joints) counts[joint.index()] = false;
  }
  for (std::size_t j = 0; j < counts.size(); ++j) {
    const auto row = static_cast<Eigen::Index>(j);
    if (counts[j] && a[row] != b[row]) return false;
  }
  return true;
}

// Who stands at an end of the way says nothing of a way past the others.
bool was_looked_for(const PlanRefusal& why) {
  using Reason = PlanRefusal::Reason;
  return why.reason != Reason::start_in_collision && why.reason != Reason::goal_in_collision;
}

}  // namespace

void RefusedPlans::look_at(const PlanningScenePtr& scene) {
  if (std::exchange(scene_, scene) != scene) refused_.clear();
}

// One that was refused though more arms were left out is refused all the more.
const PlanRefusal* RefusedPlans::find(const PlanQuestion& question,
                                      const std::vector<ArmId>& left_out,
                                      bool (*counts)(const PlanRefusal&)) const {
  const auto found = std::ranges::find_if(refused_, [&](const Refused& refused) {
    return (counts == nullptr || counts(refused.why)) && is_same(refused.goal, question.goal) &&
           std::ranges::all_of(left_out,
                               [&](ArmId arm) {
                                 return std::ranges::find(refused.left_out, arm) !=
                                        refused.left_out.end();
                               }) &&
           stand_alike(scene_->cell(), refused.left_out, refused.at, question.at);
  });
  return found == refused_.end() ? nullptr : &found->why;
}

void RefusedPlans::tell(PlanTask& task) {
  look_at(task.scene);
  const PlanRefusal* known = find(task.question, task.question.may_move);
  if (known != nullptr) {
    task.known = *known;
    task.known->evaluations = 0;  // this time
  }
  task.question.has_no_way_past = find(task.question, {}, &was_looked_for) != nullptr;
}

void RefusedPlans::add(const PlanQuestion& question, std::vector<ArmId> left_out,
                       const PlanRefusal& why) {
  if (why.reason == PlanRefusal::Reason::cancelled) return;
  if (find(question, left_out) != nullptr) return;
  if (refused_.size() == kMax) refused_.pop_front();
  refused_.push_back({question.goal, question.at, std::move(left_out), why});
}

void RefusedPlans::learn(const PlanQuestion& question, const PlanningScenePtr& scene,
                         const PlanAnswer& answer) {
  if (scene != scene_) return;  // it is another one meanwhile
  if (!answer) {
    add(question, question.may_move, answer.error());
  } else if (answer->not_past) {
    add(question, answer->not_past->left_out, answer->not_past->why);
  }
}

}  // namespace armloom
