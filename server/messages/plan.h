#pragma once

#include <string_view>

#include "core/executive/plan_task.h"
#include "server/codec/format.h"
#include "server/messages/problem.h"

namespace armloom {

// Body of POST /plan.
[[nodiscard]] FormatPtr<PlanInquiry> plan_inquiry_format();
[[nodiscard]] Result<PlanInquiry> read_plan_inquiry_text(std::string_view text);

// Answer to POST /plan.
[[nodiscard]] FormatPtr<PlanView> plan_format();
// Returns the problem document (422) that is answered if there is no plan.
[[nodiscard]] ProblemDocument document_of(const RefusedInquiry& refused);
// Returns the two links that come too close, or the link that misses its pose. Empty if the refusal
// names no link.
[[nodiscard]] std::vector<std::string> links_of(const PlanRefusal& refusal);

}  // namespace armloom
