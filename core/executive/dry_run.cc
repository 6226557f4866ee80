#include "core/executive/dry_run.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "core/collision/check/motion_checker.h"
#include "core/collision/state/check_home.h"
#include "core/executive/dry_run_plan.h"
#include "core/executive/views.h"
#include "core/scheduler/trial.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

// The instant at which a job begins. Jobs that have begun are under way or have ended, whatever
// their verdict. The job is submitted, and then the next job of every arm without one.
class Instant final : public JobNames {
 public:
  // `begun`: indices, in order of starts.
  Instant(const DryRunPlan& plan, const Cell& cell, std::size_t asked,
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

  // Returns where all joints rest; for moving joints where they started.
  [[nodiscard]] const Configuration& rest() const { return rest_; }

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

  // Skips the job if its arms have an earlier job, or if it comes after a job that is not added.
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

  const DryRunPlan& plan_;
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

// The scene at the instants at which motions begin, in their order.
class SceneInTime {
 public:
  explicit SceneInTime(PlanningScenePtr scene) : scene_{std::move(scene)} {}

  // The motion begins, after its actions. `at`: the positions of all joints. Problems: those of
  // TouchScene::act().
  [[nodiscard]] Result<PlanningScenePtr> begin(const Planned& motion, const Configuration& at) {
    for (auto& [job, hands] : hands_) {
      if (hands.until <= motion.starts && job != motion.job) touch(hands, {}, at);
    }
    const std::vector<ArmId>& arms = motion.trajectory->arms();
    scene_.moved(arms, motion.step ? hands_[motion.job].touch : TouchOf{}, at);
    if (!motion.step) return scene_.scene;
    Hands& own = hands_[motion.job];
    own.arms.insert(own.arms.end(), arms.begin(), arms.end());
    for (const StepRequest& action : motion.actions) {
      auto done = scene_.act(action, own.touch, own.arms, at);
      if (!done) return failure(std::move(done.error()));
    }
    touch(own, motion.touch, at);
    own.until = motion.ends();
    return scene_.scene;
  }

 private:
  // The contact that the present motion of a job with steps allows.
  struct Hands {
    TouchOf touch = {};
    std::vector<ArmId> arms = {};
    TimePoint until{};
  };
  void touch(Hands& hands, const TouchOf& next, const Configuration& at) {
    scene_.change(hands.touch, next, hands.arms, at);
  }

  TouchScene scene_;
  std::map<std::size_t, Hands> hands_;  // by Planned::job
};

CheckView judged(const Instant& instant, const CellPtr& cell,
                 const std::shared_ptr<const Policy>& policy, MotionChecker& checker) {
  Trial trial = instant.trial(cell, policy);
  while (const auto question = trial.next()) trial.answer(checker.judge(*question));
  return view_of(trial.outcome(), *cell, instant);
}

// Checks all motions in the order in which they begin.
std::vector<CheckView> judged(const DryRunPlan& plan, const PlanningScenePtr& scene,
                              const std::shared_ptr<const Policy>& policy, const CellPtr& cell) {
  std::vector<std::size_t> order;
  std::vector<CheckView> views;
  for (const Planned& job : plan.jobs()) {
    if (job.trajectory) order.push_back(views.size());
    views.push_back({.kind = Verdict::Kind::conflict, .result = job.result});
  }
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return plan.jobs()[i].starts; });
  SceneInTime scenes(scene);
  MotionChecker checker(scene);
  std::vector<std::size_t> begun;
  for (std::size_t index : order) {
    const Planned& job = plan.jobs()[index];
    const Instant instant(plan, *cell, index, begun);
    begun.push_back(index);
    auto then = scenes.begin(job, instant.rest());
    if (!then) {
      views[index] = failed_step(then.error());
      continue;
    }
    checker.look_at(*std::move(then));
    views[index] = judged(instant, cell, policy, checker);
    // Relative to `starts` until here.
    auto& starts_s = views[index].earliest_start_s;
    if (starts_s) *starts_s += to_seconds(job.starts - job.asked);
  }
  return views;
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
  DryRunPlan plan(*scene, cell, policy);
  Problems problems;
  for (const TimedJob& timed : jobs) plan.add(timed, problems);
  if (!problems.empty()) return failure(std::move(problems));

  std::vector<CheckView> views = judged(plan, *scene, policy, cell);
  std::vector<CheckedJob> checked;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Planned& job = plan.jobs()[i];
    const bool is_first = checked.size() == job.job;
    if (is_first) checked.push_back({job.key, {}});
    CheckView& view = checked.back().verdict;
    if (!is_first && view.kind != Verdict::Kind::free) continue;
    if (job.step) {
      add_step(view, std::move(views[i]), *job.step, is_first);
    } else {
      view = std::move(views[i]);
    }
  }
  for (CheckedJob& job : checked) job.verdict.scene_version = 1;
  return checked;
}

}  // namespace armloom
