#pragma once

#include "core/executive/executive.h"

namespace armloom {

// Validates the motions of a request and stores the results in JobRequest::known.validated. This is
// the slow part of a submission, done before the request reaches the strand. Motions with an
// implicit start are left for the strand (core/trajectory/implicit_start.h). Thread-safe.
void validate_ahead(JobRequest& request, const Cell& cell);

}  // namespace armloom
