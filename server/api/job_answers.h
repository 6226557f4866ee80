#pragma once

#include <optional>
#include <string>
#include <utility>

#include "server/api/parts.h"
#include "server/api/route.h"
#include "server/messages/job.h"

namespace armloom {

// Returns a job that only the store knows; nullopt without a store.
[[nodiscard]] Result<std::optional<StoredJob>> stored_job(const ApiParts& parts,
                                                          const std::string& key);

// Answers with the job and its ETag: the first part covers what PATCH can change, the second the
// whole body.
[[nodiscard]] Response job_answer(int status, const JobView& job, const WallClock& clock);
[[nodiscard]] Response job_answer(const StoredJob& job);

// If-Match holds if a tag matches what PATCH can change, and always for ended jobs.
using IfMatch = std::optional<std::string>;
// nullopt if If-Match does not hold
using Commanded = Result<std::optional<JobView>>;
[[nodiscard]] bool is_as_tagged(const IfMatch& if_match, const std::optional<JobView>& job);
// Refuses a malformed If-Match.
[[nodiscard]] std::optional<Response> bad_if_match(const Request& request);
[[nodiscard]] Parameter if_match_parameter();

// Answers a failed command. Jobs of earlier sessions have ended.
[[nodiscard]] Response refused_command(const ApiParts& parts, const std::string& key,
                                       const Problems& problems);
[[nodiscard]] Response was_changed_since(const std::string& key, const IfMatch& if_match);

// `command(executive, key)` returns a Result<JobView>.
template <class Command>
[[nodiscard]] Commanded commanded(Executive& executive, const std::string& key,
                                  const IfMatch& if_match, const Command& command) {
  if (!is_as_tagged(if_match, executive.job(key))) return std::nullopt;
  auto job = command(executive, key);
  if (!job) return failure(std::move(job.error()));
  return std::optional(std::move(*job));
}

}  // namespace armloom
