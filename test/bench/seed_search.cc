// Searches the seeds of the workloads (workloads.cc). Needed again if the Panda's shapes, limits or
// random_motion change.
#include <array>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <vector>

#include "test/bench/cells.h"
#include "test/bench/pair_claims.h"
#include "test/bench/workloads.h"

namespace armloom::bench {
namespace {

struct Candidate {
  std::uint64_t seed;
  TrajectoryPtr trajectory;
};

// Returns the first motions of the arm that keep clear of themselves.
std::vector<Candidate> usable(Referees& referees, const CellPtr& cell, ArmId arm, double reach,
                              std::size_t count) {
  std::vector<Candidate> found;
  for (std::uint64_t seed = 1; found.size() < count; ++seed) {
    const TrajectoryPtr trajectory = random_motion(*cell, arm, seed, reach);
    if (keeps_to_itself(referees, {cell, {trajectory}, cell->home()})) {
      found.push_back({seed, trajectory});
    }
  }
  return found;
}

using Claim = std::function<bool(Referees&, const Motions&)>;

void search_pair(const char* name, Referees& referees, const CellPtr& cell, const Claim& claim) {
  constexpr std::size_t kEach = 400;
  const auto left = usable(referees, cell, ArmId{0}, kPairReach, kEach);
  const auto right = usable(referees, cell, ArmId{1}, kPairReach, kEach);
  for (std::size_t sum = 0; sum < 2 * kEach - 1; ++sum) {
    for (std::size_t i = sum < kEach ? 0 : sum - kEach + 1; i <= sum && i < kEach; ++i) {
      if (!claim(referees, {cell, {left[i].trajectory, right[sum - i].trajectory}, cell->home()})) {
        continue;
      }
      std::printf("%s{%lu, %lu}\n", name, left[i].seed, right[sum - i].seed);
      return;
    }
  }
  std::printf("%s: none found\n", name);
}

// Each arm takes the first seed that is clear of the previous arm.
void search_hall() {
  const CellPtr cell = line_of_pandas(2, kHallSpacing_m);
  Referees referees(cell);
  const auto first = usable(referees, cell, ArmId{0}, kHallReach, 60);
  std::printf("kHallSeeds{%lu", first[0].seed);
  std::size_t last = 0;
  for (std::size_t arm = 1; arm < kHallArms; ++arm) {
    for (std::size_t i = arm; i < first.size(); ++i) {
      const Motions two{
          cell,
          {first[last].trajectory, random_motion(*cell, ArmId{1}, first[i].seed, kHallReach)},
          cell->home()};
      if (!are_clear_neighbours(referees, two, 0)) continue;
      last = i;
      break;
    }
    std::printf(", %lu", first[last].seed);
  }
  std::printf("}\n");
}

}  // namespace
}  // namespace armloom::bench

int main() {
  using namespace armloom::bench;
  const armloom::CellPtr cell = two_pandas();
  Referees referees(cell);
  search_pair("kClearSeeds", referees, cell, is_clear_pair);
  search_pair("kCrossingSeeds", referees, cell, is_crossing_pair);
  search_hall();
}
