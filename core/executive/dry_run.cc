#include "core/executive/dry_run.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "core/collision/check/motion_checker.h"
#include "core/collision/state/check_home.h"
#include "core/coordination/effort.h"
#include "core/executive/executive_impl.h"
#include "core/scheduler/orders/passing_orders.h"
#include "core/scheduler/waiting/waits.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

// A job with the time at which it begins if everything goes as planned.
struct Planned {
  std::string key;
  std::string name;
  TrajectoryPtr trajectory;
  TimePoint asked;
  TimePoint starts;

  [[nodiscard]] TimePoint ends() const { return starts + trajectory->duration(); }
};

// Reads the jobs in the order of the file: where each arm stands, and when it is free.
class Plan final : public JobNames {
 public:
  explicit Plan(const Cell& cell)
      : cell_(cell), rest_(cell.home()), free_at_(cell.arms.size(), TimePoint{}) {}

  void add(const TimedJob& timed, Problems& problems) {
    const std::string place = "/" + std::to_string(jobs_.size() + refused_) + "/job";
    const auto refuse = [&](Problem problem) {
      problem.pointer.insert(0, place);
      problems.push_back(std::move(problem));
    };
    const std::size_t before = problems.size();
    Planned job{timed.job.key, timed.job.name, nullptr, timed.at, timed.at};
    if (job.key.empty()) job.key = "job-" + std::to_string(jobs_.size() + refused_ + 1);
    if (by_key_.contains(job.key)) {
      refuse({ProblemKind::conflict, "id-in-use", "/id",
              "the id is used by an earlier job of the file", job.key});
    }
    for (std::size_t i = 0; i < timed.job.after.size(); ++i) {
      const std::string& key = timed.job.after[i];
      if (const auto it = by_key_.find(key); it != by_key_.end()) {
        job.starts = std::max(job.starts, jobs_[it->second].ends());
      } else {
        refuse({ProblemKind::invalid, "unknown-job", "/after/" + std::to_string(i),
                "no job before this one has the id \"" + key + "\"", key});
      }
    }
    const auto motion = timed.job.motions().front();  // as if that were chosen
    auto trajectory = validate(motion.motion, cell_);
    Problems found = trajectory ? Problems{} : std::move(trajectory.error());
    if (trajectory) find_start_elsewhere(cell_, **trajectory, rest_, found);
    for (Problem& problem : found) problem.pointer.insert(0, motion.place);
    for (Problem& problem : found) refuse(std::move(problem));
    if (problems.size() > before) {
      ++refused_;
      return;
    }
    job.trajectory = std::move(*trajectory);
    for (ArmId arm : job.trajectory->arms()) {
      job.starts = std::max(job.starts, free_at_[arm.index()]);
    }
    for (ArmId arm : job.trajectory->arms()) free_at_[arm.index()] = job.ends();
    set_joints(rest_, *job.trajectory, job.trajectory->goal());
    by_key_.emplace(job.key, jobs_.size());
    jobs_.push_back(std::move(job));
  }

  [[nodiscard]] const std::vector<Planned>& jobs() const { return jobs_; }
  std::string key(JobId job) const override { return jobs_[job.value() - 1].key; }
  std::string name(JobId job) const override { return jobs_[job.value() - 1].name; }
  [[nodiscard]] bool has_job(ArmId arm) const override {
    return std::ranges::any_of(jobs_, [arm](const Planned& job) {
      return std::ranges::find(job.trajectory->arms(), arm) != job.trajectory->arms().end();
    });
  }

  [[nodiscard]] bool is_stopped(ArmId) const override { return false; }

 private:
  const Cell& cell_;
  Configuration rest_;
  std::vector<TimePoint> free_at_;
  std::vector<Planned> jobs_;
  std::map<std::string, std::size_t> by_key_;
  std::size_t refused_ = 0;
};

JobId id_of(std::size_t index) { return JobId{index + 1}; }

