#pragma once

#include <memory>

#include "core/policies/policy.h"

namespace armloom::experiments {

// `coordinated` with passing orders fixed at admission.
inline constexpr const char* kFixedOrders = "coordinated_fixed";

[[nodiscard]] std::shared_ptr<const Policy> make_fixed_orders(const Cell& cell);

}  // namespace armloom::experiments
