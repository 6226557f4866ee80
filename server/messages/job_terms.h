#pragma once

#include "core/executive/job_request.h"
#include "server/codec/member_part.h"

namespace armloom {

// Terms of a job, for requests and answers.
[[nodiscard]] formats::PartPtr<JobTerms> job_terms_part();
// For PATCH /jobs/{id}.
[[nodiscard]] formats::PartPtr<AmendedTerms> amended_terms_part();

}  // namespace armloom
