#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/coordination/verdict.h"
#include "core/scheduler/waiting/options.h"

namespace armloom {

// Chooses among the options for a turn (options.h). Each option gets the turn temporarily and is
// checked as if there were no other. The cheapest option then keeps the turn; another option than
// the first must be cheaper by more than kWorthwhile. The cost is
// - for a goal, the arrival time;
// - otherwise, the time when the last arm has done all its work, plus OrderSearch::weight_of_sum
//   times the sum of these times over all arms.
class Choosing {
 public:
  inline static constexpr Duration kWorthwhile = std::chrono::milliseconds(50);

  // Begins to choose. If there are several options, returns true, and job() must be checked.
  // Otherwise returns false.
  [[nodiscard]] bool begin(Transitions& state, JobId turn);
  [[nodiscard]] JobId job() const { return options_[at_].job; }
  // Returns false if an option no longer waits; then call begin() again.
  [[nodiscard]] bool stands(const State& state) const { return stand(state, options_); }
  // Takes the verdict for job(). Returns true if there is a further option: job() is then that
  // option, and must be checked.
  [[nodiscard]] bool rate(Transitions& state, Verdict verdict);
  // Call when rate() has returned false. Gives the turn to the best option and returns its verdict;
  // nullopt if that option waits behind other jobs.
  [[nodiscard]] std::optional<Verdict> decide(Transitions& state);

 private:
  [[nodiscard]] bool comes_to_one_that_goes(Transitions& state);
  void give(Transitions& state, std::size_t option);
  [[nodiscard]] std::size_t best() const;
  void note(Transitions& state, std::size_t best) const;
  void note_only_arm(Transitions& state) const;

  struct Rating {
    std::optional<double> cost;      // s; nullopt if the option cannot go
    std::optional<Verdict> verdict;  // set if the option was checked
  };
  std::vector<Option> options_;
  std::vector<Rating> rated_;
  std::size_t at_ = 0;
};

// Returns when the last admitted motion of the arm ends, from now; zero if it has none.
[[nodiscard]] Duration free_at(const State& state, ArmId arm, const Prediction& prediction);

}  // namespace armloom
