#include "test/experiments/optimum.h"

#include <gmock/gmock.h>

#include <random>
#include <string>

#include "core/collision/state/clearance_query.h"
#include "test/experiments/open_places.h"
#include "test/experiments/shortest_way.h"
#include "test/experiments/workloads.h"

namespace armloom::experiments {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;

// Cells row by row; '#' is blocked.
struct Table {
  std::size_t columns;
  std::vector<char> blocked;
  std::vector<std::size_t> ready_rows;
  std::vector<std::size_t> ready_columns;

  Table(std::size_t rows, const std::string& cells)
      : columns(cells.size() / rows), ready_rows(rows), ready_columns(columns) {
    for (const char cell : cells) blocked.push_back(cell == '#' ? 1 : 0);
  }
  [[nodiscard]] std::optional<std::size_t> steps() const {
    ShortestWay way(ready_columns);
    for (std::size_t row = 0; row < ready_rows.size(); ++row) {
      way.add_row({blocked.data() + row * columns, columns}, ready_rows[row]);
    }
    return way.steps();
  }
};

// Tracks all positions reachable after each step.
std::optional<std::size_t> steps_by_trying(const Table& table) {
  const std::size_t rows = table.ready_rows.size();
  const auto may = [&](std::size_t row, std::size_t column, std::size_t step) {
    return row < rows && column < table.columns && table.ready_rows[row] <= step &&
           table.ready_columns[column] <= step && table.blocked[row * table.columns + column] == 0;
  };
  const std::size_t all_ready =
      std::max(std::ranges::max(table.ready_rows), std::ranges::max(table.ready_columns));
  std::vector<char> here(table.blocked.size(), 0);
  for (std::size_t step = 0;; ++step) {
    std::vector<char> next(here.size(), 0);
    for (std::size_t cell = 0; cell < here.size(); ++cell) {
      if (here[cell] == 0) continue;
      for (const std::size_t down : {0U, 1U}) {
        for (const std::size_t right : {0U, 1U}) {
          const std::size_t row = cell / table.columns + down;
          const std::size_t column = cell % table.columns + right;
          if (may(row, column, step)) next[row * table.columns + column] = 1;
        }
      }
    }
    if (may(0, 0, step)) next.front() = 1;
    if (next.back() != 0) return step;
    if (next == here && step > all_ready) return std::nullopt;
    here = std::move(next);
  }
}

TEST(ShortestWay, WaitsOutsideABlock) {
  EXPECT_EQ(Table(4, "................").steps(), 3U);
  EXPECT_EQ(Table(4,
                  "...."
                  ".##."
                  ".##."
                  "....")
                .steps(),
            5U);  // one rests while the other passes
  EXPECT_EQ(Table(3, "...###...").steps(), std::nullopt);
}

TEST(ShortestWay, WaitsForRowsAndColumnsThatAreNotReady) {
  Table table(2, "......");
  table.ready_columns[1] = 4;
  EXPECT_EQ(table.steps(), 5U);
  table.ready_rows[1] = 7;
  EXPECT_EQ(table.steps(), 7U);
}

TEST(ShortestWay, MatchesExhaustiveSearch) {
  std::mt19937_64 random(5);
  std::size_t ways = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::size_t rows = 1 + random() % 8;
    Table table(rows, std::string(rows * (1 + random() % 8), '.'));
    const auto density = random() % 5;
    for (char& cell : table.blocked) cell = random() % 10 < density ? 1 : 0;
    for (std::size_t& ready : table.ready_rows) ready = random() % 4 == 0 ? random() % 12 : 0;
    for (std::size_t& ready : table.ready_columns) ready = random() % 4 == 0 ? random() % 12 : 0;
    const auto expected = steps_by_trying(table);
    EXPECT_EQ(table.steps(), expected) << "table " << i;
    ways += expected ? 1 : 0;
  }
  EXPECT_GT(ways, 500U);
}

