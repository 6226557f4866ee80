#pragma once

#include <benchmark/benchmark.h>

namespace armloom::bench {

// What main returns: a filter that names no benchmark (it is told) has measured nothing.
inline int run_benchmarks() { return benchmark::RunSpecifiedBenchmarks() > 0 ? 0 : 2; }

}  // namespace armloom::bench
