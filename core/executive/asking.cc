// What clients ask without anything being done: what would become of a job, how an arm would get
// somewhere.
#include <utility>

#include "core/base/add_below.h"
#include "core/executive/arms_of.h"
#include "core/executive/executive_impl.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

// Where it begins stands in `at`.
Result<PlanQuestion> question_of(const Cell& cell, const PlanInquiry& inquiry, Configuration at) {
  Problems problems;
  auto arm = find_arm(cell, inquiry.arm);
  if (!arm) add_below("/arm", std::move(arm.error()), problems);
  if (!arm) return failure(std::move(problems));
  auto goal = goal_of(cell, *arm, inquiry.to);
  if (!goal) add_below("/to", std::move(goal.error()), problems);
  if (inquiry.from) {
    auto start = joints_of(cell, *arm, *inquiry.from);
    if (!start) add_below("/start", std::move(start.error()), problems);
    if (start) set_joints(at, cell.arm(*arm).joints, *start);
  }
  if (!problems.empty()) return failure(std::move(problems));
  goal->speed = inquiry.speed;
  return PlanQuestion{.goal = *std::move(goal), .at = std::move(at), .seed = inquiry.seed};
}

}  // namespace

void Executive::Impl::check(JobRequest request, std::function<void(Result<CheckView>)> done) {
  if (request.move_to) {
    return done(failure(Problem{ProblemKind::invalid, "not-served", "/move_to",
                                "a goal has no trajectory yet that could be judged: POST /plan "
                                "plans one, and says how it is judged"}));
  }
  JobIntake::Ahead ahead = intake_.ahead();
  auto prepared = intake_.prepare(std::move(request), ahead);
  if (!prepared) return done(failure(std::move(prepared.error())));
  std::vector<Submit> jobs;
  std::uint64_t next = scheduler_.next_job().value();
  for (TrajectoryPtr& back : prepared->returns) {
    jobs.push_back(intake_.return_of(std::move(back), prepared->priority));
  }
  jobs.push_back(intake_.submission(std::move(*prepared)));
  for (Submit& job : jobs) job.job = JobId{next++};
  walk(std::make_shared<Trial>(scheduler_, questions_.asked(), jobs, jobs.back().job, clock_.now),
       std::move(done));
}

// As admission would, in this instant.
void Executive::Impl::walk(std::shared_ptr<Trial> trial,
                           std::function<void(Result<CheckView>)> done) {
  if (auto question = trial->next()) {
    const auto answered = [this, trial, done](Verdict verdict) {
      trial->answer(std::move(verdict));
      walk(trial, done);
    };
    if (questions_.service().consider(std::move(*question), scene_.scene(), answered)) return;
    return done(failure(Problem{ProblemKind::unavailable, "too-many-checks", "",
                                "too many checks are being made; ask again in a moment"}));
  }
  Trial::Outcome outcome = trial->outcome();
  for (Wait& wait : outcome.waits) {
    const bool is_known = wait.job && scheduler_.find(*wait.job) != nullptr;
    if (wait.job && !is_known) wait.job.reset();  // its arm's own way back, or forgotten meanwhile
  }
  CheckView view = view_of(outcome, *cell_, jobs_);
  view.scene_version = scene_.version();
  done(std::move(view));
}

void Executive::Impl::plan(PlanInquiry inquiry, std::shared_ptr<std::atomic<bool>> cancelled,
                           std::function<void(Result<PlanOutcome>)> done) {
  auto question = question_of(*cell_, inquiry, scheduler_.predicted_rest());
  if (!question) return done(failure(std::move(question.error())));
  for (ArmId arm : all_arms(*cell_)) {
    if (arm != question->goal.arm && jobs_.has_job(arm)) question->may_move.push_back(arm);
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
  PlanTask task{*std::move(question), scene_.scene(), std::move(cancelled), judge};
  if (questions_.service().draft(std::move(task))) return;
  done(failure(Problem{ProblemKind::unavailable, "too-many-plans", "",
                       "too many plans are being made; ask again in a moment"}));
}

}  // namespace armloom
