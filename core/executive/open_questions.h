#pragma once

#include <functional>
#include <optional>
#include <utility>

#include "core/executive/drawings.h"
#include "core/executive/open_plans.h"

namespace armloom {

// What is asked of the judgement service and not answered yet.
class OpenQuestions {
 public:
  // All outlive it.
  OpenQuestions(const Scheduler& scheduler, const JobRegister& jobs, JudgementService& service)
      : service_(service), plans_(service), drawings_(scheduler, jobs, service) {}

  // The scheduler's; one at a time. `done` is called on the strand.
  void judge(const Question& question, PlanningScenePtr scene, std::function<void(Judged)> done) {
    asked_ = question;
    service_.ask(question, std::move(scene), [this, done = std::move(done)](Verdict verdict) {
      asked_.reset();
      done(Judged{std::move(verdict)});
    });
  }
  // That one.
  [[nodiscard]] const std::optional<Question>& asked() const { return asked_; }

  [[nodiscard]] OpenPlans& plans() { return plans_; }
  [[nodiscard]] Drawings& drawings() { return drawings_; }
  // For what clients ask.
  [[nodiscard]] JudgementService& service() { return service_; }

 private:
  JudgementService& service_;
  std::optional<Question> asked_;
  OpenPlans plans_;
  Drawings drawings_;
};

}  // namespace armloom
