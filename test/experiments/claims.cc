#include "test/experiments/claims.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "test/experiments/fixed_orders.h"
#include "test/experiments/tables.h"

namespace armloom::experiments {
namespace {

constexpr double kOfLockstep = 0.80;
constexpr double kOfSequential = 0.85;
constexpr double kShorter = 0.30;
constexpr double kOrderSlack = 0.02;
constexpr double kMeanAbove = 0.03;  // above the optimum
constexpr double kMostAbove = 0.08;
constexpr double kMeanAboveBound = 0.07;                    // for more than two arms
constexpr double kBehind = 0.01;                            // against earliest_start, any seed
constexpr double kFreeSaves = 0.05;                         // saving by choices of the scheduler
constexpr double kTurningSaves = 0.08;                      // if jobs are late
constexpr const char* kPromisesNothing = "timed_discrete";  // no guarantee between two time steps
// Fastest first.
constexpr const char* kOrder[] = {"coordinated", "earliest_start", "certified", "reservation",
                                  "sequential"};

std::string percent(double ratio) { return fixed(100.0 * ratio, 1) + " %"; }

class Claims {
 public:
  Claims(const std::vector<RunRow>& rows, std::string best) : rows_(rows), best_(std::move(best)) {}

  [[nodiscard]] bool ran(const std::string& workload, const std::string& policy) const {
    return !rows_of(rows_, workload, policy).empty();
  }

  void gain(const std::string& workload, const std::string& other, double wanted) {
    if (!ran(workload, other) || !ran(workload, best_)) return;
    const double share = realised(mean_s(workload, other), mean_s(workload, best_),
                                  mean_bound_s(rows_of(rows_, workload, best_)));
    say(share >= wanted, workload + ": " + best_ + " saves " + percent(share) +
                             " of the time that " + other +
                             " takes above the lower bound (wanted " + percent(wanted) + ")");
  }
  void shorter(const std::string& workload) {
    if (!ran(workload, "lockstep") || !ran(workload, best_)) return;
    const double gained = 1.0 - mean_s(workload, best_) / mean_s(workload, "lockstep");
    say(gained >= kShorter, workload + ": " + best_ + " is " + percent(gained) +
                                " shorter than lockstep (wanted " + percent(kShorter) + ")");
  }
  void order(const std::string& workload) {
    std::string sentence;
    double faster_s = 0.0;
    bool holds = true;
    for (const char* policy : kOrder) {
      if (!ran(workload, policy)) continue;
      const double slower_s = mean_s(workload, policy);
      sentence += (sentence.empty() ? "" : " <= ") + std::string(policy) + " " + fixed(slower_s, 2);
      holds = holds && faster_s <= slower_s * (1.0 + kOrderSlack);
      faster_s = slower_s;
    }
    say(holds, workload + ": " + sentence + " s, each within " + percent(kOrderSlack));
  }
  // Claims that `best` is near the optimum. With more than two arms the optimum is only a lower
  // bound, so only the mean is checked.
  void near_optimum(const std::string& workload) {
    const auto rows = rows_of(rows_, workload, best_);
    if (rows.empty()) return;
    const std::vector<double> ratios = of_optimum(rows);
    const double mean = spread_of(ratios).mean - 1.0;
    const double most = std::ranges::max(ratios) - 1.0;
    const bool two = rows.front()->busy.size() == 2;
    const std::string wanted = two ? percent(kMeanAbove) + " and " + percent(kMostAbove)
                                   : percent(kMeanAboveBound) + " in the mean, of the pair's";
    say(two ? mean <= kMeanAbove && most <= kMostAbove : mean <= kMeanAboveBound,
        workload + ": " + best_ + " is " + percent(mean) + " above the optimum in the mean, " +
            percent(most) + " at worst (wanted " + wanted + ")");
  }
  void never_behind(const std::string& workload, const std::string& other) {
    const auto others = rows_of(rows_, workload, other);
    const auto rows = rows_of(rows_, workload, best_);
    if (others.empty() || other == best_) return;
    const RunRow* worst = nullptr;
    double behind = -1.0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double ratio = rows[i]->makespan_s / others[i]->makespan_s - 1.0;
      if (worst != nullptr && ratio <= behind) continue;
      worst = rows[i];
      behind = ratio;
    }
    if (worst == nullptr) return;
    say(behind <= kBehind, workload + ": " + best_ + " is at most " + percent(behind) + " behind " +
                               other + " (seed " + std::to_string(worst->seed) + "; wanted " +
                               percent(kBehind) + ")");
  }
  void saves(const std::string& workload, const std::string& given) {
    const auto rows = rows_of(rows_, workload, best_);
    const auto others = rows_of(rows_, given, best_);
    if (rows.empty() || others.empty()) return;
    double longest = 0.0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      longest = std::max(longest, rows[i]->makespan_s / others[i]->makespan_s);
    }
    const double saved = 1.0 - mean_s(workload, best_) / mean_s(given, best_);
    say(saved >= kFreeSaves && longest <= 1.0,
        workload + ": " + best_ + " is " + percent(saved) + " shorter than in " + given +
            " in the mean (wanted " + percent(kFreeSaves) + "), " + percent(longest - 1.0) +
            " longer at worst (wanted 0)");
  }
  void turning_pays(const std::string& workload) {
    if (!ran(workload, kFixedOrders) || !ran(workload, "coordinated")) return;
    const double saved = 1.0 - mean_s(workload, "coordinated") / mean_s(workload, kFixedOrders);
    say(saved >= kTurningSaves, workload + ": reversible orders save " + percent(saved) +
                                    " of the makespan with orders fixed at admission (wanted " +
                                    percent(kTurningSaves) + ")");
  }
  void optimum_is_one(const std::string& workload) {
    double least = std::numeric_limits<double>::infinity();
    for (const RunRow& row : rows_) {
      if (row.workload != workload || row.policy == kOneArm) continue;
      if (row.policy == kPromisesNothing) continue;
      least = std::min(least, row.makespan_s / row.limits.optimum.least_s);
    }
    if (std::isinf(least)) return;
    say(least >= 1.0, workload + ": no certified run is shorter than its optimum, the nearest " +
                          percent(least - 1.0) + " above");
  }
  void both_move(const std::string& workload) {
    double least = 1.0;
    const auto rows = rows_of(rows_, workload, best_);
    if (rows.empty()) return;
    for (const RunRow* row : rows) least = std::min(least, row->together);
    say(least > 0.0, workload + ": two arms move at the same time for " +
                         percent(spread_of(rows, &RunRow::together).mean) + " of the time under " +
                         best_ + ", at least " + percent(least) + " in every run");
  }
  void all_succeed() {
    std::size_t jobs = 0;
    std::size_t lost = 0;
    std::uint64_t stops = 0;
    for (const RunRow& row : rows_) {
      // The monitor may have to stop arms that no certificate keeps apart.
      if (row.policy == kPromisesNothing) continue;
      jobs += row.jobs;
      lost += row.not_succeeded;
      stops += row.monitor_stops;
    }
    say(lost == 0 && stops == 0, std::to_string(jobs - lost) + " of " + std::to_string(jobs) +
                                     " jobs of certified policies succeeded, " +
                                     std::to_string(stops) + " monitor stops");
  }

