#pragma once

#include <string>
#include <vector>

#include "test/experiments/run_all.h"

namespace armloom::experiments {

struct Claim {
  bool holds = false;
  std::string sentence;  // with the figures
};
// What issues 5 and 14 say must hold of the experiments, of the policy `best` ("coordinated").
[[nodiscard]] std::vector<Claim> claims(const Plan& plan, const std::vector<RunRow>& rows,
                                        const std::string& best);

// (other - best) / (other - bound): how much of what a policy leaves above the lower bound another
// one realises.
[[nodiscard]] double realised(double other_s, double best_s, double bound_s);

}  // namespace armloom::experiments
