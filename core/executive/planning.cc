// Ways to goals, for clients who ask.
#include <utility>

#include "core/executive/executive_impl.h"
#include "core/trajectory/set_joints.h"

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

}  // namespace

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
