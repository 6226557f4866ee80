#include <utility>

#include "server/api/job_answers.h"
#include "server/api/route.h"
#include "server/messages/job_amendment.h"
#include "server/messages/plain_text.h"

namespace armloom {
namespace {

void answer_amended(const ApiParts& parts, const JobView& job, const Respond& respond) {
  if (parts.keeper == nullptr) return respond(job_answer(200, job, parts.clock));
  parts.keeper->amend(job, [&parts, job, respond](const std::optional<Refusal>& refusal) {
    respond(refusal ? refusal_response(*refusal) : job_answer(200, job, parts.clock));
  });
}

// Says if a new priority changes nothing at present, because a job that this one waits for has
// started.
std::optional<std::string> notice_of(const Executive& executive, const JobView& job,
                                     const JobAmendment& amendment) {
  if (!amendment.terms.priority) return std::nullopt;
  for (const WaitView& wait : job.waits_on) {
    if (wait.kind != Wait::Kind::job) continue;
    const auto blocker = executive.job(wait.job);
    if (!blocker || !blocker->times.started_at || is_terminal(blocker->state)) continue;
    return "job " + job.key + " waits for job " + blocker->key +
           ", which has started: the priority changes nothing until " + blocker->key +
           " has passed or ended";
  }
  return std::nullopt;
}

void amend_job(Call call) {
  const ApiParts& parts = call.parts;
  if (const auto bad = bad_if_match(call.request)) return call.respond(*bad);
  if (const auto refusal = refusal_of_store(parts)) {
    return call.respond(refusal_response(*refusal));
  }
  const auto amend = [&parts, key = call.arguments.front(), if_match = call.request.if_match,
                      respond = call.respond](JobAmendment amendment) {
    ask(
        parts,
        [key, if_match, amendment = std::move(amendment)](Executive& executive) {
          return commanded(executive, key, if_match, [&](Executive& it, const std::string& job) {
            auto amended = it.amend(job, amendment);
            if (amended) amended->notice = notice_of(it, *amended, amendment);
            return amended;
          });
        },
        [&parts, key, if_match, respond](const Commanded& job) {
          if (!job) return respond(refused_command(parts, key, job.error()));
          if (!*job) return respond(was_changed_since(key, if_match));
          answer_amended(parts, **job, respond);
        });
  };
  read_body(parts, call.request, call.respond, read_job_amendment, amend);
}

}  // namespace

Route amend_route() {
  Route route{.method = "PATCH",
              .path = api_path("/jobs/{id}"),
              .id = "amendJob",
              .tag = "jobs",
              .summary = "Change a job"};
  route.text =
      "Changes priority, backlog timeout, timeout action and name until the job has ended. Absent "
      "members keep their values. The change applies at once: a new priority makes the scheduler "
      "check all waiting jobs again in the new order. With `--data`, the change is on disk before "
      "the answer. `If-Match` fails only if another client changed one of these members; progress "
      "and waits do not matter. 409 if the job has ended.";
  route.parameters = {if_match_parameter()};
  route.reads =
      body(job_amendment_format(), {{"sooner", R"({"priority": 5})"},
                                    {"later", R"({"priority": -1, "backlog_timeout_s": 600})"}});
  route.outcomes = {outcome(200, "The changed job", job_format())};
  route.outcomes.front().has_tag = true;
  route.refuses = {404, 409, 412, 422, 507};
  route.who = Who::commander;
  route.role = Role::operate;
  route.as_text = job_text;
  route.run = amend_job;
  return route;
}

}  // namespace armloom
