#pragma once

#include "core/executive/job_request.h"
#include "server/codec/member_part.h"

namespace armloom {

// The terms of a job, each described once, for requests and for answers.
[[nodiscard]] formats::PartPtr<JobTerms> job_terms_part();
// The terms that PATCH /jobs/{id} can change.
[[nodiscard]] formats::PartPtr<AmendedTerms> amended_terms_part();

}  // namespace armloom
