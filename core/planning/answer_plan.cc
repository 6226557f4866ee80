#include "core/planning/answer_plan.h"

#include <algorithm>
#include <utility>

#include "core/planning/clear_places.h"
#include "core/planning/nearest_free.h"
#include "core/planning/pose_goal.h"
#include "core/planning/tool_line.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

// Budget of a try that plans around arms that may move. Most existing paths need only a tenth of it
// (README.md). If there is no path, the full budget would delay the last try tenfold.
constexpr std::uint64_t kBesideBudget = 40'000;

struct JointGoals {
  std::vector<Eigen::VectorXd> q;
  std::uint64_t evaluations = 0;  // spent to find them
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

// If the start or the goal is unusable, adds the nearest joint positions that would work.
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

// Returns an arm that occupies the start or the goal and that may move, or nullopt. That arm must
// leave before the motion.
std::optional<ArmId> stands_at_an_end(const PlanRefusal& refusal, const PlanRequest& request,
                                      const std::vector<ArmId>& may_move) {
  using Reason = PlanRefusal::Reason;
  const bool is_of_end =
      refusal.reason == Reason::start_in_collision || refusal.reason == Reason::goal_in_collision;
  if (!is_of_end || !refusal.proximity) return std::nullopt;
  for (const auto& arm : {refusal.proximity->arm_a, refusal.proximity->arm_b}) {
    const auto is_among = [&arm](const std::vector<ArmId>& arms) {
      return std::ranges::find(arms, *arm) != arms.end();
    };
    if (arm && is_among(may_move) && !is_among(request.left_out)) return arm;
  }
  return std::nullopt;
}

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
  const Answer answer(scene, question);
  std::optional<NotPast> not_past;
  if (question.has_no_way_past) request.left_out = question.may_move;
  for (;;) {
    const bool is_last = request.left_out.size() == question.may_move.size();
    request.budget = is_last ? budget : std::min(budget, kBesideBudget);
    auto motion = with_spent(answer.to(request));
    if (motion) {
      motion->not_past = std::move(not_past);
      motion->goes_through = !request.left_out.empty();
      return motion;
    }
    PlanRefusal& refusal = motion.error();
    if (refusal.reason == PlanRefusal::Reason::cancelled) return motion;
    if (is_last) return tl::unexpected(with_nearest(scene, request, std::move(refusal)));
    spent = refusal.evaluations;
    if (const auto arm = stands_at_an_end(refusal, request, question.may_move)) {
      request.left_out.push_back(*arm);
    } else {
      not_past = NotPast{std::exchange(request.left_out, question.may_move), std::move(refusal)};
    }
  }
}

}  // namespace armloom
