#include "core/executive/arm_faults.h"

#include <algorithm>
#include <utility>

#include "core/executive/executive_input.h"

namespace armloom {

ArmFaults::ArmFaults(CellPtr cell, const std::vector<MadeController>& arms, Asked asked)
    : cell_(std::move(cell)), asked_(std::move(asked)) {
  for (const MadeController& arm : arms) arms_.push_back(arm.faults);
}

Result<std::uint64_t> ArmFaults::inject(const FaultRequest& request) {
  const TimePoint now = asked_({ExecutiveInput::Injected{request}});
  const auto arm = cell_->find_arm(request.arm);
  if (!arm) {
    return failure(Problem{ProblemKind::invalid, "unknown-arm", "/arm",
                           "no arm is named \"" + request.arm + "\": GET /arms lists the arms",
                           request.arm});
  }
  if (arms_[arm->index()] == nullptr) {
    return failure(Problem{ProblemKind::invalid, "no-simulated-arm", "/arm",
                           "arm " + request.arm +
                               " has a controller of its own, which takes no "
                               "faults: name a simulated arm",
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
  if (std::ranges::any_of(arms_,
                          [id](FaultTarget* arm) { return arm != nullptr && arm->remove(id); }))
    return {};
  return failure(Problem{ProblemKind::not_found, "unknown-fault", "",
                         "there is no fault " + std::to_string(id), static_cast<double>(id)});
}

}  // namespace armloom
