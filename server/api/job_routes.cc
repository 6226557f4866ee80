#include <memory>
#include <utility>

#include "core/executive/queue_lists.h"
#include "core/executive/status_board.h"
#include "core/executive/timeline.h"
#include "server/api/job_answers.h"
#include "server/api/job_filter.h"
#include "server/api/listings.h"
#include "server/api/query_format.h"
#include "server/api/route.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"
#include "server/messages/job.h"
#include "server/messages/timeline.h"

namespace armloom {
namespace {

// Returns the jobs that only the store has, one more than a page holds.
Result<std::vector<StoredJob>> stored_jobs(const JobHistory& history, const JobFilter& filter,
                                           const JobSheet& known) {
  std::vector<StoredJob> jobs;
  const HistoryFilter wanted{.state = filter.state ? to_string(*filter.state) : "",
                             .arm = filter.arm,
                             .before = filter.before};
  const auto read = history.newest_first(wanted, [&](StoredJob job) {
    if (known.find(JobId{job.number}) == nullptr) jobs.push_back(std::move(job));
    return jobs.size() <= filter.limit;
  });
  if (!read) return failure(read.error());
  return jobs;
}

void list_jobs(Call call) {
  const ApiParts& parts = call.parts;
  const auto filter = read_job_filter(call.request.target, *parts.cell);
  if (!filter) return call.respond(problem_response(filter.error()));
  const auto status = std::make_shared<const Status>(parts.loop.board().read());
  const auto tell = [&parts, status, respond = call.respond,
                     filter = *filter](Result<std::vector<StoredJob>> stored) {
    if (!stored) return respond(problem_response(stored.error()));
    const auto write = [status, filter, clock = parts.clock,
                        stored = std::move(*stored)](JobTexts& texts) {
      return text_of(*job_page_format(), select(*status, stored, filter, clock, texts), &clock);
    };
    parts.listings.write(
        write, [respond](std::string text) { respond(json_response(200, std::move(text))); });
  };
  if (parts.keeper == nullptr) return tell({});
  parts.aside([&parts, tell, status, filter = *filter] {
    const auto stored = std::make_shared<Result<std::vector<StoredJob>>>(
        stored_jobs(parts.keeper->lists(), filter, status->jobs));
    parts.post([tell, stored] { tell(std::move(*stored)); });
  });
}

void get_job(Call call) {
  const ApiParts& parts = call.parts;
  const std::string& key = call.arguments.front();
  if (const auto job = parts.loop.board().job(key)) {
    return call.respond(job_answer(200, *job, parts.clock));
  }
  const auto stored = stored_job(parts, key);
  if (!stored) return call.respond(problem_response(stored.error()));
  call.respond(*stored ? job_answer(**stored) : no_such("job", key));
}

// What becomes of a command to one job that has not ended: `command(executive, key)`.
template <class Command>
void command_job(Call call, Command command) {
  if (const auto bad = bad_if_match(call.request)) return call.respond(*bad);
  const ApiParts& parts = call.parts;
  const std::string& key = call.arguments.front();
  ask(
      parts,
      [key, if_match = call.request.if_match, command](Executive& executive) {
        return commanded(executive, key, if_match, command);
      },
      [&parts, respond = call.respond, key,
       if_match = call.request.if_match](const Commanded& done) {
        if (!done) return respond(refused_command(parts, key, done.error()));
        if (!*done) return respond(was_changed_since(key, if_match));
        // Who commands may rely on it, whatever happens to the server.
        const auto tell = [&parts, respond, job = **done](std::optional<Refusal> refusal) {
          if (!refusal) return respond(answer(202, job_format(), job, &parts.clock));
          respond(done_but_not_stored(*std::move(refusal)));
        };
        parts.keeper != nullptr ? parts.keeper->when_written(tell) : tell(std::nullopt);
      });
}

void cancel_job(Call call) {
  command_job(std::move(call),
              [](Executive& it, const std::string& key) { return it.cancel(key); });
}
void replan_job(Call call) {
  command_job(std::move(call),
              [](Executive& it, const std::string& key) { return it.replan(key); });
}

struct DiagramQuery {
  std::string with;  // the other job's id
  bool cells = true;
};
const QueryFormat<DiagramQuery>& diagram_query() {
  using Query = DiagramQuery;
  static const QueryFormat<Query> format(
      {
          query::required_text("with", &Query::with, "The other job"),
          query::flag("cells", &Query::cells,
                      "0: without them, for who has them and asks what lies ahead by now"),
      },
      ProblemKind::malformed);
  return format;
}

void get_diagram(Call call) {
  const auto query = diagram_query().read(call.request.target);
  if (!query) return call.respond(problem_response(query.error()));
  const ApiParts& parts = call.parts;
  parts.loop.post([&parts, key = call.arguments.front(), query = *query,
                   respond = std::move(call.respond)](Executive& executive) {
    executive.diagram(key, query.with, [&parts, query, respond](Result<DiagramView> result) {
      if (result && !query.cells) {
        for (DiagramView::Layer& layer : result->layers) layer.cells.clear();
      }
      parts.post([respond, result = std::move(result)] {
        respond(result ? answer(200, diagram_format(), *result) : problem_response(result.error()));
      });
    });
  });
}

std::string queue_text(const Status& status, const WallClock& clock, JobTexts& texts) {
  QueueJobs queue{status.policy, status.stopped, {}, {}, {}, {}};
  const auto list_of = [&](JobState state) -> std::vector<ListedJob>* {
    const auto list = queue_list_of(state);
    if (list == &QueueView::queued) return &queue.queued;
    if (list == &QueueView::backlog) return &queue.backlog;
    if (list == &QueueView::scheduled) return &queue.scheduled;
    return list == nullptr ? nullptr : &queue.running;
  };
  status.jobs.each([&](const JobSheet::JobPtr& job) {
    if (auto* list = list_of(job->state)) {
      list->push_back(texts.of(status.with_progress(job), clock));
    }
  });
  return text_of(*queue_format(), queue, &clock);
}

void get_queue(Call call) {
  const ApiParts& parts = call.parts;
  parts.listings.write(
      [status = parts.loop.board().read(), clock = parts.clock](JobTexts& texts) {
        return queue_text(status, clock, texts);
      },
      [respond = call.respond](std::string text) { respond(json_response(200, std::move(text))); });
}

void get_timeline(Call call) {
  const ApiParts& parts = call.parts;
  // Of the strand only what is admitted is asked, which are few jobs.
  const auto write = [&parts, respond = call.respond](const TimelineView& timeline) {
    parts.listings.write(
        [cell = parts.cell, timeline](JobTexts&) {
          return text_of(*timeline_format(), lanes_of(timeline, *cell));
        },
        [respond](std::string text) { respond(json_response(200, std::move(text))); });
  };
  ask(
      parts, [](Executive& executive) { return executive.timeline(); }, write);
}

Route of_one(const char* method, const char* path, const char* id, const char* summary) {
  return {.method = method, .path = api_path(path), .id = id, .tag = "jobs", .summary = summary};
}

Route replan_route() {
  Route replan = of_one("POST", "/jobs/{id}/replan", "replanJob", "Another way for a job");
  replan.text =
      "From where its arm stands to where the job ends (of a trajectory: its last waypoint; what "
      "it "
      "was to do on the way is lost), past what rests there, as fast as its own way was at its "
      "fastest. A job in motion brakes on its path first; until the answer is there it stays where "
      "it is (`waits_on` has the kind `plan`). Then it waits under its id like one that has just "
      "come, or keeps its own way where there is no other: its member `replan` says which. 409 "
      "when it has ended, moves several arms, ends where it begins, or is the server's own.";
  replan.outcomes = {outcome(202, "Another way is being looked for", job_format())};
  replan.parameters = {if_match_parameter()};
  replan.refuses = {404, 409, 412, 507};
  replan.who = Who::commander;
  replan.role = Role::operate;
  replan.run = replan_job;
  return replan;
}

Route diagram_route() {
  Route diagram =
      of_one("GET", "/jobs/{id}/diagram", "getDiagram", "The coordination diagram of two jobs");
  diagram.text =
      "What the motions of two jobs do to each other, wherever each is on its own way: rectangles "
      "of trajectory time of A (the job of the path) and B (`with`) that are certified free, in "
      "conflict, or undecided, down to 5 ms where that takes no more than 64,000 cells. Jobs that "
      "have ended are drawn while they are known. 422 when both are the same job, or move only the "
      "same arm.";
  diagram.parameters = diagram_query().parameters();
  diagram.outcomes = {outcome(200, "The diagram", diagram_format())};
  diagram.refuses = {404, 422};
  diagram.run = get_diagram;
  return diagram;
}

Route timeline_route() {
  Route timeline = of_one("GET", "/timeline", "getTimeline", "When each arm is expected to move");
  timeline.text =
      "Of every arm the legs that are admitted, with the times that follow from who passes first, "
      "if everything goes as fast as its trajectory says; their pauses, and for whom. What stands "
      "for a reason of its own (late, stalled, stopped until it is resumed) is expected to do so "
      "for as long again as it has. Orders may be chosen anew when something comes otherwise, or "
      "something else comes: a prediction, no promise.";
  timeline.outcomes = {outcome(200, "Lane by lane, as things are", timeline_format())};
  timeline.run = get_timeline;
  return timeline;
}

}  // namespace

std::vector<Route> job_routes() {
  Route list = of_one("GET", "/jobs", "listJobs", "List jobs, newest first");
  list.parameters = job_query().parameters();
  list.outcomes = {outcome(200, "A page of jobs", job_page_format())};
  list.refuses = {422};
  list.run = list_jobs;

  Route get = of_one("GET", "/jobs/{id}", "getJob", "One job");
  get.outcomes = {outcome(200, "The job", job_format())};
  get.outcomes.front().has_tag = true;
  get.refuses = {404};
  get.run = get_job;

  Route cancel = of_one("DELETE", "/jobs/{id}", "cancelJob", "Cancel a job");
  cancel.text =
      "An arm in motion brakes on its path; the others go on. 409 when the job has ended.";
  cancel.outcomes = {
      outcome(202, "Canceled, or \"stopping\" until its arm is at rest", job_format())};
  cancel.parameters = {if_match_parameter()};
  cancel.refuses = {404, 409, 412, 507};
  cancel.who = Who::commander;
  cancel.role = Role::operate;
  cancel.run = cancel_job;

  Route queue = of_one("GET", "/queue", "getQueue", "What waits, and why, and what runs");
  queue.outcomes = {
      outcome(200, "Queue, backlog with reasons, scheduled, running", queue_format())};
  queue.run = get_queue;

  return {
      list, get, amend_route(), cancel, replan_route(), diagram_route(), queue, timeline_route()};
}

}  // namespace armloom
