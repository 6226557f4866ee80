#include "core/collision/filter/kernels.h"

#include <cstdlib>
#include <string_view>

namespace armloom::filter {

std::vector<const Kernel*> kernels() {
  std::vector<const Kernel*> all{&kScalarKernel, &kBaselineKernel};
#ifndef ARMLOOM_NO_SIMD
  if (__builtin_cpu_supports("avx2") != 0) all.push_back(&kAvx2Kernel);
  if (__builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
      __builtin_cpu_supports("avx512vl") != 0) {
    all.push_back(&kAvx512Kernel);
  }
#endif
  return all;
}

const Kernel& best_kernel() {
  static const Kernel& chosen = *[] {
    const std::vector<const Kernel*> all = kernels();
    const char* wanted = std::getenv("ARMLOOM_KERNEL");
    for (const Kernel* kernel : all) {
      if (wanted != nullptr && std::string_view(wanted) == kernel->name) return kernel;
    }
    return all.back();
  }();
  return chosen;
}

}  // namespace armloom::filter
