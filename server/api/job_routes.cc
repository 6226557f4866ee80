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
#include "server/messages/plain_text.h"
#include "server/messages/timeline.h"

namespace armloom {
namespace {

// Returns the jobs that are in the store and not in `known`, newest first. Returns at most one more
// than a page, so that the caller sees whether there is a next page.
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
  call.respond(*stored ? job_answer(**stored) : no_such_job(parts, key));
}

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
        // Answers after the change is stored, because clients rely on the answer.
        const auto tell = when_stored(respond, answer(202, job_format(), **done, &parts.clock));
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
          query::required_text("with", &Query::with, "Id of the other job"),
          query::flag(
              "cells", &Query::cells,
              "0: omit the cells, for example to refresh only the progress and the first contact"),
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
    executive.inquiries().diagram(key, query.with,
                                  [&parts, query, respond](Result<DiagramView> result) {
                                    if (result && !query.cells) {
                                      for (DiagramView::Layer& layer : result->layers)
                                        layer.cells.clear();
                                    }
                                    parts.post([respond, result = std::move(result)] {
                                      respond(result ? answer(200, diagram_format(), *result)
                                                     : problem_response(result.error()));
                                    });
                                  });
  });
}

std::string queue_json(const Status& status, const WallClock& clock, JobTexts& texts) {
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
        return queue_json(status, clock, texts);
      },
      [respond = call.respond](std::string text) { respond(json_response(200, std::move(text))); });
}

void get_timeline(Call call) {
  const ApiParts& parts = call.parts;
  // Writes the text on the thread of the listings. The executive's strand only collects the few
  // admitted jobs.
  const auto write = [&parts, respond = call.respond](const TimelineView& timeline) {
    parts.listings.write(
        [cell = parts.cell, timeline](JobTexts&) {
          return text_of(*timeline_format(), lanes_of(timeline, *cell));
        },
        [respond](std::string text) { respond(json_response(200, std::move(text))); });
  };
  ask(
      parts, [](Executive& executive) { return executive.inquiries().timeline(); }, write);
}

Route of_one(const char* method, const char* path, const char* id, const char* summary) {
  return {.method = method, .path = api_path(path), .id = id, .tag = "jobs", .summary = summary};
}

Route replan_route() {
  Route replan = of_one("POST", "/jobs/{id}/replan", "replanJob", "Replan a job");
  replan.text =
      "Plans a new path from the arm's present position to the job's end, around everything at "
      "rest. For a trajectory, the end is its last waypoint; its other waypoints are lost. The "
      "speed is at most that of the original path. A moving arm first brakes on its path and waits "
      "there until the plan is ready (`waits_on` has the kind `plan`). The job then waits like a "
      "new job, under the same id. If there is no other path, the job keeps its own. Member "
      "`replan` reports the outcome. 409 if the job has ended, moves several arms, ends where it "
      "begins, or was created by the server.";
  replan.outcomes = {outcome(202, "Replanning has started", job_format())};
  replan.parameters = {if_match_parameter()};
  replan.refuses = {404, 409, 412, 507};
  replan.who = Who::commander;
  replan.role = Role::operate;
  replan.as_text = job_text;
  replan.run = replan_job;
  return replan;
}

Route diagram_route() {
  Route diagram =
      of_one("GET", "/jobs/{id}/diagram", "getDiagram", "Get the coordination diagram of two jobs");
  diagram.text =
      "Shows for each pair of positions on the two motions whether they conflict. A is the job in "
      "the path, B the job in `with`. The diagram consists of rectangles in the trajectory times "
      "of A and B, each certified free, in conflict, or undecided. They are refined down to 5 ms "
      "within 64,000 cells. Ended jobs are included while they are known. 422 if both are the same "
      "job, or move only the same arm.";
  diagram.parameters = diagram_query().parameters();
  diagram.outcomes = {outcome(200, "The diagram", diagram_format())};
  diagram.refuses = {404, 422};
  diagram.run = get_diagram;
  return diagram;
}

Route timeline_route() {
  Route timeline =
      of_one("GET", "/timeline", "getTimeline", "Get the predicted times of all admitted motions");
  timeline.text =
      "Lists the admitted motions of every arm with their predicted start and end, their pauses "
      "and the cause of each pause. The prediction assumes that all motions run at the speed of "
      "their trajectories, in the present passing order. If an arm is delayed for a reason of its "
      "own (late, stalled, stopped until resumed), the delay is assumed to last as long again as "
      "it has lasted so far. Later events or jobs may change passing orders, so the times are not "
      "guaranteed.";
  timeline.outcomes = {outcome(200, "The predicted motions of each arm", timeline_format())};
  timeline.run = get_timeline;
  return timeline;
}

}  // namespace

std::vector<Route> job_routes() {
  Route list = of_one("GET", "/jobs", "listJobs", "List jobs, newest first");
  list.parameters = job_query().parameters();
  list.outcomes = {outcome(200, "A page of jobs", job_page_format())};
  list.refuses = {422};
  list.as_text = job_page_text;
  list.run = list_jobs;

  Route get = of_one("GET", "/jobs/{id}", "getJob", "Get one job");
  get.outcomes = {outcome(200, "The job", job_format())};
  get.outcomes.front().has_tag = true;
  get.refuses = {404};
  get.as_text = job_text;
  get.run = get_job;

  Route cancel = of_one("DELETE", "/jobs/{id}", "cancelJob", "Cancel a job");
  cancel.text = "A moving arm brakes on its path; other arms continue. 409 if the job has ended.";
  cancel.outcomes = {outcome(
      202, "The job is canceled; `stopping` is true until its arm is at rest", job_format())};
  cancel.parameters = {if_match_parameter()};
  cancel.refuses = {404, 409, 412, 507};
  cancel.who = Who::commander;
  cancel.role = Role::operate;
  cancel.as_text = job_text;
  cancel.run = cancel_job;

  Route queue = of_one("GET", "/queue", "getQueue", "Get all waiting and running jobs");
  queue.outcomes = {
      outcome(200, "Jobs in the queue, in the backlog (with reasons), scheduled and running",
              queue_format())};
  queue.as_text = armloom::queue_text;
  queue.run = get_queue;

  return {
      list, get, amend_route(), cancel, replan_route(), diagram_route(), queue, timeline_route()};
}

}  // namespace armloom
