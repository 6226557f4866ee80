#include <utility>

#include "core/executive/validated.h"
#include "server/access/digest.h"
#include "server/api/examples.h"
#include "server/api/resubmission.h"
#include "server/api/route.h"
#include "server/messages/job.h"
#include "server/messages/job_request.h"

namespace armloom {
namespace {

// Returns the answer if the store refuses the job, else nullopt.
std::optional<Response> refused_by_store(const ApiParts& parts, JobRequest& job) {
  if (parts.keeper == nullptr) return std::nullopt;
  if (const auto refusal = parts.keeper->refusal()) return refusal_response(*refusal);
  if (const auto known = parts.keeper->look_up(job); !known) return problem_response(known.error());
  return std::nullopt;
}

void answer_known_job(const ApiParts& parts, const SentRequestPtr& sent, const KnownJobs& known,
                      const Respond& respond) {
  look_at(parts, known, [&parts, sent, known, respond](const std::vector<Result<ListedJob>>& jobs) {
    if (!jobs.front()) return respond(problem_response(jobs.front().error()));
    note_answered(parts, *sent, known);
    respond(located(answer(200, listed_job_format(), *jobs.front(), &parts.clock),
                    "/jobs/" + known.front()));
  });
}

void submit_job(const ApiParts& parts, const SentRequestPtr& sent, JobRequest job,
                const std::shared_ptr<const std::string>& body, const Respond& respond) {
  if (auto refused = refused_by_store(parts, job)) return respond(std::move(*refused));
  ask(
      parts,
      [job = std::make_shared<JobRequest>(std::move(job))](Executive& executive) {
        return executive.submit(std::move(*job));
      },
      [&parts, respond, body, sent](const Result<JobView>& accepted) {
        if (!accepted) return respond(problem_response(accepted.error()));
        acknowledge(parts, {{*accepted, *body, origin_of(*sent, 0)}}, respond,
                    [&parts, sent, job = *accepted] {
                      note_accepted(parts, *sent, {job.key});
                      return located(answer(202, job_format(), job, &parts.clock),
                                     "/jobs/" + job.key);
                    });
      });
}

void post_job(Call call) {
  const ApiParts& parts = call.parts;
  const auto key = idempotency_key(parts, call.request);
  if (!key) return call.respond(problem_response(key.error()));
  const auto submit = [&parts, key = *key, respond = call.respond,
                       client = parts.guard.client(call.request)](Submission<JobRequest> read) {
    if (is_limited(parts, client, 1, respond)) return;
    const std::string digest = sha256_hex(read.canonical);
    const auto sent =
        std::make_shared<const SentRequest>(SentRequest{key, digest, {{read.request.key, digest}}});
    const auto job = std::make_shared<JobRequest>(std::move(read.request));
    recall(parts, sent, respond,
           [&parts, sent, job, body = job->body](const KnownJobs& known, const Respond& ending) {
             if (!known.front().empty()) return answer_known_job(parts, sent, known, ending);
             submit_job(parts, sent, std::move(*job), body, ending);
           });
  };
  const auto read = [cell = parts.cell](std::string_view text) {
    auto job = read_job_submission(text);
    if (job) validate_ahead(job->request, *cell);
    if (job) job->request.body = std::make_shared<const std::string>(job->canonical);
    return job;
  };
  read_body(parts, call.request, call.respond, read, submit);
}

void post_check(Call call) {
  const ApiParts& parts = call.parts;
  const auto check = [&parts, respond = call.respond](JobRequest read) {
    const auto job = std::make_shared<JobRequest>(std::move(read));
    parts.loop.post([&parts, job, respond](Executive& executive) {
      executive.inquiries().check(std::move(*job), [&parts, respond](Result<CheckView> result) {
        parts.post([respond, result = std::move(result)] {
          respond(result ? answer(200, verdict_format(), *result)
                         : problem_response(result.error()));
        });
      });
    });
  };
  const auto read = [cell = parts.cell](std::string_view text) {
    auto job = read_job_text(text);
    if (job) validate_ahead(*job, *cell);
    return job;
  };
  read_body(parts, call.request, call.respond, read, check);
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
       .text = "422 if the job can never run: unknown names, a malformed trajectory, exceeded "
               "joint limits, or a start at which its arm will not be. 409 if the id is in use "
               "with another body. With `--data`, the job is on disk before the answer and "
               "survives a restart; 507 if the disk is full. A repeated request (same `id` or "
               "`Idempotency-Key`, same body) returns the same job.",
       .parameters = {idempotency_parameter()},
       .reads = body(job_request_format(),
                     {{"reach", example_job(head, "left")}, {"moveit", example_moveit_job()}}),
       .outcomes = {created(200, "The job was accepted before; returns its present state",
                            job_format()),
                    created(202, "The job is accepted; it may wait in the backlog", job_format())},
       .refuses = {409, 422, 507},
       .who = Who::commander,
       .role = Role::operate,
       .run = post_job},
      batch_route(),
      {.method = "POST",
       .path = api_path("/check"),
       .id = "checkJob",
       .tag = "jobs",
       .summary = "Check a job without submitting it",
       .text = "Checks the job as if it started now, against all motions that are admitted and "
               "everything at rest. Changes nothing.",
       .reads = body(job_request_format(), {{"reach", example_job("", "left")}}),
       .outcomes = {outcome(200, "The verdict of the admission code", verdict_format())},
       .refuses = {409, 422},
       .who = Who::commander,
       .run = post_check},
  };
}

}  // namespace armloom
