#include "server/api/api.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "server/api/job_filter.h"
#include "server/codec/cell_codec.h"
#include "server/codec/job_codec.h"
#include "server/codec/mesh_address.h"
#include "server/codec/views.h"

namespace armloom {
namespace {

constexpr std::size_t kSnapshotEnded = 200;  // ended jobs that a new subscriber is told

bool is_json(const std::optional<std::string>& content_type) {
  if (!content_type) return false;
  std::string media = content_type->substr(0, content_type->find(';'));
  media.erase(std::remove(media.begin(), media.end(), ' '), media.end());
  std::transform(media.begin(), media.end(), media.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return media == "application/json";
}

Problem no_such(const char* what, const std::string& name) {
  return Problem{ProblemKind::not_found, std::string("no-such-") + what, "request target",
                 std::string("there is no ") + what + " \"" + name + "\"", name};
}

// All jobs that have not ended, and the latest of those that have.
void shorten(std::vector<JobView>& jobs) {
  std::size_t ended = 0;
  for (const JobView& job : jobs) ended += is_terminal(job.state) ? 1U : 0U;
  std::erase_if(
      jobs, [&](const JobView& job) { return is_terminal(job.state) && ended-- > kSnapshotEnded; });
}

void write_jobs(JsonWriter& out, const std::vector<JobView>& jobs,
                const std::vector<std::string>& keys, const WallClock& clock) {
  out.begin_array();
  for (const std::string& key : keys) {
    const auto job = std::find_if(jobs.begin(), jobs.end(),
                                  [&](const JobView& candidate) { return candidate.key == key; });
    if (job != jobs.end()) write(out, *job, &clock);
  }
  out.end_array();
}

}  // namespace

Api::Api(Parts parts)
    : parts_(std::move(parts)),
      meshes_(*parts_.cell),
      cell_text_(cell_json(*parts_.cell, parts_.policy, parts_.loop.speed())) {}

template <class Ask, class Then>
void Api::ask(Ask ask, Then then) {
  parts_.loop.post([this, ask = std::move(ask), then = std::move(then)](Executive& executive) {
    using Answer = decltype(ask(executive));
    parts_.post([answer = std::make_shared<Answer>(ask(executive)), then] { then(*answer); });
  });
}

std::string Api::job_text(const JobView& job) const {
  JsonWriter out;
  write(out, job, &parts_.clock);
  return out.take();
}

void Api::add_routes(Router& router) {
  const std::string v1 = "/api/v1";
  router.add("POST", v1 + "/jobs",
             [this](const Request& r, const Arguments&, Respond respond) { post_job(r, respond); });
  router.add("GET", v1 + "/jobs", [this](const Request& r, const Arguments&, Respond respond) {
    list_jobs(r, respond);
  });
  router.add("GET", v1 + "/jobs/{}", [this](const Request&, const Arguments& a, Respond respond) {
    get_job(a.front(), respond);
  });
  router.add("DELETE", v1 + "/jobs/{}",
             [this](const Request&, const Arguments& a, Respond respond) {
               cancel_job(a.front(), respond);
             });
  router.add("GET", v1 + "/queue",
             [this](const Request&, const Arguments&, Respond respond) { get_queue(respond); });
  router.add("GET", v1 + "/arms",
             [this](const Request&, const Arguments&, Respond respond) { list_arms(respond); });
  router.add("GET", v1 + "/arms/{}", [this](const Request&, const Arguments& a, Respond respond) {
    get_arm(a.front(), respond);
  });
  router.add("GET", v1 + "/cell", [this](const Request&, const Arguments&, Respond respond) {
    respond(json_response(200, cell_text_));
  });
  router.add("GET", kMeshFolder + std::string("{}"),
             [this](const Request&, const Arguments& a, Respond respond) { respond(meshes_.answer(a.front())); });
  router.add("GET", v1 + "/scene", [this](const Request&, const Arguments&, Respond respond) {
    JsonWriter out;
    out.begin_object().key("objects");
    write_objects(out, parts_.cell->objects);
    out.end_object();
    respond(json_response(200, out.take()));
  });
  router.add("POST", v1 + "/stop",
             [this](const Request&, const Arguments&, Respond respond) { stop(respond); });
  router.add("POST", v1 + "/resume",
             [this](const Request&, const Arguments&, Respond respond) { resume(respond); });
  router.add("GET", "/healthz", [](const Request&, const Arguments&, Respond respond) {
    respond(json_response(200, R"({"status":"ok"})"));
  });
  router.add("GET", "/readyz",
             [this](const Request&, const Arguments&, Respond respond) { ready(respond); });
}

void Api::post_job(const Request& request, Respond respond) {
  if (!is_json(request.content_type)) {
    const std::string found = request.content_type.value_or("none");
    return respond(problem_response(
        {Problem{ProblemKind::unsupported, "unsupported-media-type", "Content-Type",
                 "the body must be application/json, found " + found, found}}));
  }
  auto job = read_job_text(request.body);
  if (!job) return respond(problem_response(job.error()));
  const auto body =
      std::make_shared<const std::string>(parts_.recording != nullptr ? request.body : "");
  ask([job = std::make_shared<JobRequest>(std::move(*job))](
          Executive& executive) { return executive.submit(std::move(*job)); },
      [this, respond, body](const Result<JobView>& accepted) {
        if (!accepted) return respond(problem_response(accepted.error()));
        if (parts_.recording != nullptr) parts_.recording->job(accepted->submitted_at, *body);
        Response response = json_response(202, job_text(*accepted));
        response.headers.emplace_back("Location", "/api/v1/jobs/" + accepted->key);
        respond(std::move(response));
      });
}

void Api::list_jobs(const Request& request, Respond respond) {
  const auto filter = read_job_filter(request.target, *parts_.cell);
  if (!filter) return respond(problem_response(filter.error()));
  ask([](Executive& executive) { return executive.snapshot(); },
      [this, respond, filter = *filter](Snapshot& snapshot) {
        const JobPage page = select(std::move(snapshot.jobs), filter);
        JsonWriter out;
        out.begin_object().key("jobs").begin_array();
        for (const JobView& job : page.jobs) write(out, job, &parts_.clock);
        out.end_array().field("next_cursor", page.next_cursor).end_object();
        respond(json_response(200, out.take()));
      });
}

void Api::get_job(const std::string& key, Respond respond) {
  ask([key](Executive& executive) { return executive.job(key); },
      [this, respond, key](const std::optional<JobView>& job) {
        respond(job ? json_response(200, job_text(*job)) : problem_response({no_such("job", key)}));
      });
}

void Api::cancel_job(const std::string& key, Respond respond) {
  ask([key](Executive& executive) { return executive.cancel(key); },
      [this, respond](const Result<JobView>& job) {
        respond(job ? json_response(202, job_text(*job)) : problem_response(job.error()));
      });
}

void Api::get_queue(Respond respond) {
  ask([](Executive& executive) { return executive.snapshot(); },
      [this, respond](const Snapshot& snapshot) {
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
          write_jobs(out, snapshot.jobs, *keys, parts_.clock);
        }
        out.end_object();
        respond(json_response(200, out.take()));
      });
}

void Api::list_arms(Respond respond) {
  ask([](Executive& executive) { return executive.snapshot().arms; },
      [respond](const std::vector<ArmView>& arms) {
        JsonWriter out;
        out.begin_object().key("arms").begin_array();
        for (const ArmView& arm : arms) write(out, arm);
        out.end_array().end_object();
        respond(json_response(200, out.take()));
      });
}

void Api::get_arm(const std::string& name, Respond respond) {
  ask([](Executive& executive) { return executive.snapshot().arms; },
      [respond, name](const std::vector<ArmView>& arms) {
        const auto arm = std::find_if(arms.begin(), arms.end(), [&](const ArmView& candidate) {
          return candidate.name == name;
        });
        if (arm == arms.end()) return respond(problem_response({no_such("arm", name)}));
        JsonWriter out;
        write(out, *arm);
        respond(json_response(200, out.take()));
      });
}

void Api::stop(Respond respond) {
  ask([](Executive& executive) { return executive.stop_all("operator"), true; },
      [respond](bool) { respond(json_response(202, R"({"stopped":true})")); });
}

void Api::resume(Respond respond) {
  ask([](Executive& executive) { return executive.resume_all(), true; },
      [respond](bool) { respond(json_response(202, R"({"stopped":false})")); });
}

void Api::ready(Respond respond) {
  ask([](Executive& executive) { return executive.now(); },
      [respond](TimePoint now) {
        JsonWriter out;
        out.begin_object().field("ready", true).field("t_s", now).end_object();
        respond(json_response(200, out.take()));
      });
}

void Api::subscribe(const Target& target, std::function<void(FeedPtr)> then) {
  bool gap = false;
  if (const auto since = target.parameter("since")) {
    std::uint64_t seq = 0;
    const char* end = since->data() + since->size();
    const auto [stop, ec] = std::from_chars(since->data(), end, seq);
    const bool read = ec == std::errc{} && stop == end;
    if (read && target.parameter("stream") == parts_.stream) {
      if (FeedPtr feed = parts_.hub.resume(seq)) return then(std::move(feed));
    }
    gap = true;
  }
  // Every event up to the snapshot's seq was posted to this thread before the snapshot, and every
  // later one comes after it: what follows seq in the hub is exactly what the snapshot lacks.
  ask([](Executive& executive) { return executive.snapshot(); },
      [this, gap, then](Snapshot& snapshot) {
        shorten(snapshot.jobs);
        const auto text = std::make_shared<const std::string>(snapshot_json(
            snapshot, *parts_.cell, parts_.stream, parts_.loop.speed(), parts_.clock, gap));
        if (FeedPtr feed = parts_.hub.resume(snapshot.seq, text)) then(std::move(feed));
      });
}

}  // namespace armloom
