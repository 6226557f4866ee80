#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <set>
#include <utility>

#include "core/executive/drawings.h"
#include "core/executive/open_plans.h"

namespace armloom {

class OpenQuestions {
 public:
  // All arguments outlive this object.
  OpenQuestions(const Scheduler& scheduler, const TaskBook& tasks, const JobRegister& jobs,
                JudgementService& service)
      : service_(service), plans_(service), drawings_(scheduler, tasks, jobs, service) {}

  // Asks the scheduler's question, one at a time. `done` is called on the strand.
  void judge(const Question& question, PlanningScenePtr scene, std::function<void(Judged)> done) {
    asked_ = question;
    service_.ask(question, std::move(scene), [this, done = std::move(done)](Verdict verdict) {
      asked_.reset();
      done(Judged{std::move(verdict)});
    });
  }
  [[nodiscard]] const std::optional<Question>& asked() const { return asked_; }

  // The job has ended: its question is void.
  void give_up(JobId job) {
    if (asks_about(job)) service_.interrupt();
  }
  // If the job is being checked, adds a wait of kind `check` with the progress and returns true.
  [[nodiscard]] bool tell_check(JobView& job) const {
    const auto progress = asks_about(job.id) ? service_.progress() : std::nullopt;
    if (!progress) return false;
    WaitView& wait = job.waits_on.emplace_back(WaitView{.kind = Wait::Kind::check});
    wait.progress = *progress;
    return true;
  }

  // The job is published as being checked.
  void note_shown(JobId job) { shown_.insert(job); }
  [[nodiscard]] std::set<JobId> take_shown() { return std::exchange(shown_, {}); }

  [[nodiscard]] OpenPlans& plans() { return plans_; }
  [[nodiscard]] Drawings& drawings() { return drawings_; }
  // For what-if queries of clients.
  [[nodiscard]] JudgementService& service() { return service_; }

 private:
  [[nodiscard]] bool asks_about(JobId job) const {
    return asked_ && std::ranges::any_of(asked_->candidates, [job](const Motion& motion) {
             return motion.step.job == job;
           });
  }

  JudgementService& service_;
  std::optional<Question> asked_;
  std::set<JobId> shown_;
  OpenPlans plans_;
  Drawings drawings_;
};

}  // namespace armloom
