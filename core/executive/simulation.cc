#include "core/executive/simulation.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "core/executive/own_checker.h"

namespace armloom {

// Computes at once, answers kSimulatedJudgement later.
class Simulation::Judge final : public JudgementService {
 public:
  void ask(Question question, PlanningScenePtr scene, std::function<void(Verdict)> done) override {
    MotionChecker& checker = checker_.in(scene);
    const auto begun = std::chrono::steady_clock::now();
    Verdict verdict = checker.judge(question);
    judging_.wall += std::chrono::steady_clock::now() - begun;
    judging_.evaluations += verdict.evaluations;
    ++judging_.judgements;
    answer([verdict = std::move(verdict), done = std::move(done)] { done(verdict); });
  }

  // Uses its own checker, as draw() does, so that the evaluations of verdicts do not change.
  void certify(Question question, PlanningScenePtr scene,
               std::function<void(Verdict)> done) override {
    answer([verdict = certifier_.in(scene).judge(question), done = std::move(done)] {
      done(verdict);
    });
  }

  bool draw(Drawing drawing, PlanningScenePtr scene, std::function<void(Diagram)> done) override {
    answer([diagram = artist_.in(scene).draw(drawing), done = std::move(done)] { done(diagram); });
    return true;
  }

  void plan(PlanTask task) override {
    const auto begun = std::chrono::steady_clock::now();
    PlanAnswer planned = answer_of(task);
    planning_.wall += std::chrono::steady_clock::now() - begun;
    planning_.evaluations += planned ? planned->way.evaluations : planned.error().evaluations;
    if (!task.is_known) ++planning_.plans;
    answer([planned = std::move(planned), done = std::move(task.done)] { done(planned); },
           kSimulatedPlanning);
  }
  bool draft(PlanTask task) override {
    plan(std::move(task));
    return true;
  }

  void deliver(TimePoint now) {
    now_ = now;
    while (!pending_.empty() && pending_.front().due <= now) {
      Answer answer = std::move(pending_.front());
      pending_.pop_front();
      answer.deliver();
    }
  }

  [[nodiscard]] const Judging& judging() const { return judging_; }
  [[nodiscard]] const Planning& planning() const { return planning_; }
  [[nodiscard]] bool is_idle() const { return pending_.empty(); }

 private:
  struct Answer {
    TimePoint due;
    std::function<void()> deliver;
  };
  void answer(std::function<void()> deliver, Duration takes = kSimulatedJudgement) {
    const TimePoint due = now_ + takes;
    const auto later = std::ranges::upper_bound(pending_, due, {}, &Answer::due);
    pending_.insert(later, {due, std::move(deliver)});
  }

  OwnChecker checker_;
  OwnChecker certifier_;
  OwnChecker artist_;
  TimePoint now_{};
  std::deque<Answer> pending_;
  Judging judging_;
  Planning planning_;
};

Simulation::Simulation(std::unique_ptr<Judge> judge) : judge_(std::move(judge)) {}
Simulation::~Simulation() = default;

Result<std::unique_ptr<Simulation>> Simulation::create(CellPtr cell, ExecutiveOptions options,
                                                       Observer& observer) {
  std::unique_ptr<Simulation> simulation(new Simulation(std::make_unique<Judge>()));
  auto executive = Executive::create(cell, std::move(options), *simulation->judge_, observer);
  if (!executive) return failure(std::move(executive.error()));
  simulation->executive_ = std::move(*executive);
  return simulation;
}

const Judging& Simulation::judging() const { return judge_->judging(); }
const Planning& Simulation::planning() const { return judge_->planning(); }

bool Simulation::settled() const {
  return judge_->is_idle() && executive_->settled_until() == TimePoint::max();
}

void Simulation::pass_over_rest(TimePoint until) {
  if (!judge_->is_idle()) return;
  until = std::min(until, executive_->settled_until());
  if (until <= next_) return;
  const auto cycles = (until - next_ + kControlPeriod - Duration(1)) / kControlPeriod;
  next_ += cycles * kControlPeriod;
  judge_->deliver(next_ - kControlPeriod);  // nothing is pending: what it is asked next is timed
}

void Simulation::tick() {
  executive_->tick(next_);
  judge_->deliver(next_);
  LiveScene& scene = executive_->scene();
  if (auto due = scene.due(next_)) (void)scene.edit(std::move(*due));
  next_ += kControlPeriod;
}

void Simulation::run_until(TimePoint time) {
  while (next_ <= time) tick();
}

Result<SimulationResult> simulate(CellPtr cell, ExecutiveOptions options, Scenario scenario,
                                  Observer& observer) {
  const auto begun = std::chrono::steady_clock::now();
  std::vector<TimedJob>& jobs = scenario.jobs;
  const TimePoint time_limit = scenario.time_limit;
  options.ended_kept = std::max(options.ended_kept, jobs.size());
  // A scenario is in memory anyway, and its result contains every job.
  options.active_bytes_max = options.ended_bytes_max = std::numeric_limits<std::size_t>::max();
  auto simulation = Simulation::create(std::move(cell), std::move(options), observer);
  if (!simulation) return failure(std::move(simulation.error()));
  Executive& executive = (*simulation)->executive();

  for (const FaultRequest& fault : scenario.faults) {
    if (auto injected = executive.faults().inject(fault); !injected)
      return failure(injected.error());
  }

  std::vector<std::size_t> order(jobs.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return jobs[i].at; });

  SimulationResult result;
  auto next = order.begin();
  const auto gives_up = [&] {
    result.given_up =
        scenario.gives_up && scenario.gives_up((*simulation)->judging(), (*simulation)->planning());
    return result.given_up;
  };
  while (!result.all_ended && !result.settled && (*simulation)->now() < time_limit && !gives_up()) {
    const TimePoint submitted = next == order.end() ? time_limit : jobs[*next].at;
    (*simulation)->pass_over_rest(std::min(submitted, time_limit));
    (*simulation)->tick();
    for (; next != order.end() && jobs[*next].at <= executive.now(); ++next) {
      auto accepted = executive.submit(std::move(jobs[*next].job));
      if (!accepted) result.refused.push_back({*next, std::move(accepted.error())});
    }
    result.all_ended = next == order.end() && executive.all_ended();
    result.settled = next == order.end() && (*simulation)->settled();
  }
  result.ended_at = executive.now();
  result.figures = executive.figures();
  result.judging = (*simulation)->judging();
  result.planning = (*simulation)->planning();
  result.jobs = executive.snapshot().jobs;
  result.wall = std::chrono::steady_clock::now() - begun;
  return result;
}

}  // namespace armloom
