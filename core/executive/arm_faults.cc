#include "core/executive/arm_faults.h"

#include <algorithm>
#include <utility>

#include "core/executive/executive_input.h"

namespace armloom {

ArmFaults::ArmFaults(CellPtr cell, const std::vector<std::unique_ptr<FaultyArm>>& arms, Asked asked)
    : cell_(std::move(cell)), asked_(std::move(asked)) {
  for (const auto& arm : arms) arms_.push_back(arm.get());
}

Result<std::uint64_t> ArmFaults::inject(const FaultRequest& request) {
  const TimePoint now = asked_({ExecutiveInput::Injected{request}});
  const auto arm = cell_->find_arm(request.arm);
  if (!arm) {
    return failure(Problem{ProblemKind::invalid, "unknown-arm", "/arm",
                           "no arm is named \"" + request.arm + "\": GET /arms lists the arms",
                           request.arm});
  }
  ArmFault fault{
      .kind = request.kind, .from = request.at.value_or(now), .until = {}, .value = request.value};
  if (request.lasting) fault.until = fault.from + *request.lasting;
  arms_[arm->index()]->inject(next_, fault);
  return next_++;
}

Result<void> ArmFaults::remove(std::uint64_t id) {
  asked_({ExecutiveInput::FaultRemoved{id}});
  if (std::ranges::any_of(arms_, [id](FaultyArm* arm) { return arm->remove(id); })) return {};
  return failure(Problem{ProblemKind::not_found, "unknown-fault", "",
                         "there is no fault " + std::to_string(id), static_cast<double>(id)});
}

}  // namespace armloom
