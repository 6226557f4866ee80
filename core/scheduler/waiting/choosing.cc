#include "core/scheduler/waiting/choosing.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/policies/policy.h"
#include "core/precedence/order_search.h"
#include "core/scheduler/motion_questions.h"
#include "core/scheduler/weighing.h"

namespace armloom {
namespace {

// Returns when the job reaches its goal (s): as predicted, or after the jobs that wait before it.
double arrival_of(const State& state, const Step& step, const Prediction& prediction) {
  const auto& motions = state.graph.motions();
  if (prediction.ends.size() > motions.size()) return to_seconds(prediction.ends.back());
  const ArmId arm = step.goal->way().goal.arm;
  Duration then = free_at(state, arm, prediction);
  for (const Step& before : state.jobs.of(state.jobs.queues()[arm])) {
    if (before.is_waiting()) then += state.time_for(*before.trajectory);
    if (before.id == step.id) break;
  }
  return to_seconds(then);
}

// Returns the plan's cost (choosing.h) if the job goes as predicted, or else waits on its arm.
double cost_of(const State& state, const Step& step, const Prediction& prediction) {
  if (step.goal) return arrival_of(state, step, prediction);
  std::vector<const Step*> in_front{&step};
  std::vector<double> ends(state.cell->arms.size(), 0.0);
  const auto comes_to = [&](const Trajectory& trajectory, Duration end) {
    for (ArmId arm : trajectory.arms()) {
      ends[arm.index()] = std::max(ends[arm.index()], to_seconds(end));
    }
  };
  const auto& motions = state.graph.motions();
  for (std::size_t m = 0; m < motions.size(); ++m) {
    const Step& admitted = state.jobs.at(motions[m].step);
    comes_to(*admitted.trajectory, prediction.ends[m]);
    in_front.push_back(&admitted);
  }
  std::vector<Duration> behind = work_behind(state, in_front);
  if (prediction.ends.size() > motions.size()) {
    comes_to(*step.trajectory, prediction.ends.back());
  } else {
    for (ArmId arm : step.trajectory->arms())
      behind[arm.index()] += state.time_for(*step.trajectory);
  }
  double last = 0.0, sum = 0.0;
  for (std::size_t arm = 0; arm < ends.size(); ++arm) {
    const double end = ends[arm] + to_seconds(behind[arm]);
    last = std::max(last, end);
    sum += end;
  }
  return last + OrderSearch::weight_of_sum(behind) * sum;
}

PassingOrders orders_with(const State& state, const std::vector<CoordinatedMotion>& candidates,
                          const std::vector<PairRegions>& regions) {
  return state.policy->decide(state.graph.question(candidates, regions));
}

// Returns the cost if the job goes now; nullopt if it cannot.
std::optional<double> cost_with(Transitions& state, JobId job, const Verdict& verdict) {
  if (verdict.kind != Verdict::Kind::free) return std::nullopt;
  const Step& candidate = state->jobs.at(job);
  prepare_choice(state, {candidate.id});
  const PassingOrders orders =
      orders_with(state, {as_candidate(state, candidate)}, verdict.regions);
  if (!orders.blockers.empty()) return std::nullopt;
  return cost_of(state, candidate, orders.prediction);
}

// Returns a lower bound of the cost if the job waits behind others of its arm.
std::optional<double> cost_behind_others(Transitions& state, JobId job) {
  const Step& candidate = state->jobs.at(job);
  prepare_choice(state, {candidate.id});
  const PassingOrders orders = orders_with(state, {}, {});
  if (orders.prediction.ends.size() != state->graph.motions().size()) return std::nullopt;
  return cost_of(state, candidate, orders.prediction);
}

std::string refusal_of(const State& state, const Step& step, std::size_t alternative) {
  if (!step.may_go_by(alternative)) return step.goal->ways[alternative].refusal.value_or("");
  const ArmId arm = step.alternatives[alternative]->arms().front();
  if (is_in(arm, state.around.shared_holds)) return "it holds an object together with another arm";
  return state.arms.is_stopped(arm) ? "it is stopped" : "the arm will not be where the job begins";
}

// Returns the candidate arms that are not among the options, with the reasons.
std::vector<Choice::Without> without(const State& state, const Step& step,
                                     const std::vector<Option>& options) {
  std::vector<Choice::Without> arms;
  for (std::size_t k = 0; k < step.alternatives.size(); ++k) {
    if (std::ranges::find(options, k, &Option::alternative) != options.end()) continue;
    arms.push_back({step.alternatives[k]->arms().front(), refusal_of(state, step, k)});
  }
  return arms;
}

}  // namespace

Duration free_at(const State& state, ArmId arm, const Prediction& prediction) {
  const auto& motions = state.graph.motions();
  Duration ends{};
  for (std::size_t m = 0; m < std::min(motions.size(), prediction.ends.size()); ++m) {
    const auto& arms = motions[m].arms;
    if (std::ranges::find(arms, arm) != arms.end()) ends = std::max(ends, prediction.ends[m]);
  }
  return ends;
}

bool Choosing::begin(Transitions& state, JobId turn) {
  options_ = options_of(state, turn);
  rated_.clear();
  at_ = 0;
  give(state, 0);
  if (options_.size() > 1 && comes_to_one_that_goes(state)) return true;
  give(state, 0);
  note_only_arm(state);
  return false;
}

// Rates options that cannot go now, up to the first that can.
bool Choosing::comes_to_one_that_goes(Transitions& state) {
  for (; rated_.size() < options_.size();
       rated_.push_back({cost_behind_others(state, job()), {}})) {
    give(state, rated_.size());
    if (options_[at_].goes_now) return true;
  }
  return false;
}

void Choosing::give(Transitions& state, std::size_t option) {
  give_turn(state, options_, option);
  at_ = option;
}

bool Choosing::rate(Transitions& state, Verdict verdict) {
  const std::optional<double> cost = cost_with(state, job(), verdict);
  rated_.push_back({cost, std::move(verdict)});
  return comes_to_one_that_goes(state);
}

// Returns the cheapest option; if none can go, the first that was checked.
std::size_t Choosing::best() const {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const auto cost = [&](std::size_t i) { return rated_[i].cost.value_or(kNever); };
  std::size_t best = 0;
  double least = cost(0) - to_seconds(kWorthwhile);
  for (std::size_t i = 1; i < options_.size(); ++i) {
    if (cost(i) >= least) continue;
    best = i;
    least = cost(i);
  }
  if (cost(best) < kNever) return best;
  const auto asked =
      std::ranges::find_if(rated_, [](const Rating& r) { return r.verdict.has_value(); });
  return static_cast<std::size_t>(asked - rated_.begin());
}

std::optional<Verdict> Choosing::decide(Transitions& state) {
  const std::size_t chosen = best();
  give(state, chosen);
  note(state, chosen);
  return std::move(rated_[chosen].verdict);
}

// Notes an arm that is the only possible one.
void Choosing::note_only_arm(Transitions& state) const {
  const Step& step = state->jobs.at(job());
  if (options_.size() > 1 || step.alternatives.empty()) return;
  Choice choice{.arms = step.trajectory->arms(), .without = without(state, step, options_)};
  const auto& before = step.choice;
  if (before && before->arms == choice.arms) return;
  state.jobs().set(step, std::move(choice));
}

void Choosing::note(Transitions& state, std::size_t best) const {
  const Step& taker = state->jobs.at(options_[best].job);
  Choice choice;
  for (const Option& option : options_) {
    if (taker.alternatives.empty()) {
      choice.jobs.push_back(option.job);
    } else {
      choice.arms.push_back(taker.alternatives[option.alternative]->arms().front());
    }
  }
  if (const auto first = options_.front().job; first != taker.id.job) {
    state.jobs().begin_overtaken(state->jobs.at(first), state->clock());
  }
  if (rated_[best].cost && rated_.front().cost) {
    choice.saves = from_seconds(*rated_.front().cost - *rated_[best].cost);
  }
  choice.without = without(state, taker, options_);
  state.jobs().set(taker, std::move(choice));
}

}  // namespace armloom
