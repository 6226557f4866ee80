#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/api/parts.h"
#include "server/api/route.h"
#include "server/messages/job.h"

namespace armloom {

// Identifies a job submission, so that a repeated request is recognized.
struct SentRequest {
  std::string key;     // Idempotency-Key, preceded by the token's name; empty if none
  std::string digest;  // digest of the body
  struct Job {
    std::string id;  // chosen by the client, or empty
    std::string digest;
  };
  std::vector<Job> jobs;  // in the order of the request
};
using SentRequestPtr = std::shared_ptr<const SentRequest>;

// Ids of the request's jobs that were accepted before, by position; empty if not accepted.
using KnownJobs = std::vector<std::string>;

[[nodiscard]] Parameter idempotency_parameter();
// Returns the request's key, scoped to the token (SentRequest::key). Problem (malformed): an
// invalid Idempotency-Key.
[[nodiscard]] Result<std::string> idempotency_key(const ApiParts& parts, const Request& request);

// Finds the jobs of the request that were accepted before and calls then(known, respond). Waits
// while a request with the same key or id is being answered. Answers 409 if the key was used with
// another body.
void recall(const ApiParts& parts, const SentRequestPtr& sent, Respond respond,
            std::function<void(const KnownJobs&, const Respond&)> then);

// Remembers the accepted jobs, by position. Call before the client is answered.
void note_accepted(const ApiParts& parts, const SentRequest& sent, const KnownJobs& accepted);

// Binds the request's key to jobs accepted before, by position, even if they were found by id.
void note_answered(const ApiParts& parts, const SentRequest& sent, const KnownJobs& known);

[[nodiscard]] RequestOrigin origin_of(const SentRequest& sent, std::size_t place);

// Answers a submission. With a store, the jobs must be on disk first; `answer` is called then.
void acknowledge(const ApiParts& parts, std::vector<JobKeeper::AcceptedJob> jobs,
                 const Respond& respond, std::function<Response()> answer);

// Passes the present state of these jobs to `then`; skips empty ids. Problem (conflict): the job
// ended and was forgotten.
void look_at(const ApiParts& parts, const KnownJobs& ids,
             std::function<void(std::vector<Result<ListedJob>>)> then);

}  // namespace armloom
