#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/coordination/verdict.h"
#include "core/scheduler/waiting/options.h"

namespace armloom {

// Chooses among options for a turn: each gets the turn temporarily and is checked as if there were
// no other; the cheapest keeps it. An option other than the first must be better by more than
// kWorthwhile. Cost: for a goal its arrival; otherwise the time when the last arm has done all its
// work plus OrderSearch::weight_of_sum times the sum over all arms.
class Choosing {
 public:
  inline static constexpr Duration kWorthwhile = std::chrono::milliseconds(50);

  // Returns false if there is only one option; otherwise job() must be checked.
  [[nodiscard]] bool begin(State& state, JobId turn);
  [[nodiscard]] JobId job() const { return options_[at_].job; }
  // False if a candidate no longer waits; then call begin() again.
  [[nodiscard]] bool stands(const State& state) const { return stand(state, options_); }
  // Takes the verdict for job(). Returns true if job(), now another candidate, must be checked.
  [[nodiscard]] bool rate(State& state, Verdict verdict);
  // After all ratings: gives the turn to the best option and returns its verdict; nullopt if it
  // waits behind other jobs.
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
  std::vector<Rating> rated_;
  std::size_t at_ = 0;
};

}  // namespace armloom
