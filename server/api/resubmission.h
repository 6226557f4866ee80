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

// Recognizes a repeated submission.
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

// Ids of jobs accepted before, by position; "" if not accepted.
using KnownJobs = std::vector<std::string>;

[[nodiscard]] Parameter idempotency_parameter();
// Returns SentRequest::key. Problem (malformed): an invalid Idempotency-Key.
[[nodiscard]] Result<std::string> idempotency_key(const ApiParts& parts, const Request& request);

// Calls then(jobs accepted before, respond). Waits while the same key or id is being answered.
// Answers 409 if the key had another body.
void recall(const ApiParts& parts, const SentRequestPtr& sent, Respond respond,
            std::function<void(const KnownJobs&, const Respond&)> then);

// Remembers the accepted jobs. Call it before answering.
void note_accepted(const ApiParts& parts, const SentRequest& sent, const KnownJobs& accepted);

// Binds the key to jobs accepted before, even if found by id.
void note_answered(const ApiParts& parts, const SentRequest& sent, const KnownJobs& known);

[[nodiscard]] RequestOrigin origin_of(const SentRequest& sent, std::size_t place);

// Calls `answer` when the jobs are on disk, if there is a store.
void acknowledge(const ApiParts& parts, std::vector<JobKeeper::AcceptedJob> jobs,
                 const Respond& respond, std::function<Response()> answer);

// Passes the jobs to `then`; skips empty ids. Problem (conflict): the job was forgotten.
void look_at(const ApiParts& parts, const KnownJobs& ids,
             std::function<void(std::vector<Result<ListedJob>>)> then);

}  // namespace armloom
