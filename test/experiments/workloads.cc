#include "test/experiments/workloads.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include "core/model/cell/build_cell.h"
#include "core/model/xml/text_file.h"
#include "server/codec/cell_codec.h"
#include "server/messages/job_request.h"
#include "test/experiments/job_delays.h"
#include "test/experiments/short_beside_long.h"
#include "test/experiments/shuttles.h"
#include "test/experiments/table_work.h"
#include "test/source_dir.h"

namespace armloom::experiments {
namespace {

template <class T>
T value_of(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().front().detail);
  return *std::move(result);
}

CellPtr config(const std::string& name) {
  const std::filesystem::path folder = source_dir() + "/config";
  const std::string text = value_of(read_text_file(folder / (name + ".json"), "/", "cell"));
  return value_of(build_cell(value_of(read_cell_text(text, folder))));
}

std::vector<ArmId> arms_of(const Cell& cell) {
  std::vector<ArmId> arms;
  for (std::uint32_t i = 0; i < cell.arms.size(); ++i) arms.emplace_back(i);
  return arms;
}

// Adds a task. The arm moves to the tray, goes down to the part and closes its fingers. Then it
// goes up, moves to the middle, goes down, opens its fingers, goes up and moves home.
bool pick_and_place_task(JobMaker& maker, ArmId arm, const Box2& tray_B, const Box2& middle_W) {
  const double speed = maker.draw(0.8, 1.0);
  const auto pick = spot_in_tray(maker, arm, tray_B);
  const auto place = spot_in(maker, arm, middle_W);
  if (!pick || !place) return false;
  return maker.add(arm, TimePoint{},
                   {{"pick", {{pick->above, speed}, {pick->low, speed, kGrip_s}}},
                    {"place",
                     {{pick->above, speed},
                      {place->above, speed},
                      {place->low, speed, kGrip_s},
                      {place->above, speed},
                      {maker.home(arm), speed}}}});
}

// Gives the second arm's work to the first arm, rotated about the middle. Joint positions stay the
// same.
std::vector<PlannedJob> for_first_arm(const Cell& cell, const std::vector<PlannedJob>& jobs) {
  const ArmId first(0);
  std::vector<PlannedJob> all;
  for (const ArmId arm : arms_of(cell)) {
    for (const PlannedJob& job : jobs) {
      if (job.arm != arm) continue;
      PlannedJob mine = job;
      mine.arm = first;
      mine.timed.job.key = cell.arm(first).name + "-for-" + job.timed.job.key;
      for (std::size_t j = 0; j < cell.arm(first).joints.size(); ++j) {
        mine.timed.job.trajectory.joint_names[j] = cell.joint(cell.arm(first).joints[j]).name;
      }
      mine.trajectory = value_of(validate(mine.timed.job.trajectory, cell));
      all.push_back(std::move(mine));
    }
  }
  return all;
}

Workload pick_and_place(std::uint64_t seed) {
  Workload workload{config("two_pandas")};
  JobMaker maker(workload.cell, seed);
  for (int task = 0; task < 6; ++task) {
    for (const ArmId arm : arms_of(*workload.cell)) {
      until_taken([&] { return pick_and_place_task(maker, arm, kTray_B, kMiddle_W); });
    }
  }
  workload.jobs = maker.take();
  workload.one_arm = for_first_arm(*workload.cell, workload.jobs);
  return workload;
}

// The tray is on the outer side of each arm.
Workload four_pandas(std::uint64_t seed) {
  Workload workload{config("four_pandas")};
  JobMaker maker(workload.cell, seed);
  for (int task = 0; task < 4; ++task) {
    for (const ArmId arm : arms_of(*workload.cell)) {
      until_taken([&] {
        return pick_and_place_task(maker, arm, {-0.25, 0.0, 0.4, 0.5}, {-0.2, 0.2, -0.2, 0.2});
      });
    }
  }
  workload.jobs = maker.take();
  return workload;
}

// Lines through one to three random postures and home; jobs arrive over time.
bool random_task(JobMaker& maker, ArmId arm, TimePoint at) {
  constexpr double kSpread_rad[] = {1.3, 0.7, 0.5, 0.7, 0.4, 0.6, 0.8};
  Eigen::VectorXd middle(7);
  middle << 0.0, -0.2, 0.0, -2.0, 0.0, 1.9, 0.785;
  const auto stops = 1 + maker.random()() % 3;
  std::vector<Leg> legs;
  for (std::size_t i = 0; i <= stops; ++i) {
    const double speed = maker.draw(0.5, 1.0);
    Eigen::VectorXd q = maker.home(arm);
    for (Eigen::Index j = 0; i < stops && j < q.size(); ++j) {
      q[j] = middle[j] + maker.draw(-1.0, 1.0) * kSpread_rad[j];
    }
    legs.push_back({q, speed});
  }
  const int priority = static_cast<int>(maker.random()() % 3);
  return maker.add(arm, at, {{"tour", legs, priority}});
}

Workload random_mix(std::uint64_t seed) {
  Workload workload{config("two_pandas")};
  JobMaker maker(workload.cell, seed);
  for (const ArmId arm : arms_of(*workload.cell)) {
    double at_s = 0.0;
    for (int task = 0; task < 8; ++task) {
      const TimePoint when = at(from_seconds(std::round(at_s * 1e3) * 1e-3));
      until_taken([&] { return random_task(maker, arm, when); });
      at_s -= 2.5 * std::log(1.0 - maker.draw(0.0, 1.0));  // Poisson arrivals
    }
  }
  workload.jobs = maker.take();
  return workload;
}

void add_fit(JobMaker& maker, ArmId arm) {
  until_taken([&] {
    const auto place = spot_in(maker, arm, {-0.02, 0.02, -0.02, 0.02});
    const double work_s = maker.draw(2.5, 3.5);
    return place &&
           maker.add(
               arm, TimePoint{},
               {{"fit",
                 {{place->above}, {place->low, 1.0, work_s}, {place->above}, {maker.home(arm)}}}});
  });
}

void add_tending(JobMaker& maker, ArmId arm) {
  constexpr double kTakt_s = 6.0;
  until_taken([&] {
    const auto from = spot_in_tray(maker, arm, kTray_B);
    const auto to = spot_in_tray(maker, arm, kTray_B);
    if (!from || !to) return false;
    std::vector<Leg> legs = {
        {from->above}, {from->low}, {from->above}, {to->above}, {maker.home(arm)}};
    return fill_time(maker.cell(), arm, maker.home(arm), {kTakt_s, 3}, legs) &&
           maker.add(arm, TimePoint{}, {{"tend", legs}});
  });
}

Workload of_fits_and_tending(std::uint64_t seed, int fits, int tending) {
  Workload workload{config("two_pandas")};
  JobMaker maker(workload.cell, seed);
  for (int task = 0; task < fits + tending; ++task) {
    for (const ArmId arm : arms_of(*workload.cell)) {
      task < fits ? add_fit(maker, arm) : add_tending(maker, arm);
    }
  }
  workload.jobs = maker.take();
  return workload;
}

// Each job works in the fixture most of its time, so the arms take turns under every policy.
Workload one_fixture(std::uint64_t seed) { return of_fits_and_tending(seed, 4, 0); }
// The arms never meet, and all jobs take equally long, so lockstep's rounds lose no time.
Workload apart(std::uint64_t seed) { return of_fits_and_tending(seed, 0, 7); }
// In the order of submission both arms first need the fixture, then neither.
Workload fixture_first(std::uint64_t seed) { return of_fits_and_tending(seed, 5, 5); }

// Arms rest only at home between two tasks.
void add_ways_home(std::vector<StepRequest>& steps) {
  std::set<std::string> arms;
  for (const StepRequest& step : steps) {
    if (const auto* motion = std::get_if<MotionStepRequest>(&step.what)) arms.insert(motion->arm);
  }
  for (const std::string& arm : arms) {
    MotionStepRequest home{.trajectory = {}, .arm = arm};
    home.move_to = PlanGoal{.joints = {}, .named = "home", .pose = {}};
    steps.push_back({"home", std::move(home)});
  }
}

// The tasks of config/pick_and_place_jobs.json, twice. They bring the parts there, then back.
// A handover begins when both arms have done the tasks before it: otherwise an arm may retreat from
// the place where the other one is to meet it. Drawn: the order of these tasks, and all speeds.
Workload tasks(std::uint64_t seed) {
  Workload workload{config("pick_and_place")};
  const std::string file = source_dir() + "/config/pick_and_place_jobs.json";
  const auto given = value_of(read_jobs_text(value_of(read_text_file(file, "/", "jobs file"))));
  std::mt19937_64 random(seed);
  for (int round = 1; round <= 2; ++round) {
    std::vector<TimedJob> drawn = given;
    const auto back = drawn.begin() + static_cast<std::ptrdiff_t>(drawn.size() / 2);
    // The last of three hands the bar over.
    std::shuffle(drawn.begin(), back - 1, random);
    std::shuffle(back, drawn.end() - 1, random);
    std::vector<std::string> alone;  // tasks of one arm since the last handover
    for (TimedJob& timed : drawn) {
      const bool is_handover = timed.job.key.starts_with("hand-over");
      timed.job.key += "-" + std::to_string(round);
      if (is_handover) timed.job.after = std::exchange(alone, {});
      if (!is_handover) alone.push_back(timed.job.key);
      timed.job.speed = uniform(random, 0.5, 1.0);
      const std::string arm = std::get<MotionStepRequest>(timed.job.steps.front().what).arm;
      add_ways_home(timed.job.steps);
      workload.jobs.push_back({*workload.cell->find_arm(arm), "task", std::move(timed), nullptr});
    }
  }
  return workload;
}

template <std::vector<PlannedJob> (*jobs)(const CellPtr&, std::uint64_t)>
Workload of_two_pandas(std::uint64_t seed) {
  Workload workload{config("two_pandas")};
  workload.jobs = jobs(workload.cell, seed);
  return workload;
}

template <Workload (*given)(std::uint64_t)>
Workload in_any_order(std::uint64_t seed) {
  Workload workload = given(seed);
  for (PlannedJob& job : workload.jobs) job.timed.job.terms.reorderable = true;
  return workload;
}

template <Workload (*make)(std::uint64_t)>
Workload delayed(std::uint64_t seed) {
  Workload workload = make(seed);
  workload.one_arm.clear();
  delay_some(workload.jobs, seed);
  return workload;
}

}  // namespace

