#pragma once

#include <optional>
#include <vector>

#include "core/scheduler/scheduler.h"

namespace armloom {

// What would become of a job if it were submitted in this instant: a copy of the scheduler is
// walked on with real answers while time stands still, until the job has had its turn. What it says
// is what the scheduler would do, because it is what the scheduler does. Pure.
//
//   for (auto question = trial.next(); question; question = trial.next()) trial.answer(...);
class Trial {
 public:
  // `open`: the scheduler's open question, if there is one. `asked` is one of the jobs that come
  // now, in this order.
  Trial(Scheduler scheduler, std::optional<Question> open, const std::vector<Submit>& jobs,
        JobId asked, TimePoint now);

  // What has to be answered next; nothing: the outcome is known.
  [[nodiscard]] std::optional<Question> next() const;
  void answer(Verdict verdict);

  struct Outcome {
    Verdict::Kind kind;
    std::optional<Duration> starts_in;  // from now; not free: if it could begin then by the clock
    std::vector<Wait> waits;            // for what; free: before it starts
    std::optional<ClearanceBound> clearance_bound;
    std::uint64_t evaluations = 0;  // for questions about it
  };
  // Precondition: next() is nothing.
  [[nodiscard]] Outcome outcome() const;

  // A job that waits behind so many judgements of others is told what it waits for then.
  static constexpr int kJudgementsMax = 500;

 private:
  void step(const Input& input);
  [[nodiscard]] bool is_decided() const;

  Scheduler scheduler_;
  JobId job_;
  TimePoint now_;
  std::optional<Question> open_;
  int judgements_ = 0;
  std::optional<Verdict> last_;       // on it alone or with others
  std::optional<Duration> by_clock_;  // when it could begin, as last found
  std::vector<Wait> waits_;           // as last told
  std::uint64_t evaluations_ = 0;
};

}  // namespace armloom
