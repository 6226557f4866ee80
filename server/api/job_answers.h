#pragma once

#include <optional>
#include <string>
#include <utility>

#include "server/api/parts.h"
#include "server/api/route.h"
#include "server/messages/job.h"

namespace armloom {

// A job that the executive has no more: as the store has it, where there is one.
[[nodiscard]] Result<std::optional<StoredJob>> stored_job(const ApiParts& parts,
                                                          const std::string& key);

// The job with its ETag: the first part of that is of what PATCH can change, the second of all that
// is told.
[[nodiscard]] Response job_answer(int status, const JobView& job, const WallClock& clock);
[[nodiscard]] Response job_answer(const StoredJob& job);

// If-Match of a command to one job: it holds while what can be changed is as it was when one of
// these tags was given. Of one that has ended it does not matter how it was.
using IfMatch = std::optional<std::string>;
// A command to one job: nothing where If-Match does not hold.
using Commanded = Result<std::optional<JobView>>;
[[nodiscard]] bool is_as_tagged(const IfMatch& if_match, const std::optional<JobView>& job);
// Why the request's is none.
[[nodiscard]] std::optional<Response> bad_if_match(const Request& request);
[[nodiscard]] Parameter if_match_parameter();

// Why a command to one job was not carried out. One of a former run has ended.
[[nodiscard]] Response refused_command(const ApiParts& parts, const std::string& key,
                                       const Problems& problems);
[[nodiscard]] Response was_changed_since(const std::string& key, const IfMatch& if_match);

// `command(executive, key)`, a Result<JobView>.
template <class Command>
[[nodiscard]] Commanded commanded(Executive& executive, const std::string& key,
                                  const IfMatch& if_match, const Command& command) {
  if (!is_as_tagged(if_match, executive.job(key))) return std::nullopt;
  auto job = command(executive, key);
  if (!job) return failure(std::move(job.error()));
  return std::optional(std::move(*job));
}

}  // namespace armloom
