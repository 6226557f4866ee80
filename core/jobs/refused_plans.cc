#include "core/jobs/refused_plans.h"

#include <algorithm>

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

// Compares the joints, except those of ignored arms.
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

}  // namespace

// If no path exists although more arms are ignored, none exists when fewer are ignored.
const NoPlan* RefusedPlans::find(const Cell& cell, const PlanQuestion& question,
                                 const std::vector<ArmId>& left_out, bool only_sought) const {
  const auto found = std::ranges::find_if(refused_, [&](const Refused& refused) {
    const bool counts = !only_sought || refused.why.cause == NoPlan::Cause::sought;
    return counts && is_same(refused.goal, question.goal) &&
           std::ranges::all_of(left_out,
                               [&](ArmId arm) {
                                 return std::ranges::find(refused.left_out, arm) !=
                                        refused.left_out.end();
                               }) &&
           stand_alike(cell, refused.left_out, refused.at, question.at);
  });
  return found == refused_.end() ? nullptr : &found->why;
}

bool RefusedPlans::has_no_way_past(const Cell& cell, const PlanQuestion& question) const {
  return find(cell, question, {}, true) != nullptr;
}

void RefusedPlans::add(const Cell& cell, const PlanQuestion& question,
                       const std::vector<ArmId>& left_out, const NoPlan& why) {
  if (why.cause == NoPlan::Cause::canceled || find(cell, question, left_out) != nullptr) return;
  if (refused_.size() == kMax) refused_.pop_front();
  refused_.push_back({question.goal, question.at, left_out, why});
}

void RefusedPlans::learn(const Cell& cell, const PlanQuestion& question, const PlanMade& answer) {
  if (!answer.trajectory) {
    add(cell, question, question.may_move, answer.none);
  } else if (answer.not_past) {
    add(cell, question, answer.not_past->left_out, answer.not_past->why);
  }
}

}  // namespace armloom
