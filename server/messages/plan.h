#pragma once

#include <string_view>

#include "core/executive/plan_task.h"
#include "server/codec/format.h"
#include "server/messages/problem.h"

namespace armloom {

// The body of POST /plan.
[[nodiscard]] FormatPtr<PlanInquiry> plan_inquiry_format();
[[nodiscard]] Result<PlanInquiry> read_plan_inquiry_text(std::string_view text);

// Its answer.
[[nodiscard]] FormatPtr<PlanView> plan_format();
// Or why there is none: status 422.
[[nodiscard]] ProblemDocument document_of(const RefusedInquiry& refused);
// Links that come too close, or the one that is not brought to its pose; empty: none is at fault.
[[nodiscard]] std::vector<std::string> links_of(const PlanRefusal& refusal);

}  // namespace armloom