std::vector<Work> work_of(const Workload& workload, std::size_t each) {
  std::vector<Work> work;
  std::vector<std::size_t> taken(workload.cell->arms.size());
  for (const PlannedJob& job : workload.jobs) {
    if (taken[job.arm.index()]++ < each) work.push_back({job.arm, job.trajectory, job.timed.at});
  }
  return work;
}

const WorkloadKind& kind_of(const std::string& name) {
  return *std::ranges::find(workload_kinds(), name, &WorkloadKind::name);
}

double own_s(const std::vector<Work>& work, ArmId arm) {
  double sum_s = 0.0;
  for (const Work& part : work) {
    if (part.arm == arm) sum_s += to_seconds(part.motion->duration());
  }
  return sum_s;
}

// Finds the optimum without diagrams: tracks all states reachable after each step, and checks them
// one by one.
std::optional<double> optimum_by_trying(const CellPtr& cell, const std::vector<Work>& work,
                                        Duration step) {
  ClearanceQuery check(*PlanningScene::build(cell));
  std::vector<std::vector<Configuration>> moments(2);
  for (const Work& part : work) {
    for (Duration time{}; time < part.motion->duration(); time += step) {
      Configuration q = cell->home();
      place(*part.motion, time, q);
      moments[part.arm.index()].push_back(q);
    }
  }
  Table table(moments[0].size(), std::string(moments[0].size() * moments[1].size(), '.'));
  const auto joints_of_b = cell->arm(ArmId(1)).joints;
  for (std::size_t a = 0; a < moments[0].size(); ++a) {
    for (std::size_t b = 0; b < moments[1].size(); ++b) {
      Configuration q = moments[0][a];
      for (const JointId joint : joints_of_b) {
        const auto j = static_cast<Eigen::Index>(joint.index());
        q[j] = moments[1][b][j];
      }
      const Configuration* state = &q;
      table.blocked[a * table.columns + b] = check.too_close({&state, 1}) != 0 ? 1 : 0;
    }
  }
  const auto steps = steps_by_trying(table);
  if (!steps) return std::nullopt;
  return to_seconds(step) * static_cast<double>(*steps);
}

TEST(Optimum, MatchesExhaustiveSearch) {
  int in_the_way = 0;
  for (const auto& [name, each] : {std::pair{"shuttles", 2U}, {"one_fixture", 1U}}) {
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
      const Workload workload = kind_of(name).make(seed);
      const std::vector<Work> work = work_of(workload, each);
      const Optimum found = optimum(workload.cell, work);
      const auto tried_s = optimum_by_trying(workload.cell, work, 50ms);
      ASSERT_TRUE(tried_s.has_value());
      // Between two instants each arm may be up to 25 ms ahead.
      EXPECT_NEAR(found.least_s, *tried_s, 0.1) << name << ", seed " << seed;
      EXPECT_LE(found.least_s, found.most_s);
      EXPECT_LT(found.most_s, found.least_s + 0.25) << name << ", seed " << seed;
      in_the_way += found.least_s > std::max(own_s(work, ArmId(0)), own_s(work, ArmId(1))) + 0.1;
    }
  }
  EXPECT_GE(in_the_way, 4);
}

TEST(Optimum, OfArmsThatNeverMeetIsTheBusiestArmsWork) {
  const Workload workload = kind_of("apart").make(1);
  std::vector<Work> work = work_of(workload, 2);
  const double least_s = std::max(own_s(work, ArmId(0)), own_s(work, ArmId(1)));
  Optimum found = optimum(workload.cell, work);
  EXPECT_NEAR(found.least_s, least_s, to_seconds(JoinedDiagram::kSquare) + 1e-9);
  EXPECT_LE(found.least_s, least_s);
  EXPECT_GE(found.most_s, least_s);

  for (Work& part : work) part.from = at(part.arm == ArmId(1) ? 3s : 0s);
  found = optimum(workload.cell, work);
  EXPECT_NEAR(found.least_s, own_s(work, ArmId(1)) + 3.0, 3 * to_seconds(JoinedDiagram::kSquare));
  EXPECT_THAT(found.arms, ElementsAre("left", "right"));
}

}  // namespace
}  // namespace armloom::experiments
