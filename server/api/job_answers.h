#pragma once

#include <optional>
#include <string>

#include "server/api/parts.h"
#include "server/messages/job.h"

namespace armloom {

// A job that the executive has no more: as the store has it, where there is one.
[[nodiscard]] Result<std::optional<StoredJob>> stored_job(const ApiParts& parts,
                                                          const std::string& key);

// The job with its ETag: the first part of that is of what PATCH can change, the second of all that
// is told.
[[nodiscard]] Response job_answer(int status, const JobView& job, const WallClock& clock);
[[nodiscard]] Response job_answer(const StoredJob& job);
// Whether If-Match holds: what can be changed is as it was when one of these tags was given.
[[nodiscard]] bool is_as_tagged(const std::string& if_match, const JobView& job);

// Why a command to one job was not carried out. One of a former run has ended.
[[nodiscard]] Response refused_command(const ApiParts& parts, const std::string& key,
                                       const Problems& problems);

}  // namespace armloom
