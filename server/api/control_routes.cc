#include <chrono>
#include <memory>
#include <utility>

#include "server/api/route.h"
#include "server/codec/rfc3339.h"
#include "server/control/control.h"
#include "server/messages/control.h"
#include "server/messages/job_request.h"

namespace armloom {
namespace {

ControlView view_of(const Control& control) {
  ControlView view;
  if (!control.holder()) return view;
  const Control::Holder& holder = *control.holder();
  ControlView::Holder told{holder.who, rfc3339(since_1970_ms(holder.since)), {}, {}};
  if (holder.move) {
    told.arm = holder.move->arm;
    told.job = holder.move->job;
  }
  view.holder = std::move(told);
  return view;
}

void tell_all(const ApiParts& parts, const std::string& what) {
  parts.loop.post([what](Executive& executive) { executive.alert({Alert::Level::info, what}); });
}

// Cancels the jog of a client that has lost or given back control.
void let_go(const ApiParts& parts, const std::optional<Control::Move>& move) {
  if (!move) return;
  parts.loop.post_urgent([job = move->job](Executive& executive) {
    static_cast<void>(executive.cancel(job));  // the job may have ended
  });
}

// Returns the control. If the token of the client that has control was revoked, control ends first.
// Call it once per request and keep the result, because a token can be revoked at any time.
Control& control_of(const ApiParts& parts) {
  const auto& holder = parts.control.holder();
  if (holder && holder->token && !parts.guard.caller(holder->token)) {
    tell_all(parts, "no client has control: the token of " + holder->who + " was revoked");
    let_go(parts, parts.control.end());
  }
  return parts.control;
}

void get_control(Call call) {
  call.respond(answer(200, control_format(), view_of(control_of(call.parts))));
}

void post_control(Call call) {
  const ApiParts& parts = call.parts;
  const auto caller = parts.guard.asks() ? parts.guard.caller(call.request.token) : std::nullopt;
  const auto take = [&parts, respond = call.respond, peer = call.request.peer,
                     proven = caller ? caller->name : std::string(),
                     token =
                         caller ? call.request.token : std::nullopt](const ControlRequest& asked) {
    const std::string said = asked.who.value_or("").empty() ? peer : *asked.who;
    const std::string who = proven.empty() ? said : proven;
    Control& control = control_of(parts);
    auto taken = control.take(who, asked.take, token);
    if (!taken) return respond(problem_response(taken.error()));
    let_go(parts, taken->interrupted);
    tell_all(parts, who + " has control");
    ControlView view = view_of(control);
    view.key = taken->key;
    respond(answer(200, control_taken_format(), view));
  };
  read_body(parts, call.request, call.respond, read_control_request, take);
}

void release_control(Call call) {
  const ApiParts& parts = call.parts;
  const auto give_back = [&parts, respond = call.respond](const ControlKey& shown) {
    Control& control = control_of(parts);
    const auto move = control.give_back(shown.control);
    if (!move) return respond(problem_response(move.error()));
    let_go(parts, *move);
    tell_all(parts, "no client has control");
    respond(answer(200, control_format(), view_of(control)));
  };
  read_body(parts, call.request, call.respond, read_control_key, give_back);
}

// Returns the cell time at which the job is canceled unless the lease is renewed.
TimePoint lease_from(const Executive& executive, double lease_s, double speed) {
  return executive.now() + from_seconds(lease_s * speed);
}

Control::Time now() { return std::chrono::steady_clock::now(); }

double lease_s(const ApiParts& parts) {
  return std::chrono::duration<double>(parts.jog_lease).count();
}

Response jog_response(int status, const Result<JobView>& job, const ApiParts& parts) {
  if (!job) return problem_response(job.error());
  Response response = answer(status, jog_format(), JogView{*job, lease_s(parts)}, &parts.clock);
  response.is_routine = status == 200;
  return response;
}

// Returns the job to submit for a jog request.
Result<JobRequest> job_of(const JogRequest& jog, const std::string& arm) {
  auto read = read_job_submission(job_text_of(jog, arm));
  if (!read) return failure(std::move(read.error()));
  read->request.body = std::make_shared<const std::string>(std::move(read->canonical));
  return std::move(read->request);
}

Problems in_words_of_jog(Problems problems) {
  static const std::string kGoal = "/move_to";
  for (Problem& problem : problems) {
    if (problem.pointer.starts_with(kGoal)) {
      problem.pointer = "/to" + problem.pointer.substr(kGoal.size());
    }
  }
  return problems;
}

// Submits the job of a jog and starts its lease in one task, so that the arm never moves without a
// lease. Jogs are not stored.
void begin_jog(Call call) {
  const ApiParts& parts = call.parts;
  const std::string arm = call.arguments.front();
  const auto begin = [&parts, arm, respond = call.respond](const JogRequest& jog) {
    if (!parts.cell->find_arm(arm)) return respond(no_such_arm(parts, arm));
    Control& control = control_of(parts);
    if (const auto is_holder = control.check(jog.control); !is_holder) {
      return respond(problem_response(is_holder.error()));
    }
    auto asked = job_of(jog, arm);
    if (!asked) return respond(problem_response(in_words_of_jog(std::move(asked.error()))));
    if (const auto& move = control.holder()->move) let_go(parts, move);
    ask(
        parts,
        [job = std::make_shared<JobRequest>(std::move(*asked)), speed = parts.loop.speed(),
         lease = lease_s(parts)](Executive& executive) -> Result<JobView> {
          auto accepted = executive.submit(std::move(*job));
          if (!accepted) return failure(in_words_of_jog(std::move(accepted.error())));
          return executive.cancel(accepted->key, lease_from(executive, lease, speed));
        },
        [&parts, arm, respond, key = jog.control](const Result<JobView>& job) {
          // Another client may have taken control meanwhile.
          Control& control_now = control_of(parts);
          const bool is_still = control_now.check(key).has_value();
          if (job && is_still) control_now.begin({arm, job->key, now()});
          if (job && !is_still) let_go(parts, Control::Move{arm, job->key});
          respond(jog_response(202, job, parts));
        });
  };
  read_body(parts, call.request, call.respond, read_jog_request, begin);
}

void renew_jog(Call call) {
  const ApiParts& parts = call.parts;
  const std::string arm = call.arguments.front();
  const auto renew = [&parts, arm, respond = call.respond](const ControlKey& shown) {
    if (!parts.cell->find_arm(arm)) return respond(no_such_arm(parts, arm));
    Control& control = control_of(parts);
    if (const auto is_holder = control.check(shown.control); !is_holder) {
      return respond(problem_response(is_holder.error()));
    }
    const auto& move = control.holder()->move;
    if (!move || move->arm != arm) {
      return respond(
          problem_response({Problem{ProblemKind::conflict, "not-jogging", "",
                                    "arm " + arm + " is not being jogged: start with POST", arm}}));
    }
    if (!control.renew(parts.jog_lease, now())) {
      let_go(parts, move);
      return respond(problem_response({Problem{
          ProblemKind::conflict, "jog-lease-expired", "",
          "jog lease of arm " + arm + " expired before this renewal; the arm is stopping", arm}}));
    }
    ask_urgently(
        parts,
        [job = move->job, speed = parts.loop.speed(),
         lease = lease_s(parts)](Executive& executive) {
          return executive.cancel(job, lease_from(executive, lease, speed));
        },
        [&parts, respond](const Result<JobView>& job) { respond(jog_response(200, job, parts)); });
  };
  read_body(parts, call.request, call.respond, read_control_key, renew);
}

Route command(const char* method, const char* path, const char* id, const char* summary) {
  return {.method = method,
          .path = api_path(path),
          .id = id,
          .tag = "arms",
          .summary = summary,
          .who = Who::commander,
          .role = Role::operate};
}

}  // namespace

std::vector<Route> control_routes() {
  Route get{.method = "GET",
            .path = api_path("/control"),
            .id = "getControl",
            .tag = "arms",
            .summary = "Get the client that may jog arms"};
  get.outcomes = {outcome(200, "The client that has control, or null", control_format())};
  get.run = get_control;
  Route take = command("POST", "/control", "takeControl", "Take control in order to jog arms");
  take.text =
      "One client at a time has control. If another client has it, the answer is 409 unless `take` "
      "is true. With `take`, the caller gets control, and the jog motion of the other client "
      "brakes on its path. Jobs need no control.";
  take.reads = body(control_request_format(), {{"ada", R"({"who": "Ada", "take": true})"}});
  take.outcomes = {outcome(200, "The caller has control; `key` authorizes its jog requests",
                           control_taken_format())};
  take.refuses = {409, 422};
  take.run = post_control;
  Route release = command("POST", "/control/release", "releaseControl", "Give control back");
  release.reads = body(control_key_format(), {{"key", R"({"control": "0f1e-2d3c"})"}});
  release.outcomes = {outcome(200, "No client has control", control_format())};
  release.refuses = {409, 422};
  release.run = release_control;
  Route begin = command("POST", "/arms/{name}/jog", "jogArm", "Jog an arm (hold-to-run)");
  begin.text =
      "Submits a slow job that is planned and checked like any other. The motion continues only "
      "while PUT renews its lease within `lease_s`; otherwise the control cycle cancels the job "
      "and the arm brakes on its path. DELETE /jobs/{id} stops the motion at once. Jog jobs are "
      "never stored, even with `--data`.";
  begin.reads = body(
      jog_request_format(),
      {{"ready",
        R"({"control": "0f1e-2d3c", "to": {"named": "ready"}, "velocity_scaling_factor": 0.1})"}});
  begin.outcomes = {outcome(202, "Accepted; the lease starts now", jog_format())};
  begin.refuses = {404, 409, 422};
  begin.run = begin_jog;
  Route renew = command("PUT", "/arms/{name}/jog", "renewJog", "Renew the lease of a jog");
  renew.text =
      "409 if the motion has ended, or if the caller does not have control. Also 409 if the lease "
      "has expired; the motion has then been canceled.";
  renew.reads = body(control_key_format(), {{"key", R"({"control": "0f1e-2d3c"})"}});
  renew.outcomes = {outcome(200, "The lease is renewed", jog_format())};
  renew.refuses = {404, 409, 422};
  renew.run = renew_jog;
  return {get, take, release, begin, renew};
}

}  // namespace armloom
