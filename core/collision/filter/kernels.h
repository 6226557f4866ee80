#pragma once

#include <vector>

#include "core/collision/filter/kernel.h"

namespace armloom::filter {

// Returns the fastest kernel that this processor runs. For measurements, the environment variable
// ARMLOOM_KERNEL=scalar|baseline|avx2 selects another (ignored if it cannot run).
[[nodiscard]] const Kernel& best_kernel();
// Returns all kernels that this processor runs, the reference first.
[[nodiscard]] std::vector<const Kernel*> kernels();

}  // namespace armloom::filter
