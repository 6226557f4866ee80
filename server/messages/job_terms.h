#pragma once

#include "core/executive/job_request.h"
#include "server/codec/member_part.h"

namespace armloom {

// Describes the terms of a job, for requests and answers.
[[nodiscard]] formats::PartPtr<JobTerms> job_terms_part();
// Describes the terms that PATCH /jobs/{id} can change.
[[nodiscard]] formats::PartPtr<AmendedTerms> amended_terms_part();

}  // namespace armloom
