#pragma once

#include <string>
#include <vector>

#include "test/experiments/run_all.h"

namespace armloom::experiments {

struct Claim {
  bool holds = false;
  std::string sentence;  // with the measured values
};
// Claims of issues 5 and 14 for the policy `best` ("coordinated").
[[nodiscard]] std::vector<Claim> claims(const Plan& plan, const std::vector<RunRow>& rows,
                                        const std::string& best);

// Returns (other - best) / (other - bound): how much of the other policy's excess `best` saves.
[[nodiscard]] double realised(double other_s, double best_s, double bound_s);

}  // namespace armloom::experiments
