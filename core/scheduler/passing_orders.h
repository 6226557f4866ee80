#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/coordination/conflict_region.h"
#include "core/coordination/verdict.h"
#include "core/scheduler/precedence.h"
#include "core/scheduler/prediction.h"

namespace armloom {

// A motion that is admitted, or is to be. Of one arm the motions follow each other as they stand in
// the list that they are given in; each begins where the one before ends.
struct CoordinatedMotion {
  JobId job;
  std::vector<ArmId> arms;
  Duration duration;
  Duration progress{};   // as measured
  Duration authority{};  // granted so far: no way back behind it
  int priority = 0;
  bool keeps_its_place = false;  // has been overtaken long enough
};

[[nodiscard]] bool share_an_arm(const CoordinatedMotion& a, const CoordinatedMotion& b);

// Why a candidate cannot be admitted.
struct Obstacle {
  JobId candidate;
  std::optional<JobId> other;  // the motion that it cannot pass ...
  std::optional<ArmId> arm;    // ... or the arm that rests in its way
  Proximity proximity;         // evidence; body_a is the candidate's
  Duration own_time;
  Duration other_time;
};

// The answer: who passes first in every region, or what stands against it.
struct PassingOrders {
  std::vector<Precedence> precedences;  // of every region, if admitted; those of before included
  Prediction prediction;                // of the admitted motions, then the candidates
  std::vector<Obstacle> obstacles;      // empty: admitted
  std::vector<ArmId> in_the_way;  // arms that end or rest in the way: a next motion of theirs might
                                  // open it; ascending
};

// Finds the passing orders of the candidates' conflict regions under which everything comes to its
// end, and of these the ones that cost least: the sum over arms of when each has done what is
// admitted, and when the last one has done its work (what waits behind counted); motions of larger
// priority before others. Nobody is made to go back: an order is open, or may be turned, as long as
// the one who would have to wait has no authority in the region.
//
// All assignments are tried for up to kTriedInFull free choices; beyond that, single choices are
// changed while that helps.
inline constexpr std::size_t kTriedInFull = 5;
[[nodiscard]] PassingOrders find_passing_orders(
    const std::vector<CoordinatedMotion>& admitted, const std::vector<Precedence>& precedences,
    const std::vector<CoordinatedMotion>& candidates, const std::vector<PairRegions>& regions,
    const std::vector<Duration>& work_behind);  // by ArmId: of jobs that are in neither list

// The same as an answer to clients about the first of so many candidates: in conflict with the
// obstacles, or free to start when it begins.
[[nodiscard]] Verdict as_verdict(const PassingOrders& orders, std::size_t candidates,
                                 Verdict verdict);

}  // namespace armloom
