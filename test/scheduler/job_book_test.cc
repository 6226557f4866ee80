#include "core/jobs/job_book.h"

#include <gtest/gtest.h>

#include "core/jobs/transitions.h"
#include "core/policies/policy_names.h"
#include "test/scheduler/bench_cell.h"

namespace armloom {
namespace {

// A server-initiated job stays before its job. The wrong order caused an endless loop (soak,
// certified, seed 21000112).
TEST(JobBook, SortsByTurnWithinEachArmQueue) {
  const CellPtr cell = one_joint_arms(1);
  Transitions state(
      State(cell, std::move(*make_policy("certified", *cell)), cell->home(), JobId{1}));
  const auto add_job = [&](std::optional<JobId> before) {
    const JobId id = state->jobs.next_id();
    state.add({id, move({0}, 0.0, 0.0, 1s)}, Errand{.on_behalf_of = id, .before = before});
    return id;
  };
  const JobId ahead = add_job({}), last = add_job({}), errand = add_job(last);
  EXPECT_EQ(in_turn(state->jobs, {ahead, last, errand}), (std::vector{ahead, errand, last}));
  EXPECT_EQ(in_turn(state->jobs, {last, errand}), (std::vector{errand, last}));
}

}  // namespace
}  // namespace armloom
