#include "test/bench/workloads.h"

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "test/bench/cells.h"
#include "test/bench/pair_claims.h"

namespace armloom::bench {
namespace {

// Found by seed_search.cc; by arm.
constexpr std::array<std::uint64_t, 2> kClearSeeds{1, 1};
constexpr std::array<std::uint64_t, 2> kCrossingSeeds{16, 25};
constexpr std::array<std::uint64_t, kHallArms> kHallSeeds{1,  3,  5,  6,  7,  9,  10, 11,
                                                          13, 13, 14, 16, 17, 18, 20, 22};

Motions pair_of(const std::array<std::uint64_t, 2>& seeds) {
  const CellPtr cell = two_pandas();
  return {cell,
          {random_motion(*cell, ArmId{0}, seeds[0], kPairReach),
           random_motion(*cell, ArmId{1}, seeds[1], kPairReach)},
          cell->home()};
}

void check(bool holds, const std::string& what) {
  if (!holds) throw std::runtime_error(what + " does not hold: search its seeds again");
}

}  // namespace

Motions clear_pair() {
  Motions pair = pair_of(kClearSeeds);
  Referees referees(pair.cell);
  check(is_clear_pair(referees, pair), "the clear pair");
  return pair;
}

Motions crossing_pair() {
  Motions pair = pair_of(kCrossingSeeds);
  Referees referees(pair.cell);
  check(is_crossing_pair(referees, pair), "the crossing pair");
  return pair;
}

Hall hall(std::size_t others) {
  const std::size_t candidate = (others + 1) / 2;
  const std::size_t first = kHallArms / 2 - candidate;
  if (others + 1 > kHallArms) throw std::invalid_argument("hall: too many arms");
  Hall hall{{line_of_pandas(others + 1, kHallSpacing_m), {}, {}}, candidate};
  Motions& motions = hall.motions;
  motions.rest = motions.cell->home();
  for (std::size_t i = 0; i <= others; ++i) {
    motions.trajectories.push_back(random_motion(
        *motions.cell, ArmId{static_cast<std::uint32_t>(i)}, kHallSeeds[first + i], kHallReach));
  }
  Referees referees(motions.cell);
  check(is_clear_hall(referees, motions), "the hall of " + std::to_string(others + 1));
  return hall;
}

Question admission(const Motions& motions, std::size_t candidate, const CheckMethod& method) {
  Question question{.version = 1,
                    .start_at = TimePoint{},
                    .candidates = {},
                    .others = {},
                    .rest = motions.rest,
                    .method = method};
  for (std::size_t i = 0; i < motions.trajectories.size(); ++i) {
    Motion motion{StepId{JobId{i + 1}}, motions.trajectories[i], Duration{0}};
    (i == candidate ? question.candidates : question.others).push_back(std::move(motion));
  }
  return question;
}

}  // namespace armloom::bench
