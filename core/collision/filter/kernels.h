#pragma once

#include <vector>

#include "core/collision/filter/kernel.h"

namespace armloom::filter {

// Returns the fastest kernel that this processor can run. For measurements, the environment
// variable ARMLOOM_KERNEL=scalar|baseline|avx2 selects another kernel. It is ignored if the
// processor cannot run that kernel.
[[nodiscard]] const Kernel& best_kernel();
// Returns all kernels that this processor can run; the first is the scalar reference.
[[nodiscard]] std::vector<const Kernel*> kernels();

}  // namespace armloom::filter
