#pragma once

#include "core/executive/job_request.h"
#include "server/codec/member_part.h"

namespace armloom {

// The terms of a job, each described once: the body of POST /jobs is read by it, and every job that
// the server tells of is written by it.
[[nodiscard]] formats::PartPtr<JobTerms> job_terms_part();
// Those that PATCH /jobs/{id} changes.
[[nodiscard]] formats::PartPtr<AmendedTerms> amended_terms_part();

}  // namespace armloom
