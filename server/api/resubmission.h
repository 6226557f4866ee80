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

// A request for jobs, as far as it has to be known should it be sent again.
struct SentRequest {
  std::string key;     // Idempotency-Key, with the token's name before it; empty: none
  std::string digest;  // of its body
  struct Job {
    std::string id;  // the client's; empty: none
    std::string digest;
  };
  std::vector<Job> jobs;  // in their places
};
using SentRequestPtr = std::shared_ptr<const SentRequest>;

// Of its jobs those that were accepted before: their ids, in their places; empty: not accepted.
using KnownJobs = std::vector<std::string>;

[[nodiscard]] Parameter idempotency_parameter();
// Each token has its own: SentRequest::key. Problem (malformed): an Idempotency-Key that is none.
[[nodiscard]] Result<std::string> idempotency_key(const ApiParts& parts, const Request& request);

// Looks whether the request has come before, and calls then(known, respond); while one of the same
// key or id is being answered it waits for that. The key with another body is answered: 409.
void recall(const ApiParts& parts, const SentRequestPtr& sent, Respond respond,
            std::function<void(const KnownJobs&, const Respond&)> then);

// Of its jobs these were accepted, in their places. Before the client is told.
void note_accepted(const ApiParts& parts, const SentRequest& sent, const KnownJobs& accepted);

// It was answered with these, accepted before, in their places: its key is its own from now on,
// also where they were known by their ids.
void note_answered(const ApiParts& parts, const SentRequest& sent, const KnownJobs& known);

[[nodiscard]] RequestOrigin origin_of(const SentRequest& sent, std::size_t place);

// Jobs that the executive has accepted are only said to be when they are on disk, where there is a
// store. `answer` is called when the client may be told.
void acknowledge(const ApiParts& parts, std::vector<JobKeeper::AcceptedJob> jobs,
                 const Respond& respond, std::function<Response()> answer);

// The jobs of these ids as they are now; empty ids are passed over. Problem (conflict): it has
// ended so long ago that nothing is known of it.
void look_at(const ApiParts& parts, const KnownJobs& ids,
             std::function<void(std::vector<Result<ListedJob>>)> then);

}  // namespace armloom
