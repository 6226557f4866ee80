#pragma once

#include <string>
#include <vector>

#include "core/executive/plan_task.h"
#include "server/codec/format.h"
#include "server/codec/member_part.h"
#include "server/codec/part_groups.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"
#include "server/messages/problem.h"

namespace armloom {

// Body of POST /plan for a goal; see also steps_plan.h.
[[nodiscard]] FormatPtr<PlanInquiry> plan_inquiry_format();
// The members of a request that control the search.
template <class T>
[[nodiscard]] formats::PartPtr<T> search_parts() {
  using namespace formats;
  return parts<T>({
      field("seed", &T::seed, count(), "Seed of the search; the same seed gives the same plan"),
      field("budget", &T::budget, integer(1, kPlanBudgetMax),
            "Maximum number of evaluations (checked line segments) of the search; default: "
            "400,000. Most plans take a few thousand, a straight line none"),
  });
}

// Answer to POST /plan.
[[nodiscard]] FormatPtr<PlanView> plan_format();
// Returns the problem document (422) that is answered if there is no plan.
[[nodiscard]] ProblemDocument document_of(const RefusedInquiry& refused);
// Returns the two links that come too close, or the link that misses its pose. Empty if the refusal
// names no link.
[[nodiscard]] std::vector<std::string> links_of(const PlanRefusal& refusal);

}  // namespace armloom
