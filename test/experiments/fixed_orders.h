#pragma once

#include <memory>

#include "core/policies/policy.h"

namespace armloom::experiments {

// `coordinated`, but that who passes first is fixed at admission: what turning orders is worth.
inline constexpr const char* kFixedOrders = "coordinated_fixed";

[[nodiscard]] std::shared_ptr<const Policy> make_fixed_orders(const Cell& cell);

}  // namespace armloom::experiments