  std::vector<Claim> said;

 private:
  [[nodiscard]] double mean_s(const std::string& workload, const std::string& policy) const {
    return spread_of(rows_of(rows_, workload, policy), &RunRow::makespan_s).mean;
  }
  void say(bool holds, std::string sentence) { said.push_back({holds, std::move(sentence)}); }

  const std::vector<RunRow>& rows_;
  std::string best_;
};

}  // namespace

double realised(double other_s, double best_s, double bound_s) {
  return (other_s - best_s) / (other_s - bound_s);
}

std::vector<Claim> claims(const Plan& plan, const std::vector<RunRow>& rows,
                          const std::string& best) {
  Claims all(rows, best);
  for (const WorkloadKind& kind : plan.workloads) {
    if (!kind.pays) continue;
    all.gain(kind.name, "lockstep", kOfLockstep);
    all.gain(kind.name, "sequential", kOfSequential);
  }
  all.shorter("short_beside_long");
  for (const WorkloadKind& kind : plan.workloads) all.order(kind.name);
  for (const WorkloadKind& kind : plan.workloads) all.both_move(kind.name);
  for (const WorkloadKind& kind : plan.workloads) {
    // A job's late start may fall into a time in which the job waits anyway. So with delays the
    // optimum is no bound.
    if (kind.freed_from.empty() && !kind.delayed && !kind.of_tasks) all.optimum_is_one(kind.name);
  }
  for (const WorkloadKind& kind : plan.workloads) {
    if (kind.delayed || !kind.freed_from.empty() || kind.of_tasks) continue;
    all.near_optimum(kind.name);
    all.never_behind(kind.name, "earliest_start");
  }
  for (const WorkloadKind& kind : plan.workloads) {
    if (!kind.freed_from.empty()) all.saves(kind.name, kind.freed_from);
    if (kind.delayed) all.turning_pays(kind.name);
  }
  all.all_succeed();
  return all.said;
}

}  // namespace armloom::experiments
