#include <utility>

#include "server/api/examples.h"
#include "server/api/route.h"
#include "server/messages/job.h"
#include "server/messages/job_request.h"

namespace armloom {
namespace {

// What the store has to say of it first. The answer, where it cannot be submitted.
std::optional<Response> refused_by_store(const ApiParts& parts, JobRequest& job) {
  if (parts.keeper == nullptr) return std::nullopt;
  if (const auto refusal = parts.keeper->refusal()) return refusal_response(*refusal);
  if (const auto known = parts.keeper->look_up(job); !known) return problem_response(known.error());
  return std::nullopt;
}

// Jobs that the executive has accepted, each with its body, are only said to be when they are on
// disk, where there is a store.
void acknowledge(const ApiParts& parts, std::vector<std::pair<JobView, std::string>> jobs,
                 const Respond& respond, std::function<Response()> answer) {
  if (parts.recording != nullptr) {
    for (const auto& [job, body] : jobs) parts.recording->job(job.submitted_at, body);
  }
  if (parts.keeper == nullptr || jobs.empty()) return respond(answer());
  parts.keeper->accept(std::move(jobs), [respond, answer = std::move(answer)](
                                            const std::optional<Refusal>& refusal) {
    respond(refusal ? refusal_response(*refusal) : answer());
  });
}

void post_job(Call call) {
  const ApiParts& parts = call.parts;
  const auto submit = [&parts, respond = call.respond, body = call.request.body](JobRequest job) {
    if (auto refused = refused_by_store(parts, job)) return respond(std::move(*refused));
    ask(
        parts,
        [job = std::make_shared<JobRequest>(std::move(job))](Executive& executive) {
          return executive.submit(std::move(*job));
        },
        [&parts, respond, body](const Result<JobView>& accepted) {
          if (!accepted) return respond(problem_response(accepted.error()));
          acknowledge(parts, {{*accepted, *body}}, respond, [&parts, job = *accepted] {
            return located(answer(202, job_format(), job, &parts.clock), "/jobs/" + job.key);
          });
        });
  };
  read_body(parts, call.request, call.respond, read_job_text, submit);
}

Response batch_response(const BatchRequest& batch, const std::vector<Result<JobView>>& results,
                        const WallClock& clock) {
  if (!batch.atomic) return answer(207, batch_results_format(), results, &clock);
  std::vector<JobView> jobs;
  for (const Result<JobView>& result : results) jobs.push_back(result.value());
  return answer(202, batch_accepted_format(), jobs, &clock);
}

// What could be read goes to the executive at once; then every job has its answer, in its place.
Result<std::vector<Result<JobView>>> submit(Executive& executive, const BatchRequest& batch) {
  std::vector<JobRequest> readable;
  for (const BatchRequest::Entry& entry : batch.jobs) {
    if (entry.job) readable.push_back(*entry.job);
  }
  auto submitted = executive.submit_batch(std::move(readable), batch.atomic);
  if (!submitted) return submitted;
  std::vector<Result<JobView>> results;
  auto next = submitted->begin();
  for (const BatchRequest::Entry& entry : batch.jobs) {
    if (entry.job) {
      results.push_back(std::move(*next++));
    } else {
      results.push_back(failure(entry.job.error()));
    }
  }
  return results;
}

std::optional<Response> refused_by_store(const ApiParts& parts, BatchRequest& batch) {
  Problems problems;
  if (parts.keeper == nullptr) return std::nullopt;
  if (const auto refusal = parts.keeper->refusal()) return refusal_response(*refusal);
  for (std::size_t i = 0; i < batch.jobs.size(); ++i) {
    Result<JobRequest>& job = batch.jobs[i].job;
    if (!job) continue;
    const auto known = parts.keeper->look_up(*job);
    if (known) continue;
    if (!batch.atomic) {
      job = failure(known.error());
      continue;
    }
    for (Problem problem : known.error()) {
      problem.pointer.insert(0, "/jobs/" + std::to_string(i));
      problems.push_back(std::move(problem));
    }
  }
  if (problems.empty()) return std::nullopt;
  return problem_response(problems);
}

void post_batch(Call call) {
  const ApiParts& parts = call.parts;
  const auto submit_all = [&parts, respond = call.respond](BatchRequest read) {
    if (auto refused = refused_by_store(parts, read)) return respond(std::move(*refused));
    const auto batch = std::make_shared<const BatchRequest>(std::move(read));
    ask(
        parts, [batch](Executive& executive) { return submit(executive, *batch); },
        [&parts, respond, batch](const Result<std::vector<Result<JobView>>>& results) {
          if (!results) return respond(problem_response(results.error()));
          std::vector<std::pair<JobView, std::string>> accepted;
          for (std::size_t i = 0; i < results->size(); ++i) {
            if (const auto& job = (*results)[i]) accepted.emplace_back(*job, batch->jobs[i].text);
          }
          acknowledge(parts, std::move(accepted), respond, [&parts, batch, results = *results] {
            return batch_response(*batch, results, parts.clock);
          });
        });
  };
  read_body(parts, call.request, call.respond, read_batch_text, submit_all);
}

void post_check(Call call) {
  const ApiParts& parts = call.parts;
  const auto check = [&parts, respond = call.respond](JobRequest read) {
    const auto job = std::make_shared<JobRequest>(std::move(read));
    parts.loop.post([&parts, job, respond](Executive& executive) {
      executive.check(std::move(*job), [&parts, respond](Result<CheckView> result) {
        parts.post([respond, result = std::move(result)] {
          respond(result ? answer(200, verdict_format(), *result)
                         : problem_response(result.error()));
        });
      });
    });
  };
  read_body(parts, call.request, call.respond, read_job_text, check);
}

}  // namespace

std::vector<Route> submission_routes() {
  const std::string head = R"("id": "reach", "name": "reach into the middle", "priority": 0, )"
                           R"("backlog_timeout_s": 60, )";
  return {
      {.method = "POST",
       .path = api_path("/jobs"),
       .id = "submitJob",
       .tag = "jobs",
       .summary = "Submit a job",
       .text =
           "Refused (422) when it can never run: limits, names, shape, or it does not begin "
           "where its arm will stand. An id in use: 409. With `--data` it is on disk when it is "
           "said to be accepted, and there again when the server is; a full disk: 507.",
       .reads = body(job_request_format(),
                     {{"reach", example_job(head, "left")}, {"moveit", example_moveit_job()}}),
       .outcomes = {created(202, "Accepted; it may still wait in the backlog", job_format())},
       .refuses = {409, 422, 507},
       .who = Who::commander,
       .run = post_job},
      {.method = "POST",
       .path = api_path("/batches"),
       .id = "submitBatch",
       .tag = "jobs",
       .summary = "Submit several jobs at once",
       .text = "Atomic (the default): all are accepted or none, and the problem's pointers begin "
               "with /jobs/<index>. A job may come `after` an earlier one of the batch.",
       .reads = body(batch_request_format(), {{"both", example_batch()}}),
       .outcomes = {outcome(202, "All were accepted", batch_accepted_format()),
                    outcome(207, "With \"atomic\": false, an answer for each",
                            batch_results_format())},
       .refuses = {409, 422, 507},
       .who = Who::commander,
       .run = post_batch},
      {.method = "POST",
       .path = api_path("/check"),
       .id = "checkJob",
       .tag = "jobs",
       .summary = "Judge a job without submitting it",
       .text = "As if it were to start now, beside everything that holds a reservation. Nothing "
               "changes.",
       .reads = body(job_request_format(), {{"reach", example_job("", "left")}}),
       .outcomes = {outcome(200, "What the admission code says", verdict_format())},
       .refuses = {409, 422},
       .who = Who::commander,
       .run = post_check},
  };
}

}  // namespace armloom
