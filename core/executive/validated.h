#pragma once

#include "core/executive/executive.h"

namespace armloom {

// JobRequest::validated, where there is anything to validate. Thread-safe: what takes long of a
// submission, done before the strand has it.
void validate_ahead(JobRequest& request, const Cell& cell);

}  // namespace armloom
