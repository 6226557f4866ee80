// POST /batches.
#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include "core/base/add_below.h"
#include "core/executive/batch.h"
#include "core/executive/validated.h"
#include "server/access/digest.h"
#include "server/api/examples.h"
#include "server/api/resubmission.h"
#include "server/api/route.h"
#include "server/messages/job.h"
#include "server/messages/job_request.h"

namespace armloom {
namespace {

using Results = std::vector<Result<ListedJob>>;  // one for each job of the batch

struct Batch {
  BatchRequest request;
  SentRequestPtr sent;
  KnownJobs known;  // jobs accepted before

  [[nodiscard]] bool is_new(std::size_t place) const {
    return request.jobs[place].job.has_value() && known[place].empty();
  }
};
using BatchPtr = std::shared_ptr<const Batch>;

SentRequestPtr sent_of(std::string key, const Submission<BatchRequest>& read) {
  SentRequest sent{std::move(key), sha256_hex(read.canonical), {}};
  for (const BatchRequest::Entry& entry : read.request.jobs) {
    sent.jobs.push_back({entry.job ? entry.job->key : std::string(), sha256_hex(entry.text)});
  }
  return std::make_shared<const SentRequest>(std::move(sent));
}

Response batch_response(bool atomic, const Results& results, const WallClock& clock) {
  if (!atomic) return answer(207, batch_results_format(), results, &clock);
  std::vector<ListedJob> jobs;
  for (const Result<ListedJob>& result : results) jobs.push_back(result.value());
  return answer(202, batch_accepted_format(), jobs, &clock);
}

// Returns the answer if the store refuses the whole batch, else nullopt. In a non-atomic batch,
// replaces each job that the store refuses by its problems.
std::optional<Response> refused_by_store(const ApiParts& parts, Batch& batch) {
  Problems problems;
  if (parts.keeper == nullptr) return std::nullopt;
  if (const auto refusal = parts.keeper->refusal()) return refusal_response(*refusal);
  for (std::size_t i = 0; i < batch.request.jobs.size(); ++i) {
    if (!batch.is_new(i)) continue;
    Result<JobRequest>& job = batch.request.jobs[i].job;
    const auto known = parts.keeper->look_up(*job);
    if (known) continue;
    if (!batch.request.atomic) {
      job = failure(known.error());
      continue;
    }
    add_below("/jobs/" + std::to_string(i), known.error(), problems);
  }
  if (problems.empty()) return std::nullopt;
  return problem_response(problems);
}

void answer_known_batch(const ApiParts& parts, const BatchPtr& batch, const Respond& respond) {
  look_at(parts, batch->known, [&parts, batch, respond](const Results& results) {
    std::vector<ListedJob> jobs;
    for (const Result<ListedJob>& result : results) {
      if (!result) return respond(problem_response(result.error()));
      jobs.push_back(*result);
    }
    note_answered(parts, *batch->sent, batch->known);
    respond(answer(200, batch_accepted_format(), jobs, &parts.clock));
  });
}

// Merges the results of new jobs, jobs accepted before and unreadable jobs, in the order of the
// batch.
Results merged(const Batch& batch, const std::vector<Result<JobView>>& submitted, Results before) {
  Results results;
  auto next_new = submitted.begin();
  auto next_known = before.begin();
  for (std::size_t i = 0; i < batch.known.size(); ++i) {
    if (batch.is_new(i)) {
      const Result<JobView>& job = *next_new++;
      results.push_back(job ? Result<ListedJob>(ListedJob(*job)) : failure(job.error()));
    } else if (!batch.known[i].empty()) {
      results.push_back(std::move(*next_known++));
    } else {
      results.push_back(failure(batch.request.jobs[i].job.error()));
    }
  }
  return results;
}

// For a batch that the executive has taken: the jobs to store, and the answer.
struct Taken {
  std::vector<JobKeeper::AcceptedJob> accepted = {};
  KnownJobs ids;  // ids of accepted jobs by position
  Response response = {};
};

Taken taken(const Batch& batch, const std::vector<Result<JobView>>& submitted, Results before,
            const WallClock& clock, bool is_stored) {
  Taken all{.ids = KnownJobs(batch.known.size())};
  auto next = submitted.begin();
  for (std::size_t i = 0; i < all.ids.size(); ++i) {
    if (!batch.is_new(i)) continue;
    if (const Result<JobView>& job = *next++) {
      all.accepted.push_back({*job, batch.request.jobs[i].text, origin_of(*batch.sent, i)});
      if (is_stored) all.accepted.back().row = row_of(*job, clock);
      all.ids[i] = job->key;
    }
  }
  const Results results = merged(batch, submitted, std::move(before));
  all.response = batch_response(batch.request.atomic, results, clock);
  return all;
}

// Writes the answer on a worker thread, because a thousand jobs take long.
void tell(const ApiParts& parts, const BatchPtr& batch,
          const std::shared_ptr<const Executive::BatchAnswers>& submitted, const Respond& respond) {
  look_at(parts, batch->known, [&parts, batch, submitted, respond](const Results& before) {
    parts.aside([&parts, batch, submitted, respond, before, clock = parts.clock] {
      const bool is_stored = parts.keeper != nullptr;
      const auto all =
          std::make_shared<Taken>(taken(*batch, **submitted, before, clock, is_stored));
      parts.post([&parts, batch, respond, all] {
        acknowledge(parts, std::move(all->accepted), respond, [&parts, batch, all] {
          note_accepted(parts, *batch->sent, all->ids);
          note_answered(parts, *batch->sent, batch->known);
          return std::move(all->response);
        });
      });
    });
  });
}

// Submits the jobs to the executive in chunks, so that control cycles and stops run in between.
// Then calls `then` on the server's thread.
void take(const ApiParts& parts, std::vector<JobRequest> jobs, bool atomic,
          std::function<void(const std::shared_ptr<const Executive::BatchAnswers>&)> then) {
  struct Taking {
    std::vector<JobRequest> jobs;
    std::shared_ptr<Executive::Batch> batch = {};
  };
  const auto taking = std::make_shared<Taking>(Taking{std::move(jobs)});
  parts.loop.post_in_parts([&parts, taking, atomic, then](Executive& executive) {
    if (!taking->batch) taking->batch = executive.open_batch(std::move(taking->jobs), atomic);
    auto answers = taking->batch->go_on();
    if (!answers) return false;
    parts.post([then, answers = std::make_shared<const Executive::BatchAnswers>(
                          std::move(*answers))] { then(answers); });
    return true;
  });
}

Problem partly_known(std::ptrdiff_t place, const std::string& id) {
  return {ProblemKind::conflict, "partly-accepted", "/jobs/" + std::to_string(place),
          "this job was already accepted as \"" + id +
              "\", but other jobs of this batch were not accepted or are forgotten: submit the "
              "missing jobs alone",
          id};
}

void submit_batch(const ApiParts& parts, const std::shared_ptr<Batch>& batch,
                  const Respond& respond) {
  const KnownJobs& known = batch->known;
  const auto first = std::ranges::find_if(known, [](const auto& id) { return !id.empty(); });
  if (batch->request.atomic && first != known.end()) {
    if (std::ranges::find(known, "") == known.end())
      return answer_known_batch(parts, batch, respond);
    return respond(problem_response({partly_known(first - known.begin(), *first)}));
  }
  if (auto refused = refused_by_store(parts, *batch)) return respond(std::move(*refused));
  std::vector<JobRequest> jobs;
  for (std::size_t i = 0; i < batch->known.size(); ++i) {
    if (batch->is_new(i)) jobs.push_back(std::move(*batch->request.jobs[i].job));
  }
  take(parts, std::move(jobs), batch->request.atomic,
       [&parts, batch, respond](const std::shared_ptr<const Executive::BatchAnswers>& results) {
         if (!*results) return respond(problem_response(results->error()));
         tell(parts, batch, results, respond);
       });
}

void post_batch(Call call) {
  const ApiParts& parts = call.parts;
  const auto key = idempotency_key(parts, call.request);
  if (!key) return call.respond(problem_response(key.error()));
  const auto submit = [&parts, key = *key, respond = call.respond,
                       client = parts.guard.client(call.request)](Submission<BatchRequest> read) {
    if (is_limited(parts, client, read.request.jobs.size(), respond)) return;
    const auto sent = sent_of(key, read);
    const auto batch = std::make_shared<Batch>(Batch{std::move(read.request), sent, {}});
    recall(parts, sent, respond, [&parts, batch](const KnownJobs& known, const Respond& ending) {
      batch->known = known;
      submit_batch(parts, batch, ending);
    });
  };
  // Validates here, because the executive's strand has no time for it.
  const auto read = [cell = parts.cell](std::string_view text) {
    auto batch = read_batch_submission(text);
    if (!batch) return batch;
    for (BatchRequest::Entry& entry : batch->request.jobs) {
      if (!entry.job) continue;
      validate_ahead(*entry.job, *cell);
      entry.job->body = std::make_shared<const std::string>(entry.text);
    }
    return batch;
  };
  read_body(parts, call.request, call.respond, read, submit);
}

}  // namespace

Route batch_route() {
  return {
      .method = "POST",
      .path = api_path("/batches"),
      .id = "submitBatch",
      .tag = "jobs",
      .summary = "Submit several jobs at once",
      .text =
          "An atomic batch (the default) is accepted as a whole or not at all; problem pointers "
          "begin with /jobs/<index>. A job may name an earlier job of the batch in `after`. A "
          "repeated request has the same body, and the same `Idempotency-Key` or the same ids of "
          "all jobs. It returns the same jobs; refused jobs of a non-atomic batch are retried.",
      .parameters = {idempotency_parameter()},
      .reads = body(batch_request_format(), {{"both", example_batch()}}),
      .outcomes = {outcome(200, "All jobs were accepted before; returns their present state",
                           batch_accepted_format()),
                   outcome(202, "All jobs were accepted", batch_accepted_format()),
                   outcome(207, "With `\"atomic\": false`: one result per job",
                           batch_results_format())},
      .refuses = {409, 422, 507},
      .who = Who::commander,
      .role = Role::operate,
      .run = post_batch};
}

}  // namespace armloom
