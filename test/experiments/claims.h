#pragma once

#include <string>
#include <vector>

#include "test/experiments/run_all.h"

namespace armloom::experiments {

struct Claim {
  bool holds = false;
  std::string sentence;  // with the measured values
};
// Returns the claims of issues 5 and 14 about the experiments, for the policy `best`
// ("coordinated").
[[nodiscard]] std::vector<Claim> claims(const Plan& plan, const std::vector<RunRow>& rows,
                                        const std::string& best);

// Returns (other - best) / (other - bound): the share of another policy's excess over the lower
// bound that the best policy saves.
[[nodiscard]] double realised(double other_s, double best_s, double bound_s);

}  // namespace armloom::experiments
