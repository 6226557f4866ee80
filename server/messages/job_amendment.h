#pragma once

#include <string>
#include <string_view>

#include "core/base/problem.h"
#include "core/executive/executive.h"
#include "server/codec/format.h"

namespace armloom {

// The body of PATCH /jobs/{id}: members of POST /jobs that can be changed; absent ones stay.
[[nodiscard]] FormatPtr<JobAmendment> job_amendment_format();
[[nodiscard]] Result<JobAmendment> read_job_amendment(std::string_view text);

// All of it as the job has it now.
[[nodiscard]] JobAmendment amendable_of(const JobView& job);
// What was asked for, and changed later.
void apply(const JobAmendment& amendment, JobRequest& request);

}  // namespace armloom
