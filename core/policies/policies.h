#pragma once

#include <memory>

#include "core/policies/policy.h"

namespace armloom {

[[nodiscard]] std::unique_ptr<const Policy> make_sequential(const Cell& cell);
[[nodiscard]] std::unique_ptr<const Policy> make_lockstep(const Cell& cell);
[[nodiscard]] std::unique_ptr<const Policy> make_reservation(const Cell& cell);
[[nodiscard]] std::unique_ptr<const Policy> make_timed_discrete(const Cell& cell);
[[nodiscard]] std::unique_ptr<const Policy> make_certified(const Cell& cell);
[[nodiscard]] std::unique_ptr<const Policy> make_earliest_start(const Cell& cell);
[[nodiscard]] std::unique_ptr<const Policy> make_coordinated(const Cell& cell);

}  // namespace armloom
