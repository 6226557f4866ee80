#include "test/bench/cells.h"
#include "test/bench/collision_bench.h"

namespace armloom::bench {
namespace {

constexpr std::size_t kStates = 1024;
constexpr std::size_t kCircleStates = 256;
constexpr double kCircleRadius_m = 1.0;  // neighbors 0.77 m apart, all reach the center

}  // namespace

Workloads make_workloads() {
  Workloads made;
  const CellPtr pandas = two_pandas();
  Referees referees(pandas);
  StateClasses classes = classed_states(referees, kStates);
  made.states["apart"] = {pandas, std::move(classes.apart)};
  made.states["near"] = {pandas, std::move(classes.near)};
  made.states["touching"] = {pandas, std::move(classes.touching)};
  const CellPtr circle = circle_of_pandas(8, kCircleRadius_m);
  Referees circle_referees(circle);
  made.states["eight_arms"] = {circle, free_states(circle_referees, kCircleStates)};
  made.motions["clear"] = clear_pair();
  made.motions["crossing"] = crossing_pair();
  for (const std::size_t others : {1U, 3U, 7U, 15U}) made.halls.emplace(others, hall(others));
  return made;
}

}  // namespace armloom::bench
