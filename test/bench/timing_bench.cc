// Cost of time parameterization.
#include <benchmark/benchmark.h>

#include "core/trajectory/timing/time_parameterization.h"
#include "test/bench/run_benchmarks.h"
#include "test/trajectory/timing/random_paths.h"

namespace armloom {
namespace {

void segment(benchmark::State& state) {
  const Cell cell = testing::test_cell();
  const auto& joints = cell.arms[0].joints;
  std::mt19937_64 random(1);
  std::vector<Eigen::VectorXd> ends;
  for (int i = 0; i < 64; ++i) ends.push_back(testing::random_posture(random, cell, joints));
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(time_line(cell, joints, ends[i % 64], ends[(i + 1) % 64]));
    ++i;
  }
}
BENCHMARK(segment)->Unit(benchmark::kMicrosecond);

template <class Make>
void path(benchmark::State& state, const Make& make) {
  const Cell cell = testing::test_cell();
  const auto& joints = cell.arms[0].joints;
  std::mt19937_64 random(2);
  std::vector<testing::Points> ways;
  for (int i = 0; i < 16; ++i) ways.push_back(make(random, cell, joints, 100));
  std::size_t i = 0, waypoints = 0;
  for (auto _ : state) {
    const auto timed = time_path(cell, joints, JointPath::spline_through(ways[i++ % ways.size()]));
    if (!timed) {
      state.SkipWithError(timed.error().front().detail.c_str());
      return;
    }
    waypoints += timed->request.points.size();
  }
  state.counters["waypoints"] = static_cast<double>(waypoints) / static_cast<double>(i);
}
BENCHMARK_CAPTURE(path, of_100_points_smooth, testing::curve)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(path, of_100_points_winding, testing::wander)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace armloom

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  return armloom::bench::run_benchmarks();
}
