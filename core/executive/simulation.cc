#include "core/executive/simulation.h"

#include <algorithm>
#include <deque>
#include <utility>

namespace armloom {
namespace {

// Computes at once, answers kSimulatedJudgement of simulated time later.
class SimulatedJudge final : public JudgePool {
 public:
  explicit SimulatedJudge(PlanningScenePtr scene) : checker_(std::move(scene)) {}

  void ask(Question question, std::function<void(Verdict)> done) override {
    pending_.push_back({now_ + kSimulatedJudgement, judge(question, checker_), std::move(done)});
  }

  void deliver(TimePoint now) {
    now_ = now;
    while (!pending_.empty() && pending_.front().due <= now) {
      Pending answer = std::move(pending_.front());
      pending_.pop_front();
      answer.done(std::move(answer.verdict));
    }
  }

 private:
  struct Pending {
    TimePoint due;
    Verdict verdict;
    std::function<void(Verdict)> done;
  };
  CollisionChecker checker_;
  TimePoint now_{};
  std::deque<Pending> pending_;
};

}  // namespace

Result<SimulationResult> simulate(CellPtr cell, ExecutiveOptions options,
                                  std::vector<TimedJob> jobs, TimePoint time_limit,
                                  Observer& observer) {
  auto scene = PlanningScene::build(cell);
  if (!scene) return failure(std::move(scene.error()));
  SimulatedJudge judges(std::move(*scene));
  options.ended_kept = std::max(options.ended_kept, jobs.size());
  auto executive = Executive::create(cell, std::move(options), judges, observer);
  if (!executive) return failure(std::move(executive.error()));

  std::vector<std::size_t> order(jobs.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return jobs[i].at; });

  SimulationResult result;
  std::size_t next = 0;
  TimePoint now{};
  for (;; now += kControlPeriod) {
    (*executive)->tick(now);
    judges.deliver(now);
    for (; next < order.size() && jobs[order[next]].at <= now; ++next) {
      auto accepted = (*executive)->submit(std::move(jobs[order[next]].job));
      if (accepted) continue;
      result.refused.push_back(std::move(accepted.error()));
      result.refused_index.push_back(order[next]);
    }
    result.all_ended = next == order.size() && (*executive)->all_ended();
    if (result.all_ended || now >= time_limit) break;
  }
  result.ended_at = now;
  result.figures = (*executive)->figures();
  result.jobs = (*executive)->snapshot().jobs;
  return result;
}

}  // namespace armloom
