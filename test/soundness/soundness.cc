#include "test/soundness/soundness.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <ostream>
#include <sstream>

#include "test/bench/cells.h"

namespace armloom::soundness {
namespace {

const Coordinated kExactly{0.0};

std::string milli(double value) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << value * 1e3;
  return text.str();
}

PlanningScenePtr scene_without_clearance(const PlanningScene& like) {
  Cell cell = like.cell();
  cell.clearances.clearance_m = 0.0;
  cell.clearances.self_clearance_m = 0.0;
  const auto scene = PlanningScene::build(std::make_shared<const Cell>(std::move(cell))).value();
  return scene->with_attachments(like.attachments()).value();
}

void measure_certified(const MovingPair& pair, const Truth& truth, const Verdict& verdict,
                       double clearance_m, Report& report) {
  const std::optional<double> met_at_s = first_in_regions_s(verdict, pair);
  const auto fails = [&](const std::string& what) {
    std::ostringstream text;
    text << "pair " << report.pairs << ": " << what << "; truly " << truth.smallest_m * 1e3
         << " mm at " << truth.smallest_at_s << " s";
    report.failures.push_back(text.str());
  };
  const bool below = truth.smallest_m < clearance_m;
  report.colliding += truth.smallest_m <= 0.0 ? 1 : 0;
  report.below += below ? 1 : 0;
  report.close += !below && truth.smallest_m < kHorizon_m ? 1 : 0;
  if (below && !met_at_s) {
    ++report.missed;
    report.missed_collisions += truth.smallest_m <= 0.0 ? 1 : 0;
    fails("called free");
  }
  if (truth.smallest_m > clearance_m + kLoose_m) {
    ++report.above;
    report.false_alarms += met_at_s ? 1 : 0;
  }
  if (below && met_at_s) {
    const double late_s = *met_at_s - *truth.first_below_s;
    if (late_s > 0.001) fails("first in a region " + milli(late_s) + " ms late");
    report.first_conflict_late_max_s = std::max(report.first_conflict_late_max_s, late_s);
  }
  report.evaluations_max = std::max(report.evaluations_max, verdict.evaluations);
  report.evaluations_total += verdict.evaluations;
  ++report.pairs;
}

struct Stay {
  double from_s;
  double to_s;
};

// Returns when a planned motion is between two progress values (forever if it ends there); nullopt
// if never.
std::optional<Stay> stay_of(const Motion& motion, Duration from, Duration to) {
  const Duration end = motion.trajectory->duration();
  const Duration now = std::clamp(motion.progress, Duration{}, end);
  if (now > to || from > end) return std::nullopt;
  return Stay{
      now >= from ? 0.0 : to_seconds(from - motion.progress),
      to >= end ? std::numeric_limits<double>::infinity() : to_seconds(to - motion.progress)};
}

double contact_time_s(const MovingPair& pair, bench::ExactScene& exact) {
  Configuration q = exact.cell().home();
  double time_s = 0.0;
  for (double t_s = 0.0; t_s < pair.span_s(); t_s += kSample_s) {
    pair.state_at(t_s, 0.0, 0.0, q);
    if (exact.between_arms(q, 1e-6) <= 0.0) time_s += kSample_s;
  }
  return time_s;
}

void note_missed(DiscreteRow::Missed& missed, double distance_m, double contact_s) {
  ++missed.pairs;
  missed.deepest_m = std::min(missed.deepest_m, distance_m);
  missed.longest_s = std::max(missed.longest_s, contact_s);
}

}  // namespace

const Conflict* between_motions(const Verdict& verdict) {
  const auto found = std::ranges::find(verdict.conflicts, Conflict::With::motion, &Conflict::with);
  return found == verdict.conflicts.end() ? nullptr : &*found;
}

std::optional<double> first_in_regions_s(const Verdict& regions, const MovingPair& pair) {
  std::optional<double> first_s;
  for (const PairRegions& found : regions.regions) {
    if (!std::holds_alternative<StepId>(found.b)) continue;
    for (const ConflictRegion& region : found.regions) {
      for (const ProgressBox& box : region.boxes) {
        const auto own = stay_of(pair.candidate, box.from_a, box.to_a);
        const auto other = stay_of(pair.other, box.from_b, box.to_b);
        if (!own || !other) continue;
        const double from_s = std::max(own->from_s, other->from_s);
        if (from_s > std::min(own->to_s, other->to_s)) continue;
        first_s = std::min(first_s.value_or(from_s), from_s);
      }
    }
  }
  return first_s;
}

