#include "core/executive/dry_run.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "core/base/add_below.h"
#include "core/collision/check/motion_checker.h"
#include "core/collision/state/check_home.h"
#include "core/executive/arms_of.h"
#include "core/executive/job_intake.h"
#include "core/executive/views.h"
#include "core/planning/answer_plan.h"
#include "core/scheduler/trial.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

// A job with the time at which it begins if everything goes as planned.
struct Planned {
  std::string key;
  std::string name;
  TimePoint asked;
  TimePoint starts;
  TrajectoryPtr trajectory = nullptr;        // null if it ends without a motion, ...
  std::optional<JobResultView> result = {};  // ... because of this
  std::vector<std::size_t> after = {};       // indices of those that have to succeed first

  [[nodiscard]] TimePoint ends() const { return starts + trajectory->duration(); }
  [[nodiscard]] bool moves(ArmId arm) const {
    return trajectory && std::ranges::count(trajectory->arms(), arm) > 0;
  }
};

// Takes the jobs in the order of the file, as one batch.
class Plan {
 public:
  Plan(PlanningScenePtr scene, const CellPtr& cell, const std::shared_ptr<const Policy>& policy)
      : scene_(std::move(scene)),
        cell_(*cell),
        scheduler_(cell, policy, cell_.home()),
        intake_(cell, {scheduler_, none_, tasks_, [this] { return scene_; }}, {kNoLimit, kNoLimit}),
        ahead_(intake_.ahead()),
        free_at_(cell_.arms.size(), TimePoint{}) {}

  void add(const TimedJob& timed, Problems& problems) {
    JobRequest request = timed.job;
    const std::string place = "/" + std::to_string(jobs_.size()) + "/job";
    if (request.key.empty()) request.key = "job-" + std::to_string(jobs_.size() + 1);
    request.terms.move_to_start =
        MoveToStart::none;  // it has to begin where the jobs before it end
    Planned& job = jobs_.emplace_back(request.key, request.name, timed.at, timed.at);
    if (auto problem = find_unchecked_steps(request)) {
      return add_below(place, {*std::move(problem)}, problems);
    }
    const Configuration rest = ahead_.rest;
    auto prepared = intake_.prepare(std::move(request), ahead_);
    ahead_.rest = rest;
    ahead_.open.clear();
    if (!prepared) return add_below(place, std::move(prepared.error()), problems);
    by_key_.emplace(job.key, jobs_.size() - 1);
    for (const std::string& before : prepared->after) follow(by_key_.at(before), job);
    if (job.result) return;
    if (prepared->motion.goals.empty()) {
      job.trajectory = prepared->motion.alternatives.front();  // as if that were chosen
    } else {
      plan(prepared->motion.goals, job);
    }
    if (job.trajectory) take(job);
  }

  [[nodiscard]] const std::vector<Planned>& jobs() const { return jobs_; }

 private:
  static constexpr auto kNoLimit = std::numeric_limits<std::size_t>::max();

  void follow(std::size_t before, Planned& job) {
    job.after.push_back(before);
    if (jobs_[before].result) {
      job.result = {Reason::predecessor_failed, "a job in its \"after\" did not succeed"};
    } else {
      job.starts = std::max(job.starts, jobs_[before].ends());
    }
  }

  // From where the jobs before it leave all arms, as the server asks; by the arm that is there
  // first.
  void plan(const std::vector<MotionGoal>& goals, Planned& job) {
    std::string why;
    TimePoint arrives = TimePoint::max();
    for (const MotionGoal& goal : goals) {
      PlanQuestion question{.goal = goal, .at = ahead_.rest, .seed = jobs_.size()};
      for (ArmId arm : all_arms(cell_)) {
        if (arm != goal.arm) question.may_move.push_back(arm);
      }
      const PlanAnswer answer = answer_plan(scene_, question);
      if (!answer) {
        why += (why.empty() ? "" : "; ") + cell_.arm(goal.arm).name +
               ": no plan: " + answer.error().detail;
        continue;
      }
      const TimePoint there =
          std::max(job.starts, free_at_[goal.arm.index()]) + answer->timed.trajectory->duration();
      if (there >= arrives) continue;
      arrives = there;
      job.trajectory = answer->timed.trajectory;
    }
    if (!job.trajectory) job.result = {Reason::no_plan, why};
  }

  void take(Planned& job) {
    for (ArmId arm : job.trajectory->arms()) {
      job.starts = std::max(job.starts, free_at_[arm.index()]);
    }
    for (ArmId arm : job.trajectory->arms()) free_at_[arm.index()] = job.ends();
    set_joints(ahead_.rest, *job.trajectory, job.trajectory->goal());
  }

  PlanningScenePtr scene_;
  const Cell& cell_;
  Scheduler scheduler_;  // without jobs, as are the names
  TaskBook tasks_;
  JobRegister none_{scheduler_, tasks_, {}};
  JobIntake intake_;
  JobIntake::Ahead ahead_;
  std::vector<TimePoint> free_at_;
  std::vector<Planned> jobs_;
  std::map<std::string, std::size_t> by_key_;
};

