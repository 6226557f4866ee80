// What would become of a job.
#include <utility>

#include "core/executive/executive_impl.h"

namespace armloom {

void Executive::Impl::check(JobRequest request, std::function<void(Result<CheckView>)> done) {
  if (request.move_to) {
    return done(failure(Problem{ProblemKind::invalid, "not-served", "/move_to",
                                "a goal has no trajectory yet that could be judged: POST /plan "
                                "plans one, and says how it is judged"}));
  }
  Ahead ahead = ahead_now();
  auto prepared = prepare(std::move(request), ahead);
  if (!prepared) return done(failure(std::move(prepared.error())));
  std::vector<Submit> jobs;
  std::uint64_t next = scheduler_.next_job().value();
  for (TrajectoryPtr& back : prepared->returns) {
    jobs.push_back(return_of(std::move(back), prepared->priority));
  }
  jobs.push_back(submission(std::move(*prepared)));
  for (Submit& job : jobs) job.job = JobId{next++};
  walk(std::make_shared<Trial>(scheduler_, asked_, jobs, jobs.back().job, now_), std::move(done));
}

// As admission would, in this instant.
void Executive::Impl::walk(std::shared_ptr<Trial> trial,
                           std::function<void(Result<CheckView>)> done) {
  if (auto question = trial->next()) {
    judges_.ask(std::move(*question), scene_,
                [this, trial, done = std::move(done)](Verdict verdict) mutable {
                  trial->answer(std::move(verdict));
                  walk(std::move(trial), std::move(done));
                });
    return;
  }
  Trial::Outcome outcome = trial->outcome();
  for (Wait& wait : outcome.waits) {
    const bool is_known = wait.job && scheduler_.find(*wait.job) != nullptr;
    if (wait.job && !is_known) wait.job.reset();  // its arm's own way back, or forgotten meanwhile
  }
  CheckView view = view_of(outcome, *cell_, *this);
  view.scene_version = scene_version_;
  done(std::move(view));
}

}  // namespace armloom
