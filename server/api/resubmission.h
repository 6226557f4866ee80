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

// Identifies a submission, so that a repetition is recognized.
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

// Ids of the jobs that were accepted before, by position in the request. "" for a job that was not
// accepted before.
using KnownJobs = std::vector<std::string>;

[[nodiscard]] Parameter idempotency_parameter();
// Returns SentRequest::key. Problem (malformed): an invalid Idempotency-Key.
[[nodiscard]] Result<std::string> idempotency_key(const ApiParts& parts, const Request& request);

// Calls then(jobs accepted before, respond). While a request with the same key or id is being
// answered, waits for its answer. Answers 409 if the key was used with another body.
void recall(const ApiParts& parts, const SentRequestPtr& sent, Respond respond,
            std::function<void(const KnownJobs&, const Respond&)> then);

// Remembers the accepted jobs. Call it before answering.
void note_accepted(const ApiParts& parts, const SentRequest& sent, const KnownJobs& accepted);

// Remembers that the request's key belongs to these jobs, which were accepted before. Needed if the
// jobs were found by their ids.
void note_answered(const ApiParts& parts, const SentRequest& sent, const KnownJobs& known);

[[nodiscard]] RequestOrigin origin_of(const SentRequest& sent, std::size_t place);

// Responds with answer() when the jobs are on disk; at once if there is no store. If the store
// refuses the jobs, responds with the refusal.
void acknowledge(const ApiParts& parts, std::vector<JobKeeper::AcceptedJob> jobs,
                 const Respond& respond, std::function<Response()> answer);

// Calls then(jobs in their present state). Skips empty ids. Problem (conflict): the job was
// forgotten.
void look_at(const ApiParts& parts, const KnownJobs& ids,
             std::function<void(std::vector<Result<ListedJob>>)> then);

}  // namespace armloom
