#pragma once

#include <optional>
#include <vector>

#include "core/scheduler/scheduler.h"

namespace armloom {

// What would become of a job if it were submitted in this instant: a copy of the scheduler is
// walked on with real answers while time stands still, until the job has had its turn, and until it
// is known what becomes of a ring that it closes. What it says is what the scheduler would do,
// because it is what the scheduler does. Pure.
//
//   while (true) {
//     if (auto question = trial.next()) trial.answer(verdict);
//     else if (auto plan = trial.next_plan()) trial.answer(plan made);
//     else break;
//   }
class Trial {
 public:
  // What the scheduler has asked and was not answered yet.
  struct Open {
    std::optional<Question> question = {};
    std::vector<PlanMotion> plans = {};
  };
  // `asked` is one of the jobs that come now, in this order.
  Trial(Scheduler scheduler, Open open, const std::vector<Submit>& jobs, JobId asked,
        TimePoint now);

  // What has to be answered next; nothing: a way has to be planned, or the outcome is known.
  [[nodiscard]] std::optional<Question> next() const;
  void answer(Verdict verdict);
  // Precondition: next() is nothing. Nothing: the outcome is known.
  [[nodiscard]] std::optional<PlanMotion> next_plan() const;
  void answer(const PlanMade& made);

  struct Outcome {
    Verdict::Kind kind;
    std::optional<Duration> starts_in;  // from now; not free: if it could begin then by the clock
    std::vector<Wait> waits;            // for what; free: before it starts
    std::optional<ClearanceBound> clearance_bound;
    std::uint64_t evaluations = 0;                      // for questions about it
    std::optional<Duration> approach = {};              // so long its arms take to where it begins
    Job job = {.id = JobId{0}, .trajectory = nullptr};  // as it was left
  };
  // Precondition: next() and next_plan() are nothing. Of a job whose arms are brought to its start
  // first, and that is not admitted with them: of those motions. It is judged itself in its turn.
  [[nodiscard]] Outcome outcome() const;

  // A job that waits behind so many judgements of others is told what it waits for then.
  static constexpr int kJudgementsMax = 500;
  static constexpr int kPlansMax = 20;

 private:
  void step(const Input& input);
  [[nodiscard]] bool is_in_ring() const;
  [[nodiscard]] bool is_decided() const;
  [[nodiscard]] bool is_on_its_way() const;
  [[nodiscard]] Duration approach_ends() const;
  [[nodiscard]] std::vector<Wait> waits() const;

  Scheduler scheduler_;
  JobId job_;
  TimePoint now_;
  Open open_;
  std::vector<JobId> approaches_;  // of the job
  int judgements_ = 0;
  int plans_ = 0;
  std::optional<Verdict> last_;       // on it alone or with others
  std::optional<Duration> by_clock_;  // when it could begin, as last found
  std::vector<Wait> waits_;           // as last told
  std::uint64_t evaluations_ = 0;
};

}  // namespace armloom