// What the first of the group finds at its start; `begun`: indices of those that have begun, in
// order of starts.
Question question_for(const Plan& plan, const std::vector<std::size_t>& group,
                      const std::vector<std::size_t>& begun, const Cell& cell,
                      const Policy& policy) {
  const Planned& job = plan.jobs()[group.front()];
  Question question{.version = 1,
                    .start_at = job.starts,
                    .candidates = {},
                    .others = {},
                    .rest = cell.home(),
                    .method = policy.method()};
  for (std::size_t candidate : group) {
    question.candidates.push_back(
        Motion{id_of(candidate), plan.jobs()[candidate].trajectory, Duration{}});
  }
  for (std::size_t other : begun) {
    const Planned& earlier = plan.jobs()[other];
    if (earlier.ends() <= job.starts) {
      set_joints(question.rest, *earlier.trajectory, earlier.trajectory->goal());
    } else {
      question.others.push_back(
          Motion{id_of(other), earlier.trajectory, job.starts - earlier.starts});
    }
  }
  return question;
}

// Where one of those that have begun has the candidate's place.
std::optional<JobId> place_taken(const Question& question, const CellPtr& cell,
                                 const std::shared_ptr<const Policy>& policy) {
  State state(cell, policy, question.rest);
  std::vector<Motion> motions = question.others;
  motions.push_back(question.candidates.front());
  std::ranges::sort(motions, {}, &Motion::job);
  for (const Motion& motion : motions) {
    Record& record =
        state.jobs.add({.job = {.id = motion.job, .trajectory = motion.trajectory},
                        .leg = state.arms.leg_of(*cell, motion.job, *motion.trajectory),
                        .turn = motion.job,
                        .on_behalf_of = motion.job});
    if (motion.job == question.candidates.front().job) continue;
    state.jobs.enter(record, Admitted{});
    state.jobs.enter(record, Moving{.overrun_at = {}, .moved_at = {}});
  }
  return policy->place_taken_by(state, state.jobs.at(question.candidates.front().job));
}

// Beside everything that has begun and whose authority reaches to where it may come next.
PassingOrders orders_for(const Question& question, const Cell& cell, const Policy& policy,
                         const Verdict& verdict) {
  const auto coordinated = [](const std::vector<Motion>& motions) {
    std::vector<CoordinatedMotion> result;
    for (const Motion& motion : motions) {
      result.push_back({.job = motion.job,
                        .arms = motion.trajectory->arms(),
                        .duration = motion.trajectory->duration(),
                        .progress = motion.progress,
                        .authority = motion.progress});
    }
    return result;
  };
  const std::vector<Duration> no_work(cell.arms.size());
  const auto others = coordinated(question.others), candidates = coordinated(question.candidates);
  return policy.decide({others, {}, candidates, verdict.regions, no_work});
}

// The same as an answer to clients about the first of so many candidates: in conflict with the
// blockers, or free to start when it begins.
Verdict as_verdict(const PassingOrders& orders, std::size_t candidates, Verdict verdict) {
  if (verdict.kind != Verdict::Kind::free) return verdict;
  verdict.regions.clear();
  if (orders.blockers.empty()) {
    verdict.earliest_start =
        *(orders.prediction.begins.end() - static_cast<std::ptrdiff_t>(candidates));
    return verdict;
  }
  verdict.kind = Verdict::Kind::conflict;
  verdict.clearance_bound.reset();
  for (const Blocker& blocker : orders.blockers) {
    verdict.conflicts.push_back({blocker.arm ? Conflict::With::rest : Conflict::With::motion,
                                 blocker.blocked, blocker.other, blocker.proximity,
                                 blocker.own_time, blocker.other_time});
  }
  return verdict;
}

// Of the arms in the way the first job each that has not begun: it would move them away.
std::vector<std::size_t> with_next_jobs(std::vector<std::size_t> group, const Plan& plan,
                                        const std::vector<std::size_t>& begun,
                                        const std::vector<ArmId>& in_the_way) {
  const auto is_in = [](const std::vector<std::size_t>& jobs, std::size_t job) {
    return std::ranges::find(jobs, job) != jobs.end();
  };
  for (ArmId arm : in_the_way) {
    for (std::size_t next = 0; next < plan.jobs().size(); ++next) {
      const auto& arms = plan.jobs()[next].trajectory->arms();
      if (std::ranges::find(arms, arm) == arms.end()) continue;
      if (is_in(begun, next) || is_in(group, next)) continue;
      if (arms.size() == 1) group.push_back(next);
      break;
    }
  }
  return group;
}

