#pragma once

#include <string>
#include <string_view>

#include "core/base/problem.h"
#include "core/executive/executive.h"
#include "server/codec/format.h"

namespace armloom {

// Body of PATCH /jobs/{id}; absent members keep their values.
[[nodiscard]] FormatPtr<JobAmendment> job_amendment_format();
[[nodiscard]] Result<JobAmendment> read_job_amendment(std::string_view text);

// Returns an amendment with the job's present values.
[[nodiscard]] JobAmendment amendable_of(const JobView& job);
void apply(const JobAmendment& amendment, JobRequest& request);

}  // namespace armloom