// The instant at which a job begins: what has begun by then is under way or has ended, whatever the
// verdict on it was; the job comes now, and behind it the next job of every arm that has none.
class Instant final : public JobNames {
 public:
  // `begun`: indices, in order of starts.
  Instant(const Plan& plan, const Cell& cell, std::size_t asked,
          const std::vector<std::size_t>& begun)
      : plan_(plan), cell_(cell), now_(plan.jobs()[asked].starts), rest_(cell.home()) {
    for (std::size_t index : begun) {
      const Planned& job = plan.jobs()[index];
      if (job.ends() <= now_) {
        ended_.insert(index);
        set_joints(rest_, *job.trajectory, job.trajectory->goal());
      } else {
        under_way_.push_back(Motion{only_step(known_as(index)), job.trajectory, now_ - job.starts});
      }
    }
    add_next(asked);
    for (std::size_t index = 0; index < plan.jobs().size(); ++index) {
      const Planned& job = plan.jobs()[index];
      const bool has_come = job.trajectory && job.asked <= now_;
      if (has_come && !ended_.contains(index) && !ids_.contains(index)) add_next(index);
    }
  }

  [[nodiscard]] Trial trial(const CellPtr& cell,
                            const std::shared_ptr<const Policy>& policy) const {
    return {Scheduler(cell, policy, rest_, under_way_, now_), {}, next_, next_.front().job, now_};
  }

  std::string key(JobId job) const override { return planned(job).key; }
  std::string name(JobId job) const override { return planned(job).name; }
  [[nodiscard]] bool has_job(ArmId arm) const override {
    return std::ranges::any_of(plan_.jobs(), [arm](const Planned& job) { return job.moves(arm); });
  }
  [[nodiscard]] bool is_stopped(ArmId) const override { return false; }

 private:
  [[nodiscard]] const Planned& planned(JobId job) const {
    return plan_.jobs()[known_[job.value() - 1]];
  }

  JobId known_as(std::size_t index) {
    known_.push_back(index);
    return ids_.emplace(index, JobId{known_.size()}).first->second;
  }

  // Not, if jobs of its arms come before it, or one of those it comes after is not among the next.
  void add_next(std::size_t index) {
    const Planned& job = plan_.jobs()[index];
    Submit next{.job = JobId{0}, .trajectory = job.trajectory};
    for (std::size_t before : job.after) {
      if (ended_.contains(before)) continue;
      const auto id = ids_.find(before);
      if (id == ids_.end()) return;
      next.after.push_back(id->second);
    }
    const auto& arms = job.trajectory->arms();
    if (std::ranges::any_of(arms, [this](ArmId arm) { return taken_.contains(arm); })) return;
    taken_.insert(arms.begin(), arms.end());
    next.job = known_as(index);
    next_.push_back(std::move(next));
  }

  const Plan& plan_;
  const Cell& cell_;
  TimePoint now_;
  Configuration rest_;
  std::set<std::size_t> ended_;
  std::vector<Motion> under_way_;
  std::vector<Submit> next_;  // what is asked about first
  std::set<ArmId> taken_;     // arms of those
  std::vector<std::size_t> known_;
  std::map<std::size_t, JobId> ids_;
};

CheckView judged(const Instant& instant, const CellPtr& cell,
                 const std::shared_ptr<const Policy>& policy, MotionChecker& checker) {
  Trial trial = instant.trial(cell, policy);
  while (const auto question = trial.next()) trial.answer(checker.judge(*question));
  return view_of(trial.outcome(), *cell, instant);
}

}  // namespace

Result<std::vector<CheckedJob>> check_jobs(CellPtr cell, const std::string& policy_name,
                                           const std::vector<TimedJob>& jobs) {
  auto made = make_policy(policy_name.empty() ? cell->scheduling.policy : policy_name, *cell);
  if (!made) return failure(std::move(made.error()));
  const std::shared_ptr<const Policy> policy = std::move(*made);
  auto scene = PlanningScene::build(cell);
  if (!scene) return failure(std::move(scene.error()));
  if (auto too_close = check_home(*scene); !too_close.empty()) return failure(std::move(too_close));
  Plan plan(*scene, cell, policy);
  Problems problems;
  for (const TimedJob& timed : jobs) plan.add(timed, problems);
  if (!problems.empty()) return failure(std::move(problems));

  std::vector<std::size_t> order;
  std::vector<CheckedJob> checked;
  for (const Planned& job : plan.jobs()) {
    if (job.trajectory) order.push_back(checked.size());
    CheckView& view = checked.emplace_back(job.key).verdict;
    view.kind = Verdict::Kind::conflict;
    view.result = job.result;
  }
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return plan.jobs()[i].starts; });
  MotionChecker checker(*scene);
  std::vector<std::size_t> begun;
  for (std::size_t index : order) {
    const Planned& job = plan.jobs()[index];
    CheckView& view = checked[index].verdict;
    view = judged(Instant(plan, *cell, index, begun), cell, policy, checker);
    // Counted from where it was judged.
    if (view.earliest_start_s) *view.earliest_start_s += to_seconds(job.starts - job.asked);
    begun.push_back(index);
  }
  for (CheckedJob& job : checked) job.verdict.scene_version = 1;
  return checked;
}

}  // namespace armloom
