#include "core/executive/dry_run.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "core/base/add_below.h"
#include "core/collision/check/motion_checker.h"
#include "core/collision/state/check_home.h"
#include "core/executive/arms_of.h"
#include "core/executive/gripper_goal.h"
#include "core/executive/start_elsewhere.h"
#include "core/executive/views.h"
#include "core/planning/answer_plan.h"
#include "core/planning/plan_goal.h"
#include "core/scheduler/scheduler.h"
#include "core/scheduler/trial.h"
#include "core/trajectory/implicit_start.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

// A job with the time at which it begins if everything goes as planned.
struct Planned {
  std::size_t place;  // in the file
  std::string key;
  std::string name;
  TrajectoryPtr trajectory;
  TimePoint asked;
  TimePoint starts;
  std::vector<std::size_t> after = {};  // indices of those that have to succeed first

  [[nodiscard]] TimePoint ends() const { return starts + trajectory->duration(); }
  [[nodiscard]] bool moves(ArmId arm) const {
    return std::ranges::find(trajectory->arms(), arm) != trajectory->arms().end();
  }
};

// Reads the jobs in the order of the file: where each arm stands, and when it is free.
class Plan {
 public:
  explicit Plan(PlanningScenePtr scene)
      : scene_(std::move(scene)),
        cell_(scene_->cell()),
        rest_(cell_.home()),
        free_at_(cell_.arms.size(), TimePoint{}) {}

  void add(const TimedJob& timed, Problems& problems) {
    const std::size_t before = problems.size();
    Planned job{read_, timed.job.key, timed.job.name, nullptr, timed.at, timed.at};
    const std::string place = "/" + std::to_string(read_++) + "/job";
    if (job.key.empty()) job.key = "job-" + std::to_string(read_);
    Problems found;
    const bool fails = find_what_it_follows(timed.job, job, found);
    add_below(place, std::move(found), problems);
    if (moves_gripper_only(timed.job, cell_)) {
      auto motion = gripper_motion(timed.job, cell_, rest_);
      if (motion) job.trajectory = *std::move(motion);
      if (!motion) add_below(place, std::move(motion.error()), problems);
    } else if (timed.job.move_to) {
      auto goals = goals_of(cell_, {timed.job.arm, timed.job.arms}, *timed.job.move_to, "/move_to");
      if (!goals) add_below(place, std::move(goals.error()), problems);
      if (goals && !fails) plan(*goals, timed.job.speed, job);
    } else {
      const auto motion = timed.job.motions().front();  // as if that were chosen
      auto trajectory = validate_from(motion.motion, cell_, rest_);
      Problems wrong = trajectory ? Problems{} : std::move(trajectory.error());
      if (trajectory) *trajectory = with_whole_turns(cell_, std::move(*trajectory), rest_);
      if (trajectory) find_start_elsewhere(cell_, **trajectory, rest_, wrong);
      add_below(place + motion.place, std::move(wrong), problems);
      if (trajectory) job.trajectory = *std::move(trajectory);
    }
    if (problems.size() > before) return;
    if (fails) ended_.emplace(job.key, std::pair(job.place, Reason::predecessor_failed));
    if (!ended_.contains(job.key)) take(std::move(job));
  }

  [[nodiscard]] const std::vector<Planned>& jobs() const { return jobs_; }
  // Those that would end without a motion; by their keys.
  using Ended = std::map<std::string, std::pair<std::size_t, Reason>>;
  [[nodiscard]] const Ended& ended() const { return ended_; }
  [[nodiscard]] const std::string& why(const std::string& key) const { return why_.at(key); }

 private:
  // Whether one of these fails.
  bool find_what_it_follows(const JobRequest& request, Planned& job, Problems& problems) {
    if (by_key_.contains(job.key) || ended_.contains(job.key)) {
      problems.push_back({ProblemKind::conflict, "id-in-use", "/id",
                          "the id is used by an earlier job of the file", job.key});
    }
    bool fails = false;
    for (std::size_t i = 0; i < request.after.size(); ++i) {
      const std::string& key = request.after[i];
      if (const auto it = by_key_.find(key); it != by_key_.end()) {
        job.starts = std::max(job.starts, jobs_[it->second].ends());
        job.after.push_back(it->second);
      } else if (ended_.contains(key)) {
        fails = true;
        why_[job.key] = "a job in its \"after\" did not succeed";
      } else {
        problems.push_back({ProblemKind::invalid, "unknown-job", "/after/" + std::to_string(i),
                            "no job before this one has the id \"" + key + "\"", key});
      }
    }
    return fails;
  }

  // From where the jobs before it leave all arms, as the server asks; by the arm that is there
  // first.
  void plan(std::vector<MotionGoal>& goals, std::optional<double> speed, Planned& job) {
    std::string why;
    TimePoint arrives = TimePoint::max();
    for (MotionGoal& goal : goals) {
      goal.speed = speed.value_or(goal.speed);
      PlanQuestion question{.goal = goal, .at = rest_, .seed = job.place + 1};
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
    if (job.trajectory) return;
    ended_.emplace(job.key, std::pair(job.place, Reason::no_plan));
    why_[job.key] = why;
  }

  void take(Planned job) {
    for (ArmId arm : job.trajectory->arms()) {
      job.starts = std::max(job.starts, free_at_[arm.index()]);
    }
    for (ArmId arm : job.trajectory->arms()) free_at_[arm.index()] = job.ends();
    set_joints(rest_, *job.trajectory, job.trajectory->goal());
    by_key_.emplace(job.key, jobs_.size());
    jobs_.push_back(std::move(job));
  }

  PlanningScenePtr scene_;
  const Cell& cell_;
  Configuration rest_;
  std::vector<TimePoint> free_at_;
  std::size_t read_ = 0;
  std::vector<Planned> jobs_;
  std::map<std::string, std::size_t> by_key_;
  Ended ended_;
  std::map<std::string, std::string> why_;
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
      const bool has_come = plan.jobs()[index].asked <= now_;
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
  Plan plan(*scene);
  Problems problems;
  for (const TimedJob& timed : jobs) plan.add(timed, problems);
  if (!problems.empty()) return failure(std::move(problems));

  std::vector<std::size_t> order(plan.jobs().size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return plan.jobs()[i].starts; });
  MotionChecker checker(*scene);
  std::vector<CheckedJob> checked(jobs.size());
  for (const auto& [key, how] : plan.ended()) {
    CheckView& view = (checked[how.first] = {key, {}}).verdict;
    view.kind = Verdict::Kind::conflict;
    view.scene_version = 1;
    view.result = JobResultView{how.second, plan.why(key)};
  }
  std::vector<std::size_t> begun;
  for (std::size_t index : order) {
    const auto& job = plan.jobs()[index];
    checked[job.place].key = job.key;
    CheckView& view = checked[job.place].verdict;
    view = judged(Instant(plan, *cell, index, begun), cell, policy, checker);
    view.scene_version = 1;
    // Counted from where it was judged.
    if (view.earliest_start_s) *view.earliest_start_s += to_seconds(job.starts - job.asked);
    begun.push_back(index);
  }
  return checked;
}

}  // namespace armloom
