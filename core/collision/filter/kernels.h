#pragma once

#include <vector>

#include "core/collision/filter/kernel.h"

namespace armloom::filter {

// The fastest kernel that this processor runs. ARMLOOM_KERNEL=scalar|baseline|avx2 in the
// environment asks for another one (ignored where it cannot run), for measurements.
[[nodiscard]] const Kernel& best_kernel();
// All that this processor runs, the reference first.
[[nodiscard]] std::vector<const Kernel*> kernels();

}  // namespace armloom::filter
