#include <algorithm>
#include <utility>

#include "server/api/job_filter.h"
#include "server/api/routes.h"
#include "server/codec/views.h"

namespace armloom {
namespace {

Response job_response(int status, const JobView& job, const WallClock& clock) {
  JsonWriter out;
  write(out, job, &clock);
  return json_response(status, out.take());
}

void list_jobs(const ApiParts& parts, const Request& request, Respond respond) {
  const auto filter = read_job_filter(request.target, *parts.cell);
  if (!filter) return respond(problem_response(filter.error()));
  ask(
      parts, [](Executive& executive) { return executive.snapshot(); },
      [&parts, respond, filter = *filter](Snapshot& snapshot) {
        const JobPage page = select(std::move(snapshot.jobs), filter);
        JsonWriter out;
        out.begin_object().key("jobs").begin_array();
        for (const JobView& job : page.jobs) write(out, job, &parts.clock);
        out.end_array().field("next_cursor", page.next_cursor).end_object();
        respond(json_response(200, out.take()));
      });
}

void get_job(const ApiParts& parts, const std::string& key, Respond respond) {
  ask(
      parts, [key](Executive& executive) { return executive.job(key); },
      [&parts, respond, key](const std::optional<JobView>& job) {
        respond(job ? job_response(200, *job, parts.clock) : no_such("job", key));
      });
}

void cancel_job(const ApiParts& parts, const std::string& key, Respond respond) {
  ask(
      parts, [key](Executive& executive) { return executive.cancel(key); },
      [&parts, respond](const Result<JobView>& job) {
        respond(job ? job_response(202, *job, parts.clock) : problem_response(job.error()));
      });
}

// The other job's id.
Result<std::string> read_with(const Target& target) {
  const auto with = target.parameter("with");
  if (with && !with->empty()) return *with;
  return failure(Problem{ProblemKind::malformed, "missing-parameter", "?with",
                         "name the other job: ?with=<id>"});
}

void get_diagram(const ApiParts& parts, const Request& request, const std::string& key,
                 Respond respond) {
  const auto with = read_with(request.target);
  if (!with) return respond(problem_response(with.error()));
  parts.loop.post([&parts, key, with = *with, respond = std::move(respond)](Executive& executive) {
    executive.diagram(key, with, [&parts, respond](Result<DiagramView> result) {
      parts.post([respond, result = std::move(result)] {
        if (!result) return respond(problem_response(result.error()));
        JsonWriter out;
        write(out, *result);
        respond(json_response(200, out.take()));
      });
    });
  });
}

void write_jobs(JsonWriter& out, const std::vector<JobView>& jobs,
                const std::vector<std::string>& keys, const WallClock& clock) {
  out.begin_array();
  for (const std::string& key : keys) {
    const auto job = std::ranges::find(jobs, key, &JobView::key);
    if (job != jobs.end()) write(out, *job, &clock);
  }
  out.end_array();
}

void get_queue(const ApiParts& parts, Respond respond) {
  ask(
      parts, [](Executive& executive) { return executive.snapshot(0); },
      [&parts, respond](const Snapshot& snapshot) {
        const QueueView& queue = snapshot.queue;
        JsonWriter out;
        out.begin_object().field("policy", queue.policy).field("stopped", queue.stopped);
        const std::pair<const char*, const std::vector<std::string>*> lists[] = {
            {"queued", &queue.queued},
            {"backlog", &queue.backlog},
            {"scheduled", &queue.scheduled},
            {"running", &queue.running}};
        for (const auto& [name, keys] : lists) {
          out.key(name);
          write_jobs(out, snapshot.jobs, *keys, parts.clock);
        }
        out.end_object();
        respond(json_response(200, out.take()));
      });
}

}  // namespace

void add_job_routes(Router& router, const ApiParts& parts) {
  using Arguments = Router::Arguments;
  const std::string jobs = kApi + std::string("/jobs");
  router.add("GET", jobs,
             [&parts](const Request& request, const Arguments&, Respond respond) {
               list_jobs(parts, request, std::move(respond));
             },
             {"state", "arm", "limit", "cursor"});
  router.add("GET", jobs + "/{}", [&parts](const Request&, const Arguments& a, Respond respond) {
    get_job(parts, a.front(), std::move(respond));
  });
  router.add("GET", jobs + "/{}/diagram",
             [&parts](const Request& request, const Arguments& a, Respond respond) {
               get_diagram(parts, request, a.front(), std::move(respond));
             },
             {"with"});
  router.add("DELETE", jobs + "/{}", [&parts](const Request&, const Arguments& a, Respond respond) {
    cancel_job(parts, a.front(), std::move(respond));
  });
  router.add("GET", kApi + std::string("/queue"),
             [&parts](const Request&, const Arguments&, Respond respond) {
               get_queue(parts, std::move(respond));
             });
}

}  // namespace armloom
