#pragma once

#include "core/executive/executive.h"

namespace armloom {

// Fills JobRequest::known.validated, the slow part of a submission, before the request reaches the
// strand. Thread-safe.
void validate_ahead(JobRequest& request, const Cell& cell);

}  // namespace armloom
