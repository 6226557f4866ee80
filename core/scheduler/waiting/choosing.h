#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/coordination/verdict.h"
#include "core/scheduler/waiting/options.h"

namespace armloom {

// Chooses which of several options gets a turn: each gets the turn temporarily and is checked as if
// there were no other; the one with the least cost keeps it. An option other than the first must be
// better by more than kWorthwhile. The cost is the time at which the last arm has done its work,
// waiting jobs included, plus OrderSearch::weight_of_sum times the sum of these times over all
// arms; for a goal, its arrival time.
class Choosing {
 public:
  inline static constexpr Duration kWorthwhile = std::chrono::milliseconds(50);

  // Returns true if there are several options; then job() is to be checked.
  [[nodiscard]] bool begin(State& state, JobId turn);
  [[nodiscard]] JobId job() const { return options_[at_].job; }
  // False if a candidate no longer waits; then call begin() again.
  [[nodiscard]] bool stands(const State& state) const { return stand(state, options_); }
  // Takes the verdict for job(). Returns true if another candidate is to be checked; job() is then
  // that one.
  [[nodiscard]] bool rate(State& state, Verdict verdict);
  // Gives the turn to the best option and returns its verdict; nullopt if it waits behind other
  // jobs. Precondition: all options are rated.
  [[nodiscard]] std::optional<Verdict> decide(State& state);

 private:
  [[nodiscard]] bool comes_to_one_that_goes(State& state);
  void give(State& state, std::size_t option);
  [[nodiscard]] std::size_t best() const;
  void note(State& state, std::size_t best) const;
  void note_only_arm(State& state) const;

  struct Rating {
    std::optional<double> cost;      // s; nullopt if it cannot go
    std::optional<Verdict> verdict;  // if it can go now
  };
  std::vector<Option> options_;
  std::vector<Rating> rated_;  // parallel to the front of options_
  std::size_t at_ = 0;         // the option that has the turn
};

}  // namespace armloom
