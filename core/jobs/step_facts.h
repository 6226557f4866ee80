#pragma once

#include <optional>
#include <ranges>
#include <set>
#include <span>
#include <unordered_map>

#include "core/jobs/job_updates.h"
#include "core/jobs/step.h"

namespace armloom {

// All steps, with the facts that the rules store about them. Callers read a step, and replace a
// fact as a whole. Each function marks which published views and wait explanations are then out of
// date, and raises the version (State::version) if open answers are.
class StepFacts {
 public:
  // Return null if the step is unknown or forgotten.
  [[nodiscard]] const Step* find(StepId step) const;
  [[nodiscard]] const Step* find(JobId job) const { return find(only_step(job)); }
  [[nodiscard]] const Step& at(StepId step) const { return steps_.at(step); }
  [[nodiscard]] const Step& at(JobId job) const { return at(only_step(job)); }
  // Returns the steps of these ids, looked up one by one. `ids` must outlive the result.
  template <typename Ids>
  [[nodiscard]] auto of(const Ids& ids) const {
    return std::views::transform(ids, [this](auto id) -> const Step& { return at(id); });
  }
  // Returns the jobs that are replanned now.
  [[nodiscard]] const std::set<JobId>& being_replanned() const { return being_replanned_; }
  // Returns the number of changes that have made open answers stale.
  [[nodiscard]] Version changes() const { return changes_; }

  // Marks a job whose wait explanation may be out of date.
  void explain(const Step& step) { updates_.explain(step.id.job); }
  [[nodiscard]] const JobUpdates& updates() const { return updates_; }

  void set_waits(const Step& step, std::span<const Wait> waits);
  void set_wait(const Step& step, const Wait& only) { set_waits(step, {&only, 1}); }

  // Replace data of the present phase. Precondition: the step is in a phase that has them.
  void set(const Step& step, const Moving& data);
  void set(const Step& step, Judgement found);
  void set(const Step& step, std::optional<Pause> pause);

  void set(const Step& step, const Asking& fact) { edit(step).asking = fact; }
  void set(const Step& step, ArmId arm, YieldsTried fact) { edit(step).yields[arm] = fact; }
  void set(const Step& step, Approaches fact) { explained(step).approaches = std::move(fact); }
  void set(const Step& step, std::size_t k, GoalWay fact) { explained(step).goal->ways[k] = fact; }
  void set(const Step& step, PlanRequests fact) { explained(step).plans = std::move(fact); }
  void set(const Step& step, std::optional<Detour> fact);
  void set(const Step& step, AnotherWay fact);
  void set(const Step& step, Choice fact) { changed(step).choice = std::move(fact); }
  void set(const Step& step, const Starvation& fact) { changed(step).starvation = fact; }
  // Replaces the job. Precondition: its terms and its turn are as before.
  void set(const Step& step, Job fact);
  // The admitted motion must be checked again.
  void put_in_question(const Step& step);
  // Start the job's age, or its time as an overtaken job. The first call counts.
  void begin_age(const Step& step, const AgesFrom& from) {
    if (!step.ages_from) edit(step).ages_from = from;
  }
  void begin_overtaken(const Step& step, TimePoint clock) {
    if (!step.overtaken_at) edit(step).overtaken_at = clock;
  }

 protected:
  friend class StateWriter;

  [[nodiscard]] Step& edit(const Step& step) { return steps_.at(step.id); }
  // Mark what is out of date, and return the step to be changed.
  Step& changed(const Step& step) {
    updates_.publish(step.id.job);
    return edit(step);
  }
  Step& explained(const Step& step) {
    explain(step);
    return edit(step);
  }

  std::unordered_map<StepId, Step> steps_;
  std::set<JobId> being_replanned_;
  JobUpdates updates_;
  Version changes_ = 0;
};

}  // namespace armloom
