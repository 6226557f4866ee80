#include "core/planning/answer_plan.h"

#include "core/planning/pose_goal.h"

namespace armloom {
namespace {

using Goals = tl::expected<std::vector<Eigen::VectorXd>, PlanRefusal>;

Goals joint_goals(const Cell& cell, const PlanQuestion& question) {
  const MotionGoal& goal = question.goal;
  if (const auto* q = std::get_if<Eigen::VectorXd>(&goal.to)) return std::vector{*q};
  const auto& target = std::get<LinkTarget>(goal.to);
  return reach_pose(cell, {goal.arm, target.link, target.X_WL}, question.at);
}

}  // namespace

PlanAnswer answer_plan(const PlanningScenePtr& scene, const PlanQuestion& question,
                       const std::atomic<bool>* cancelled) {
  auto goals = joint_goals(scene->cell(), question);
  if (!goals) return tl::unexpected(std::move(goals.error()));
  PlanRequest request{.arm = question.goal.arm,
                      .at = question.at,
                      .goals = *std::move(goals),
                      .seed = question.seed,
                      .cancelled = cancelled};
  const TimingOptions timing{.shares = {.velocity = question.goal.speed}};
  const Planner planner(scene);
  auto beside = plan_motion(planner, request, timing);
  if (beside || question.may_move.empty()) return beside;
  if (beside.error().reason == PlanRefusal::Reason::cancelled) return beside;
  const std::uint64_t spent = beside.error().evaluations;
  request.left_out = question.may_move;
  auto alone = plan_motion(planner, request, timing);
  (alone ? alone->way.evaluations : alone.error().evaluations) += spent;
  return alone;
}

}  // namespace armloom
