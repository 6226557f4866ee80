#include "core/policies/policy.h"

namespace armloom {
namespace {

PassingOrders start_now(const OrderQuestion& question) {
  return orders_in_time(question, Duration{});
}

PassingOrders start_at_any_time(const OrderQuestion& question) {
  return orders_in_time(question, std::nullopt);
}

// scheduler/README.md describes each policy.
Policy values_of(PolicyName name, const Cell& cell) {
  const char* text = to_string(name);
  const CheckMethod all_regions = Coordinated{TrackingErrors(cell)};
  switch (name) {
    case PolicyName::sequential:
      return {text, all_regions, orders_apart, Capacity::one_job};
    case PolicyName::lockstep:
      return {text, all_regions, start_now, Capacity::rounds};
    case PolicyName::reservation:
      return {text, Swept{TrackingErrors(cell)}, orders_apart};
    case PolicyName::timed_discrete:
      return {text, TimedDiscrete{cell.checking.time_step}, orders_apart};
    case PolicyName::certified:
      return {text, all_regions, start_now};
    case PolicyName::earliest_start:
      return {text, all_regions, start_at_any_time};
    case PolicyName::coordinated:
      return {.name = text,
              .method = all_regions,
              .decide = cheapest_orders,
              .lookahead = {.horizon = static_cast<std::size_t>(cell.scheduling.horizon_steps),
                            .admits_groups = true,
                            .weighs_again = true}};
  }
  return {};
}

}  // namespace

Result<std::unique_ptr<const Policy>> make_policy(std::string_view name, const Cell& cell) {
  const auto named = policy_named(name);
  if (!named) return failure(named.error());
  return std::make_unique<const Policy>(values_of(*named, cell));
}

}  // namespace armloom
