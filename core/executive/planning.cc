// Ways to goals: of jobs, and for clients who ask.
#include <algorithm>
#include <cstdio>
#include <utility>

#include "core/executive/executive_impl.h"
#include "core/trajectory/joint_line.h"
#include "core/trajectory/set_joints.h"
#include "core/trajectory/validate.h"

namespace armloom {
namespace {

// Its problems, below this place of the request.
template <class T>
void collect(Result<T>& read, const char* place, Problems& problems) {
  if (read) return;
  for (Problem& problem : read.error()) {
    problem.pointer.insert(0, place);
    problems.push_back(std::move(problem));
  }
}

// Where it begins stands in `at`.
Result<PlanQuestion> question_of(const Cell& cell, const PlanInquiry& inquiry, Configuration at) {
  Problems problems;
  auto arm = find_arm(cell, inquiry.arm);
  collect(arm, "/arm", problems);
  if (!arm) return failure(std::move(problems));
  auto goal = goal_of(cell, *arm, inquiry.to);
  collect(goal, "/to", problems);
  if (inquiry.from) {
    auto start = joints_of(cell, *arm, *inquiry.from);
    collect(start, "/start", problems);
    if (start) set_joints(at, cell.arm(*arm).joints, *start);
  }
  if (!problems.empty()) return failure(std::move(problems));
  goal->speed = inquiry.speed;
  return PlanQuestion{.goal = *std::move(goal), .at = std::move(at), .seed = inquiry.seed};
}

// Of a goal that says where each joint is to be.
void find_outside_limits(const Cell& cell, const MotionGoal& goal, Problems& problems) {
  const auto* q = std::get_if<Eigen::VectorXd>(&goal.to);
  if (q == nullptr) return;
  const auto& joints = cell.arm(goal.arm).joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const Joint& joint = cell.joint(joints[j]);
    const double position = (*q)[static_cast<Eigen::Index>(j)];
    if (is_within_limits(joint, position)) continue;
    char text[160];
    std::snprintf(text, sizeof text, "%s at %.6g is outside its limits %.6g to %.6g",
                  joint.name.c_str(), position, joint.lower, joint.upper);
    problems.push_back({ProblemKind::invalid, "limit-exceeded",
                        "/move_to/joints/" + std::to_string(j), text, position});
  }
}

// How long it may take: the straight line; of a pose, whose joint positions are not known yet, the
// way home.
TrajectoryPtr estimate(const Cell& cell, const MotionGoal& goal, const Configuration& rest) {
  const Arm& arm = cell.arm(goal.arm);
  const auto* q = std::get_if<Eigen::VectorXd>(&goal.to);
  const Eigen::VectorXd& to = q != nullptr ? *q : arm.home;
  auto line = joint_line(cell, arm.joints, joints_of(rest, arm.joints), to);
  if (!line) line = joint_line(cell, arm.joints, to, to);  // it stands outside its limits
  return *line;
}

}  // namespace

std::optional<MotionGoal> Executive::Impl::read_goal(const JobRequest& request,
                                                     Problems& problems) const {
  if (request.order == JobOrder::any) {
    problems.push_back({ProblemKind::invalid, "not-served", "/order",
                        "a goal's job keeps its place: whether it ends where it begins is not "
                        "known before it is planned",
                        to_string(request.order)});
  }
  auto arm = find_arm(*cell_, request.arm);
  collect(arm, "/arm", problems);
  if (!arm) return std::nullopt;
  auto goal = goal_of(*cell_, *arm, *request.move_to);
  collect(goal, "/move_to", problems);
  if (!goal) return std::nullopt;
  goal->speed = request.speed;
  find_outside_limits(*cell_, *goal, problems);
  return *std::move(goal);
}

TrajectoryPtr Executive::Impl::estimate_for(const MotionGoal& goal, Ahead& ahead) const {
  // It goes there from wherever the arm stands: nobody has to go back first.
  ahead.ways_back.erase(goal.arm);
  std::erase(ahead.open, goal.arm);
  if (std::holds_alternative<LinkTarget>(goal.to)) ahead.open.push_back(goal.arm);
  return estimate(*cell_, goal, ahead.rest);
}

void Executive::Impl::ask_plan(const PlanMotion& asked) {
  const auto cancelled = std::make_shared<std::atomic<bool>>(false);
  plans_[asked.job] = cancelled;
  judges_.plan({asked.question, scene_, cancelled,
                [this, job = asked.job, number = asked.number](PlanAnswer answer) {
                  plans_.erase(job);
                  PlanMade planned{.job = job, .question = number, .trajectory = nullptr};
                  if (answer) {
                    planned.trajectory = answer->timed.trajectory;
                  } else {
                    planned.why = "no plan: " + answer.error().detail;
                  }
                  step(planned);
                }});
}

void Executive::Impl::plan(PlanInquiry inquiry, std::shared_ptr<std::atomic<bool>> cancelled,
                           std::function<void(Result<PlanOutcome>)> done) {
  auto question = question_of(*cell_, inquiry, scheduler_.predicted_rest());
  if (!question) return done(failure(std::move(question.error())));
  for (ArmId arm : all_arms()) {
    if (arm != question->goal.arm && has_job(arm)) question->may_move.push_back(arm);
  }
  const auto judge = [this, done](PlanAnswer answer) {
    if (!answer) return done(PlanOutcome(tl::unexpected(std::move(answer.error()))));
    const std::vector<Eigen::VectorXd> points = answer->way.points;
    JobRequest job{.key = "", .name = "", .trajectory = answer->timed.request};
    PlanView view{.motion = *std::move(answer), .length = 0.0, .straight = 0.0, .verdict = {}};
    view.length = view.motion.way.length();
    view.straight = (points.back() - points.front()).norm();
    check(std::move(job), [view = std::move(view), done](Result<CheckView> verdict) mutable {
      view.verdict = std::move(verdict);
      done(PlanOutcome(std::move(view)));
    });
  };
  PlanTask task{*std::move(question), scene_, std::move(cancelled), judge};
  if (judges_.draft(std::move(task))) return;
  done(failure(Problem{ProblemKind::unavailable, "too-many-plans", "",
                       "too many plans are being made; ask again in a moment"}));
}

}  // namespace armloom
