#pragma once

#include <optional>
#include <string>
#include <utility>

#include "server/api/parts.h"
#include "server/api/route.h"
#include "server/messages/job.h"

namespace armloom {

// Returns a job from the store, for jobs that the executive no longer knows; nullopt without a
// store.
[[nodiscard]] Result<std::optional<StoredJob>> stored_job(const ApiParts& parts,
                                                          const std::string& key);

// Answers with the job and its ETag. The first part of the tag covers what PATCH can change, the
// second part the whole body.
[[nodiscard]] Response job_answer(int status, const JobView& job, const WallClock& clock);
[[nodiscard]] Response job_answer(const StoredJob& job);

// If-Match of a command to one job. It matches if the members that PATCH can change are as in one
// of these tags. It always matches a job that has ended.
using IfMatch = std::optional<std::string>;
// Result of a command to one job; nullopt if If-Match does not match.
using Commanded = Result<std::optional<JobView>>;
[[nodiscard]] bool is_as_tagged(const IfMatch& if_match, const std::optional<JobView>& job);
// Returns the refusal of a malformed If-Match, or nullopt.
[[nodiscard]] std::optional<Response> bad_if_match(const Request& request);
[[nodiscard]] Parameter if_match_parameter();

// Answers a command that was not carried out. Jobs of earlier sessions are reported as ended.
[[nodiscard]] Response refused_command(const ApiParts& parts, const std::string& key,
                                       const Problems& problems);
[[nodiscard]] Response was_changed_since(const std::string& key, const IfMatch& if_match);

// `command(executive, key)` must return a Result<JobView>.
template <class Command>
[[nodiscard]] Commanded commanded(Executive& executive, const std::string& key,
                                  const IfMatch& if_match, const Command& command) {
  if (!is_as_tagged(if_match, executive.job(key))) return std::nullopt;
  auto job = command(executive, key);
  if (!job) return failure(std::move(job.error()));
  return std::optional(std::move(*job));
}

}  // namespace armloom