Report measure(std::size_t count, std::uint64_t seed, const std::vector<double>& steps_s,
               bool holding) {
  bench::ExactScene exact(bench::two_pandas());
  if (holding) exact.scene = bench::holding_boxes(exact.scene);
  const Cell& cell = exact.cell();
  const Pool pool(exact, std::clamp<std::size_t>(count / 5, 40, 400), seed);
  TruthSampler sampler(exact);
  MotionChecker checker(exact.scene);
  const PlanningScenePtr without = scene_without_clearance(*exact.scene);
  MotionChecker checker_without(without);
  bench::ExactScene exact_without(CellPtr(without, &without->cell()));  // the scene owns the cell
  exact_without.scene = without;
  Report report;
  for (const double step_s : steps_s) report.discrete.push_back({step_s, {}, {}});
  for (const MovingPair& pair : random_pairs(exact, pool, count, seed + 1)) {
    const Truth truth = sampler.of(pair);
    report.truth_samples += truth.looked_at;
    // This question fills the cache with the checks of the candidate against itself and static
    // bodies.
    Question alone = pair.question(cell, kExactly);
    alone.others.clear();
    static_cast<void>(checker.judge(alone));
    measure_certified(pair, truth, checker.judge(pair.question(cell, kExactly)),
                      cell.clearances.clearance_m, report);
    if (truth.smallest_m > 0.0) continue;
    if (!first_in_regions_s(checker_without.judge(pair.question(cell, kExactly)), pair)) {
      ++report.missed_collisions;
      report.failures.push_back("pair " + std::to_string(report.pairs - 1) +
                                ": without a clearance called free");
    }
    double contact_s = -1.0;
    for (DiscreteRow& row : report.discrete) {
      const TimedDiscrete method{from_seconds(row.step_s)};
      const auto free = [&](MotionChecker& by) {
        return between_motions(by.judge(pair.question(cell, method))) == nullptr;
      };
      if (!free(checker_without)) continue;  // a clearance does not cause more misses
      if (contact_s < 0.0) contact_s = contact_time_s(pair, exact_without);
      note_missed(row.without, truth.smallest_m, contact_s);
      if (free(checker)) note_missed(row.with_clearance, truth.smallest_m, contact_s);
    }
  }
  return report;
}

void print_markdown(const Report& r, std::ostream& out) {
  const auto share = [](std::size_t part, std::size_t of) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(2)
         << (of == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(of)) << " %";
    return text.str();
  };
  out << "| pairs of timed motions | " << r.pairs << " |\n|---|---|\n"
      << "| collide | " << r.colliding << " (" << share(r.colliding, r.pairs) << ") |\n"
      << "| closer than the clearance of 20 mm | " << r.below << " |\n"
      << "| from there to 100 mm | " << r.close << " |\n"
      << "| exact samples of 0.5 ms per pair that could not be skipped | "
      << r.truth_samples / std::max<std::size_t>(r.pairs, 1) << " |\n"
      << "| **certified: collisions missed** | " << r.missed_collisions << " |\n"
      << "| certified: pairs below the clearance reported free | " << r.missed << " |\n"
      << "| certified: false alarms among " << r.above << " pairs above clearance + 50 mm | "
      << r.false_alarms << " (" << share(r.false_alarms, r.above) << ") |\n"
      << "| certified: first state of a region later than the true one, at most | "
      << milli(r.first_conflict_late_max_s) << " ms |\n"
      << "| certified: evaluations of the two motions, mean / most | "
      << r.evaluations_total / std::max<std::size_t>(r.pairs, 1) << " / " << r.evaluations_max
      << " |\n\n";
  out << "| of the " << r.colliding
      << " colliding pairs, reported free | at clearance 0 | deepest | longest contact | at 20 mm "
         "| deepest |\n|---|---|---|---|---|---|\n";
  for (const DiscreteRow& row : r.discrete) {
    out << "| every " << row.step_s << " s | " << row.without.pairs << " | "
        << milli(0.0 - row.without.deepest_m) << " mm | " << milli(row.without.longest_s)
        << " ms | " << row.with_clearance.pairs << " | "
        << milli(0.0 - row.with_clearance.deepest_m) << " mm |\n";
  }
  out << "| certified | " << r.missed_collisions << " | | | " << r.missed_collisions << " | |\n";
}

}  // namespace armloom::soundness
