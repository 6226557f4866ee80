#pragma once

#include <benchmark/benchmark.h>

namespace armloom::bench {

// Returns main's exit code. A filter that matches no benchmark is an error, because nothing was
// measured.
inline int run_benchmarks() { return benchmark::RunSpecifiedBenchmarks() > 0 ? 0 : 2; }

}  // namespace armloom::bench
