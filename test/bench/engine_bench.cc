// Benchmarks of the engine on the workloads of the baseline (moveit_way.h). Their names are
// "engine/<question>/<workload>".
#include <benchmark/benchmark.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "core/collision/check/motion_checker.h"
#include "core/collision/state/clearance_query.h"
#include "core/collision/state/placed_cell.h"
#include "test/bench/cells.h"
#include "test/bench/collision_bench.h"

namespace armloom::bench {
namespace {

PlanningScenePtr scene_of(const CellPtr& cell) { return PlanningScene::build(cell).value(); }

// Measures the time per state. Eight states are checked at once.
template <class Ask>
void per_state(benchmark::State& run, const States& states, const Ask& ask) {
  std::vector<const Configuration*> eight(filter::kLanes);
  std::size_t next = 0;
  std::size_t too_close = 0;
  std::size_t asked = 0;
  while (run.KeepRunningBatch(filter::kLanes)) {
    for (const Configuration*& q : eight) {
      q = &states.all[next];
      next = next + 1 == states.all.size() ? 0 : next + 1;
    }
    too_close += static_cast<std::size_t>(__builtin_popcount(ask(eight)));
    asked += eight.size();
  }
  run.counters["not_clear_percent"] =
      100.0 * static_cast<double>(too_close) / static_cast<double>(asked);
}

struct Candidate {
  const Motions& motions;
  std::size_t index;
};

// "cold": nothing is cached. "running": tubes and diagrams of running motions are cached from their
// admission; only the candidate is new.
void per_admission(benchmark::State& run, const Candidate& asked, const CheckMethod& method,
                   bool running, bool must_be_free) {
  const auto& [motions, candidate] = asked;
  const PlanningScenePtr scene = scene_of(motions.cell);
  const Question question = admission(motions, candidate, method);
  Verdict verdict{Verdict::Kind::undecided, 0, {}, std::nullopt, 0};
  for (auto _ : run) {
    run.PauseTiming();
    MotionChecker checker(scene);
    if (running && motions.trajectories.size() > 1) {
      Question before = admission(motions, candidate == 0 ? 1 : 0, method);
      std::erase_if(before.others, [&](const Motion& other) {
        return other.trajectory == asked.motions.trajectories[asked.index];
      });
      benchmark::DoNotOptimize(checker.judge(before));
    }
    run.ResumeTiming();
    verdict = checker.judge(question);
    run.PauseTiming();
    checker = MotionChecker(scene);  // frees its memory outside of the measurement
    run.ResumeTiming();
  }
  run.counters["evaluations"] = static_cast<double>(verdict.evaluations);
  if (must_be_free && verdict.kind != Verdict::Kind::free) run.SkipWithError("not free");
}

void cross_arm(benchmark::State& run, const Motions& motions, bool must_be_free) {
  const PlanningScenePtr scene = scene_of(motions.cell);
  const ProgressBand band{.duration_a = to_seconds(motions.trajectories[0]->duration()),
                          .duration_b = to_seconds(motions.trajectories[1]->duration())};
  const auto left = std::make_shared<const ArmGeometry>(scene->bodies(), ArmId{0});
  const auto right = std::make_shared<const ArmGeometry>(scene->bodies(), ArmId{1});
  const PairSet pairs = pairs_between(scene->bodies(), left->kinematics, right->kinematics);
  CoordinationDiagram::Answer answer;
  // MotionStore also keeps the scratch. It holds nothing about the motions.
  const TubePair::Setting setting{&scene->bodies(), &pairs, TubePair::make_scratch()};
  const auto of_left = MotionTube::make_scratch(*left), of_right = MotionTube::make_scratch(*right);
  for (auto _ : run) {
    CoordinationDiagram diagram(TubePair(
        setting,
        std::make_shared<MotionTube>(left, motions.trajectories[0], motions.rest, 0.0, of_left),
        std::make_shared<MotionTube>(right, motions.trajectories[1], motions.rest, 0.0, of_right)));
    answer = diagram.ask(band, MotionChecker::kBudget);
    benchmark::DoNotOptimize(answer);
  }
  run.counters["evaluations"] = static_cast<double>(answer.evaluations);
  if (must_be_free && !answer.free) run.SkipWithError("not free");
}

// Computes the regions of random pairs of motions that meet, and reports the time per pair.
// blocked_percent is the share of the diagram that is not certified free.
void regions_of_pairs(benchmark::State& run) {
  constexpr std::size_t kPairs = 40;
  constexpr double kReach = 0.8;
  const CellPtr cell = two_pandas();
  const PlanningScenePtr scene = scene_of(cell);
  std::vector<Question> pairs;
  for (std::uint64_t seed = 1; pairs.size() < kPairs; seed += 2) {
    const Motions motions{cell,
                          {random_motion(*cell, ArmId{0}, seed, kReach),
                           random_motion(*cell, ArmId{1}, seed + 1, kReach)},
                          cell->home()};
    const Question question = admission(motions, 0, Coordinated{0.001});
    if (!MotionChecker(scene).judge(question).regions.empty()) pairs.push_back(question);
  }
  double evaluations = 0.0, regions = 0.0, blocked = 0.0, asked = 0.0;
  std::size_t next = 0;
  std::optional<MotionChecker> checker;
  while (run.KeepRunning()) {
    run.PauseTiming();
    const Question& question = pairs[next];
    next = (next + 1) % pairs.size();
    checker.emplace(scene);
    run.ResumeTiming();
    const Verdict verdict = checker->judge(question);
    run.PauseTiming();
    asked += 1.0;
    evaluations += static_cast<double>(verdict.evaluations);
    for (const PairRegions& pair : verdict.regions) {
      regions += static_cast<double>(pair.regions.size());
      for (const ConflictRegion& region : pair.regions) {
        for (const ProgressBox& box : region.boxes) {
          blocked += to_seconds(box.to_a - box.from_a) * to_seconds(box.to_b - box.from_b);
        }
      }
    }
    run.ResumeTiming();
  }
  run.counters["evaluations"] = evaluations / asked;
  run.counters["regions"] = regions / asked;
  run.counters["blocked_percent"] = 100.0 * blocked / asked / (kMotion_s * kMotion_s);
}

void register_states(const Workloads& workloads) {
  for (const auto& [name, workload] : workloads.states) {
    const States& states = workload;
    const PlanningScenePtr scene = scene_of(states.cell);
    const auto decided = [&](const std::string& question, const PairLimits& limits,
                             const PlanningScenePtr& in) {
      benchmark::RegisterBenchmark(
          ("engine/" + question + "/" + name).c_str(), [&states, in, limits](auto& run) {
            ClearanceQuery check(in, limits);
            per_state(run, states, [&](const auto& eight) { return check.too_close(eight); });
          });
    };
    decided("decided_contact", {0.0, 0.0}, scene);
    decided("decided_contact_holding", {0.0, 0.0}, holding_boxes(scene));
    // Compares only the capsules of arms, without exact distances.
    benchmark::RegisterBenchmark(("engine/filter/" + name).c_str(), [&states, scene](auto& run) {
      PlacedCell placed(scene->bodies(), {0.0, 0.0});
      const std::size_t still = scene->cell().arms.size();
      per_state(run, states, [&](const auto& eight) {
        unsigned open = 0;
        placed.place(eight);
        for (const PlacedCell::Comparison& c : placed.comparisons()) {
          if (c.b == still) continue;
          placed.filter(c, 0xFF, [&](const filter::Hit& hit, const auto&) { open |= hit.lanes; });
        }
        return open;
      });
    });
    const Clearances& limits = scene->cell().clearances;
    const PairLimits clearance{limits.clearance_m, limits.self_clearance_m};
    decided("decided_clearance", clearance, scene);
    decided("decided_clearance_holding", clearance, holding_boxes(scene));
  }
}

void register_admissions(const Workloads& workloads) {
  const double tracking = 0.001;
  for (const auto& [name, workload] : workloads.motions) {
    const Motions& motions = workload;
    benchmark::RegisterBenchmark(("engine/cross_arm/" + name).c_str(),
                                 [&motions](auto& run) { cross_arm(run, motions, true); });
    const auto complete = [&](const std::string& question, const CheckMethod& method,
                              bool running) {
      benchmark::RegisterBenchmark(("engine/" + question + "/" + name).c_str(),
                                   [&motions, method, running](auto& run) {
                                     const bool swept = std::holds_alternative<Swept>(method);
                                     per_admission(run, {motions, 0}, method, running, !swept);
                                   });
    };
    complete("admission_swept_cold", Swept{tracking}, false);
    complete("regions_cold", Coordinated{tracking}, false);
    complete("regions_running", Coordinated{tracking}, true);
  }
  benchmark::RegisterBenchmark("engine/regions_cold/random_pairs", regions_of_pairs)
      ->Iterations(40);
  for (const auto& [others, workload] : workloads.halls) {
    const Hall& hall = workload;
    benchmark::RegisterBenchmark(
        ("engine/regions_running/hall_" + std::to_string(others)).c_str(), [&hall](auto& run) {
          per_admission(run, {hall.motions, hall.candidate}, Coordinated{0.001}, true, false);
        });
  }
}

}  // namespace

void register_engine(const Workloads& workloads) {
  register_states(workloads);
  register_admissions(workloads);
}

}  // namespace armloom::bench
