#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/coordination/verdict.h"
#include "core/scheduler/waiting/options.h"

namespace armloom {

// Which of several options has a turn: each is given it for a while and asked about, as if there
// were no other; the one with which the plan costs least keeps it. Another one than the first has
// to be better by more than kWorthwhile. The cost: when the last arm has done its work, what waits
// included, and OrderSearch::weight_of_sum times the sum of when each has; of a goal when it
// arrives.
class Choosing {
 public:
  inline static constexpr Duration kWorthwhile = std::chrono::milliseconds(50);

  // Whether there is more than one; then job() has the turn, and is to be asked about.
  [[nodiscard]] bool begin(State& state, JobId turn);
  [[nodiscard]] JobId job() const { return options_[at_].job; }
  // Else it is to be begun anew: one that could have had it has ended.
  [[nodiscard]] bool stands(const State& state) const { return stand(state, options_); }
  // The answer about that one. Whether another one is to be asked about: that has the turn now.
  [[nodiscard]] bool rate(State& state, Verdict verdict);
  // All are rated: the best one has the turn. Its answer; nothing: it waits behind others.
  [[nodiscard]] std::optional<Verdict> decide(State& state);

 private:
  [[nodiscard]] bool comes_to_one_that_goes(State& state);
  void give(State& state, std::size_t option);
  [[nodiscard]] std::size_t best() const;
  void note(State& state, std::size_t best) const;
  void note_only_arm(State& state) const;

  struct Rating {
    std::optional<double> cost;      // s; nothing: it cannot go
    std::optional<Verdict> verdict;  // of one that goes now
  };
  std::vector<Option> options_;
  std::vector<Rating> rated_;  // the first ones
  std::size_t at_ = 0;         // has the turn
};

}  // namespace armloom