const std::vector<WorkloadKind>& workload_kinds() {
  static const std::vector<WorkloadKind> kinds = {
      {"pick_and_place", "Pick and place, two Pandas", true, pick_and_place},
      {"four_pandas", "Pick and place, four Pandas", true, four_pandas},
      {"short_beside_long", "Short beside long tasks, two Pandas", true,
       of_two_pandas<short_beside_long>},
      {"random_mix", "A random mix that arrives over time, two Pandas", true, random_mix},
      {"shuttles", "To and fro between home and poses in the middle, two Pandas", false,
       of_two_pandas<shuttle_jobs>},
      {"one_fixture", "One fixture for both arms: hardly pays", false, one_fixture},
      {"apart", "Arms that never meet, in takt: does not pay", false, apart},
      {"shuttles_delayed", "To and fro, some jobs late and slow", false,
       delayed<of_two_pandas<shuttle_jobs>>, true},
      {"pick_and_place_delayed", "Pick and place, some jobs late and slow", false,
       delayed<pick_and_place>, true},
      {"one_fixture_delayed", "One fixture for both arms, some jobs late and slow", false,
       delayed<one_fixture>, true},
      {"visits", "Visits of poses in the middle, one kind after the other, two Pandas", false,
       of_two_pandas<visits>},
      {"visits_any", "The same visits in any order", false, in_any_order<of_two_pandas<visits>>,
       false, "visits"},
      {"fixture_first", "Each arm at the one fixture, then at its own tray", false, fixture_first},
      {"fixture_first_any", "The same in any order", false, in_any_order<fixture_first>, false,
       "fixture_first"},
      {"in_turn",
       "Visits that either arm could make, given to them in turn; some that one arm has to make",
       false, of_two_pandas<visits_in_turn>},
      {"either", "The same visits by whichever arm the plan gives them to", false,
       of_two_pandas<visits_by_either>, false, "in_turn"},
      {"tasks", "Tasks that pick, hand over and place parts, two Pandas", false, tasks, false, "",
       true},
  };
  return kinds;
}

const WorkloadKind& workload_kind(const std::string& name) {
  return *std::ranges::find(workload_kinds(), name, &WorkloadKind::name);
}

}  // namespace armloom::experiments
