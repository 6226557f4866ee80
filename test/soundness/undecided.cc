#include "test/soundness/undecided.h"

#include <algorithm>

#include "core/coordination/effort.h"
#include "test/bench/cells.h"
#include "test/soundness/deviations.h"
#include "test/soundness/soundness.h"

namespace armloom::soundness {
namespace {

constexpr int kThrows = 8;
constexpr double kFar_m = 0.05;

std::vector<PlaceOfPair> open_places(const Verdict& verdict) {
  std::vector<PlaceOfPair> places;
  for (const PairRegions& pair : verdict.regions) {
    for (const ConflictRegion& region : pair.regions) {
      if (!std::holds_alternative<StepId>(pair.b)) continue;
      if (region.proximity.clearance_m < kCloseClearance_m) continue;  // a conflict
      places.push_back({region.time_a, region.time_b});
    }
  }
  for (const Conflict& conflict : verdict.conflicts) {
    if (conflict.with == Conflict::With::motion) {
      places.push_back({conflict.own_time, conflict.other_time});
    }
  }
  return places;
}

}  // namespace

OpenPairs find_open(std::size_t count, std::uint64_t seed, const CheckMethod& method) {
  Cell cell = *bench::two_pandas();
  cell.clearances.clearance_m = kCloseClearance_m;
  const auto shared = std::make_shared<const Cell>(std::move(cell));
  bench::ExactScene exact(shared);
  const Pool pool(exact, std::clamp<std::size_t>(count / 30, 16, 40), seed);
  std::mt19937_64 random(seed + 2);
  OpenPairs found;
  double evaluations = 0.0;
  for (const MovingPair& pair : random_pairs(exact, pool, count, seed + 1)) {
    MotionChecker checker(exact.scene);
    Question question = pair.question(*shared, method);
    Verdict verdict = checker.judge(question);
    std::uint64_t cost = verdict.evaluations;
    while (const auto effort = larger_effort(verdict, question.effort)) {
      question.effort = *effort;
      verdict = checker.judge(question);
      cost += verdict.evaluations;
    }
    evaluations += static_cast<double>(cost);
    found.evaluations_max = std::max(found.evaluations_max, cost);
    ++found.pairs;
    if (verdict.kind == Verdict::Kind::conflict) {
      ++found.conflict;
      continue;
    }
    const std::vector<PlaceOfPair> places = open_places(verdict);
    if (verdict.kind == Verdict::Kind::free && places.empty()) {
      ++(verdict.regions.empty() ? found.free : found.conflict);
      continue;
    }
    double keeps_m = kFar_m;
    const DeviationAttack attack{tracking_errors_of(method), kThrows, kFar_m};
    for (const PlaceOfPair& place : places) {
      keeps_m = std::min(keeps_m, closest_with_deviations(exact, pair, place, attack, random));
    }
    found.open.push_back({found.pairs - 1, keeps_m});
  }
  found.evaluations_mean = evaluations / static_cast<double>(std::max<std::size_t>(count, 1));
  return found;
}

}  // namespace armloom::soundness
