#include <utility>

#include "server/api/routes.h"
#include "server/codec/job_codec.h"
#include "server/codec/problem_codec.h"
#include "server/codec/views.h"

namespace armloom {
namespace {

void post_job(const ApiParts& parts, const Request& request, Respond respond) {
  auto job = read_body(request, read_job_text);
  if (!job) return respond(problem_response(job.error()));
  const auto body =
      std::make_shared<const std::string>(parts.recording != nullptr ? request.body : "");
  ask(
      parts,
      [job = std::make_shared<JobRequest>(std::move(*job))](Executive& executive) {
        return executive.submit(std::move(*job));
      },
      [&parts, respond, body](const Result<JobView>& accepted) {
        if (!accepted) return respond(problem_response(accepted.error()));
        if (parts.recording != nullptr) parts.recording->job(accepted->submitted_at, *body);
        JsonWriter out;
        write(out, *accepted, &parts.clock);
        Response response = json_response(202, out.take());
        response.headers.emplace_back("Location", "/api/v1/jobs/" + accepted->key);
        respond(std::move(response));
      });
}

// {"status": 202, "job": {...}} or {"status": 422, "problem": {...}}
void write_result(JsonWriter& out, const Result<JobView>& result, const WallClock& clock) {
  out.begin_object();
  if (result) {
    out.field("status", 202).key("job");
    write(out, *result, &clock);
  } else {
    out.field("status", status_of(result.error().front().kind));
    out.key("problem").raw(problem_json(result.error()));
  }
  out.end_object();
}

Response batch_response(const BatchRequest& batch, const std::vector<Result<JobView>>& results,
                        const WallClock& clock) {
  JsonWriter out;
  out.begin_object().key(batch.atomic ? "jobs" : "results").begin_array();
  for (const Result<JobView>& result : results) {
    if (batch.atomic) {
      write(out, result.value(), &clock);
    } else {
      write_result(out, result, clock);
    }
  }
  out.end_array().end_object();
  return json_response(batch.atomic ? 202 : 207, out.take());
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

void post_batch(const ApiParts& parts, const Request& request, Respond respond) {
  auto read = read_body(request, read_batch_text);
  if (!read) return respond(problem_response(read.error()));
  const auto batch = std::make_shared<const BatchRequest>(std::move(*read));
  ask(
      parts, [batch](Executive& executive) { return submit(executive, *batch); },
      [&parts, respond, batch](const Result<std::vector<Result<JobView>>>& results) {
        if (!results) return respond(problem_response(results.error()));
        for (std::size_t i = 0; parts.recording != nullptr && i < results->size(); ++i) {
          if (const auto& job = (*results)[i]) {
            parts.recording->job(job->submitted_at, batch->jobs[i].text);
          }
        }
        respond(batch_response(*batch, *results, parts.clock));
      });
}

void post_check(const ApiParts& parts, const Request& request, Respond respond) {
  auto read = read_body(request, read_job_text);
  if (!read) return respond(problem_response(read.error()));
  const auto job = std::make_shared<JobRequest>(std::move(*read));
  parts.loop.post([&parts, job, respond = std::move(respond)](Executive& executive) {
    executive.check(std::move(*job), [&parts, respond](Result<CheckView> result) {
      parts.post([respond, result = std::move(result)] {
        if (!result) return respond(problem_response(result.error()));
        JsonWriter out;
        write(out, *result);
        respond(json_response(200, out.take()));
      });
    });
  });
}

}  // namespace

void add_submission_routes(Router& router, const ApiParts& parts) {
  using Arguments = Router::Arguments;
  using Verb = void (*)(const ApiParts&, const Request&, Respond);
  const std::pair<const char*, Verb> verbs[] = {
      {"/jobs", post_job}, {"/batches", post_batch}, {"/check", post_check}};
  for (const auto& [path, verb] : verbs) {
    router.add("POST", kApi + std::string(path),
               [&parts, verb = verb](const Request& request, const Arguments&, Respond respond) {
                 verb(parts, request, std::move(respond));
               });
  }
}

}  // namespace armloom
