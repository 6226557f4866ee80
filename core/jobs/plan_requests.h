#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <variant>

#include "core/base/ids.h"
#include "core/coordination/plan_question.h"
#include "core/coordination/verdict.h"

namespace armloom {

// Purposes of a planned path: who takes the answer. std::monostate: no one any more.
struct ForGoal {
  std::size_t way;  // index into JobGoal::ways
  bool operator==(const ForGoal&) const = default;
};
struct ForDetour {
  bool operator==(const ForDetour&) const = default;
};
struct ForReplan {
  bool operator==(const ForReplan&) const = default;
};
struct ForRetreat {
  ArmId arm;
  bool operator==(const ForRetreat&) const = default;
};
using PlanPurpose = std::variant<std::monostate, ForGoal, ForDetour, ForReplan, ForRetreat>;

// An open request for a path (PlanMotion).
struct OpenPlan {
  PlanPurpose purpose;
  PlanQuestion question;
  Version asked_at;
};

// The open requests of a step, by number (PlanMotion::number).
class PlanRequests {
 public:
  // Returns the number of the request.
  std::uint64_t open(OpenPlan request) {
    open_.emplace(++sent_, std::move(request));
    return sent_;
  }
  // Returns the request that is answered; nullopt if none with this number is open.
  [[nodiscard]] std::optional<OpenPlan> close(std::uint64_t number) {
    auto node = open_.extract(number);
    return node.empty() ? std::nullopt : std::optional(std::move(node.mapped()));
  }
  // The answer to this purpose is no longer needed.
  void drop(const PlanPurpose& purpose) {
    for (auto& [number, request] : open_) {
      if (request.purpose == purpose) request.purpose = std::monostate();
    }
  }
  [[nodiscard]] bool is_open(const PlanPurpose& purpose) const {
    for (const auto& [number, request] : open_) {
      if (request.purpose == purpose) return true;
    }
    return false;
  }
  [[nodiscard]] std::uint64_t sent() const { return sent_; }  // so far

 private:
  std::uint64_t sent_ = 0;
  std::map<std::uint64_t, OpenPlan> open_;
};

}  // namespace armloom
