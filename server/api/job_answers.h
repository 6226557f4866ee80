#pragma once

#include <optional>
#include <string>
#include <utility>

#include "server/api/parts.h"
#include "server/api/route.h"
#include "server/messages/job.h"

namespace armloom {

// Returns the job with this key from the store. nullopt if the store does not have the job, or if
// there is no store.
[[nodiscard]] Result<std::optional<StoredJob>> stored_job(const ApiParts& parts,
                                                          const std::string& key);

// Answers with the job and its ETag, "<first part>.<second part>". The first part changes with the
// members that PATCH can change, the second with anything in the body.
[[nodiscard]] Response job_answer(int status, const JobView& job, const WallClock& clock);
[[nodiscard]] Response job_answer(const StoredJob& job);

// The value of the header If-Match. It holds if the first part of one of its tags matches the job
// (see job_answer()). For an ended job it always holds.
using IfMatch = std::optional<std::string>;
// The result of a command on a job; nullopt if If-Match does not hold.
using Commanded = Result<std::optional<JobView>>;
[[nodiscard]] bool is_as_tagged(const IfMatch& if_match, const std::optional<JobView>& job);
// Refuses a malformed If-Match.
[[nodiscard]] std::optional<Response> bad_if_match(const Request& request);
[[nodiscard]] Parameter if_match_parameter();

// Answers a failed command. If the job is known only from an earlier session, answers 409 ("has
// ended").
[[nodiscard]] Response refused_command(const ApiParts& parts, const std::string& key,
                                       const Problems& problems);
[[nodiscard]] Response was_changed_since(const std::string& key, const IfMatch& if_match);

// If If-Match holds, runs command(executive, key), which returns a Result<JobView>.
template <class Command>
[[nodiscard]] Commanded commanded(Executive& executive, const std::string& key,
                                  const IfMatch& if_match, const Command& command) {
  if (!is_as_tagged(if_match, executive.job(key))) return std::nullopt;
  auto job = command(executive, key);
  if (!job) return failure(std::move(job.error()));
  return std::optional(std::move(*job));
}

}  // namespace armloom
