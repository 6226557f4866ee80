#pragma once

#include <benchmark/benchmark.h>

namespace armloom::bench {

// Fails if the filter matches no benchmark, because nothing was measured.
inline int run_benchmarks() { return benchmark::RunSpecifiedBenchmarks() > 0 ? 0 : 2; }

}  // namespace armloom::bench