// As admission does: with more effort where the budget ends, and, where passing orders decide,
// together with others if it is in conflict by itself.
Verdict weighed(std::size_t index, const std::vector<std::size_t>& begun, const Plan& plan,
                const Cell& cell, const Policy& policy, MotionChecker& checker) {
  std::vector<std::size_t> group{index};
  std::optional<Verdict> alone;
  for (;;) {
    Question question = question_for(plan, group, begun, cell, policy);
    Verdict answer = checker.judge(question);
    const auto means = [&] {
      if (answer.kind != Verdict::Kind::free) return answer;
      return as_verdict(orders_for(question, cell, policy, answer), group.size(), answer);
    };
    Verdict meant = means();
    while (meant.kind != Verdict::Kind::free) {
      const auto effort = larger_effort(answer, question.effort);
      if (!effort) break;
      question.effort = *effort;
      answer = checker.judge(question);
      meant = means();
    }
    if (meant.kind == Verdict::Kind::free || !policy.admits_groups()) return meant;
    const PassingOrders orders = orders_for(question, cell, policy, answer);
    if (!alone) alone = std::move(meant);
    if (answer.kind != Verdict::Kind::free) return *alone;
    const auto larger = with_next_jobs(group, plan, begun, orders.in_the_way);
    if (larger.size() == group.size() || larger.size() > 2 * cell.arms.size()) return *alone;
    group = larger;
  }
}

CheckView judged(std::size_t index, const std::vector<std::size_t>& begun, const Plan& plan,
                 const CellPtr& cell_ptr, const std::shared_ptr<const Policy>& policy_ptr,
                 MotionChecker& checker) {
  const Cell& cell = *cell_ptr;
  const Policy& policy = *policy_ptr;
  const Question question = question_for(plan, {index}, begun, cell, policy);
  CheckView view{.kind = Verdict::Kind::conflict, .scene_version = 1};
  if (const auto taken_by = place_taken(question, cell_ptr, policy_ptr)) {
    const Wait wait{.kind = Wait::Kind::capacity, .job = *taken_by};
    view.conflicts.push_back(view_of(wait, cell, plan));
    return view;
  }
  const Verdict verdict = weighed(index, begun, plan, cell, policy, checker);
  view.kind = verdict.kind;
  view.tell(verdict.clearance_bound);
  view.evaluations = verdict.evaluations;
  if (verdict.earliest_start) view.earliest_start_s = to_seconds(*verdict.earliest_start);
  for (const Conflict& conflict : verdict.conflicts) {
    view.conflicts.push_back(view_of(wait_for(conflict), cell, plan));
  }
  return view;
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
  Plan plan(*cell);
  Problems problems;
  for (const TimedJob& timed : jobs) plan.add(timed, problems);
  if (!problems.empty()) return failure(std::move(problems));

  std::vector<std::size_t> order(jobs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return plan.jobs()[i].starts; });
  MotionChecker checker(*scene);
  std::vector<CheckedJob> checked(jobs.size());
  std::vector<std::size_t> begun;
  for (std::size_t index : order) {
    const Planned& job = plan.jobs()[index];
    checked[index].key = job.key;
    CheckView& view = checked[index].verdict;
    view = judged(index, begun, plan, cell, policy, checker);
    if (view.kind == Verdict::Kind::free && !view.earliest_start_s) {
      view.earliest_start_s = to_seconds(job.starts - job.asked);
    } else if (view.earliest_start_s) {  // counted from where it was judged
      *view.earliest_start_s += to_seconds(job.starts - job.asked);
    }
    begun.push_back(index);
  }
  return checked;
}

}  // namespace armloom
