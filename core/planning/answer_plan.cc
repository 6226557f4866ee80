#include "core/planning/answer_plan.h"

#include <algorithm>

#include "core/planning/clear_places.h"
#include "core/planning/nearest_free.h"
#include "core/planning/pose_goal.h"
#include "core/planning/tool_line.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

// Of the first of two tries. Ways that there are take a tenth of this mostly (README.md); looking
// for one that there is not would keep the second try waiting for ten times as long.
constexpr std::uint64_t kBesideBudget = 40'000;

struct JointGoals {
  std::vector<Eigen::VectorXd> q;
  std::uint64_t evaluations = 0;  // for them
};
using Goals = tl::expected<JointGoals, PlanRefusal>;

Goals joint_goals(const PlanningScenePtr& scene, const PlanQuestion& question) {
  const MotionGoal& goal = question.goal;
  if (const auto* q = std::get_if<Eigen::VectorXd>(&goal.to)) return JointGoals{{*q}};
  if (const auto* way = std::get_if<ClearOf>(&goal.to)) {
    return places_clear_of(scene, {goal.arm, way->motion, way->progress}, question.at)
        .map([](ClearPlaces places) {
          return JointGoals{std::move(places.q), places.evaluations};
        });
  }
  const auto& target = std::get<LinkTarget>(goal.to);
  return reach_pose(scene->cell(), {goal.arm, target.link, target.X_WL}, question.at)
      .map([](std::vector<Eigen::VectorXd> q) { return JointGoals{std::move(q)}; });
}

// With the nearest joint positions that would do, where those that were asked for would not.
PlanRefusal with_nearest(const PlanningScenePtr& scene, const PlanRequest& request,
                         PlanRefusal refusal) {
  using Reason = PlanRefusal::Reason;
  const bool is_of_end = refusal.is_of_start() || refusal.reason == Reason::goal_in_collision ||
                         refusal.reason == Reason::outside_limits;
  if (refusal.nearest || !is_of_end) return refusal;
  const Eigen::VectorXd wanted = refusal.is_of_start()
                                     ? joints_of(request.at, scene->cell().arm(request.arm).joints)
                                     : request.goals.front();
  NearestFree nearest = nearest_free(scene, request, wanted);
  refusal.nearest = std::move(nearest.q);
  refusal.evaluations += nearest.evaluations;
  return refusal;
}

// One try of each kind of goal.
class Answer {
 public:
  Answer(const PlanningScenePtr& scene, const PlanQuestion& question)
      : scene_(scene),
        question_(question),
        timing_{.shares = {.velocity = question.goal.speed,
                           .acceleration = question.goal.speed * question.goal.speed}} {}

  [[nodiscard]] PlanAnswer to(const PlanRequest& request) const {
    const auto* target = std::get_if<LinkTarget>(&question_.goal.to);
    if (target == nullptr || !question_.goal.straight) {
      return plan_motion(Planner(scene_), request, timing_);
    }
    return plan_line(scene_, {question_.goal.arm, target->link, target->X_WL}, request, timing_);
  }

 private:
  const PlanningScenePtr& scene_;
  const PlanQuestion& question_;
  TimingOptions timing_;
};

}  // namespace

PlanAnswer answer_plan(const PlanningScenePtr& scene, const PlanQuestion& question,
                       const std::atomic<bool>* cancelled) {
  auto goals = question.goal.straight ? Goals{} : joint_goals(scene, question);
  if (!goals) return tl::unexpected(std::move(goals.error()));
  PlanRequest request{.arm = question.goal.arm,
                      .at = question.at,
                      .goals = std::move(goals->q),
                      .seed = question.seed,
                      .cancelled = cancelled};
  std::uint64_t spent = goals->evaluations;
  const auto with_spent = [&spent](PlanAnswer answer) {
    (answer ? answer->way.evaluations : answer.error().evaluations) += spent;
    return answer;
  };
  const std::uint64_t budget = question.budget.value_or(PlanRequest::kDefaultBudget);
  request.budget = question.may_move.empty() ? budget : std::min(budget, kBesideBudget);
  const Answer answer(scene, question);
  std::optional<PlanRefusal> not_past;
  if (question.may_move.empty() || !question.has_no_way_past) {
    auto beside = with_spent(answer.to(request));
    if (beside) return beside;
    if (question.may_move.empty()) {
      return tl::unexpected(with_nearest(scene, request, std::move(beside.error())));
    }
    if (beside.error().reason == PlanRefusal::Reason::cancelled) return beside;
    spent = beside.error().evaluations;
    not_past = std::move(beside.error());
  }
  request.left_out = question.may_move;
  request.budget = budget;
  auto alone = with_spent(answer.to(request));
  if (!alone) return tl::unexpected(with_nearest(scene, request, std::move(alone.error())));
  alone->not_past = std::move(not_past);
  return alone;
}

}  // namespace armloom
