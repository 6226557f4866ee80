// The texts about one job.
#include <algorithm>
#include <string_view>

#include "server/messages/plain_text.h"
#include "server/messages/text_parts.h"

namespace armloom {
namespace {

std::string arms_of(const Schema& job) {
  const Schema& arms = list_at(job, "arms");
  return (arms.size() == 1 ? "arm " : "arms ") + joined(arms, ", ");
}

// "job reach of arm left", "arm left", "crate".
std::string blocker_of(const Schema& wait) {
  const std::string kind = text_at(wait, "kind"), id = text_at(wait, "id"),
                    arm = text_at(wait, "arm");
  if (kind == "object")
    return list_at(wait, "links").empty() ? "the scene" : list_at(wait, "links").back();
  if (!id.empty()) return "job " + id + (arm.empty() ? "" : " of arm " + arm);
  return arm.empty() ? std::string("another job") : "arm " + arm;
}

const UnlinkedArm* unlinked_arm(const std::string& name, const Present& now) {
  const auto arm = std::ranges::find(now.unlinked, name, &UnlinkedArm::name);
  return arm != now.unlinked.end() ? &*arm : nullptr;
}
// Returns the arm if its controller must connect before the arm can be resumed; else null.
const UnlinkedArm* unlinked_arm(const Schema& wait, const Present& now) {
  return text_at(wait, "kind") == "stop" ? unlinked_arm(text_at(wait, "arm"), now) : nullptr;
}

// A phrase after "it waits for", such as "job reach of arm left to pass".
std::string waited_for(const Schema& wait, const Present& now = {}) {
  const std::string kind = text_at(wait, "kind");
  if (kind == "plan") return "its path to be planned";
  if (kind == "check") {
    const bool is_known = number_at(wait, "progress").has_value();
    return "its collision check" + (is_known ? " (" + percent(wait) + " of the limit)" : "");
  }
  if (const UnlinkedArm* arm = unlinked_arm(wait, now)) {
    return "the controller of arm " + arm->name + " to connect" +
           (arm->has_connected ? " again, and for the arm to be resumed" : "");
  }
  if (kind == "stop") {
    const std::string arm = text_at(wait, "arm");
    return (arm.empty() ? std::string("a stopped arm") : "arm " + arm) + " to be resumed";
  }
  if (kind == "speed") return "the speed override to be raised";
  if (kind == "holding") return "an object to be let go";
  if (kind == "io") return "signal " + text_at(wait, "id");
  if (kind == "predecessor") return blocker_of(wait) + " to end first";
  if (kind == "capacity")
    return blocker_of(wait) + ", because the policy limits what moves at once";
  if (kind == "guard") return "the authority guard, which refused to let it continue";
  if (kind == "object") return blocker_of(wait) + ", which is in its way";
  if (kind == "arm") return blocker_of(wait) + ", which rests in its way";
  return blocker_of(wait) + " to pass";
}

// "panda_link7 and crate would be 4.0 mm apart 1.2 s into its motion", or "".
std::string evidence_of(const Schema& wait) {
  const Schema& links = list_at(wait, "links");
  const auto clearance = number_at(wait, "clearance_m");
  if (links.size() < 2 || !clearance) return "";
  std::string text = joined(links, " and ") + " would " + (*clearance < 0.0 ? "" : "be ") +
                     distance_text(*clearance);
  if (const auto own = number_at(wait, "own_time_s"))
    text += ", " + in_seconds(*own) + " into its motion";
  if (const auto other = number_at(wait, "other_time_s")) {
    text += " and " + in_seconds(*other) + " into the other";
  }
  return text;
}

std::string waits_text(const Schema& job, const Present& now) {
  std::string text;
  for (const Schema& wait : list_at(job, "waits_on")) {
    text += text.empty() ? " It waits for " : " It also waits for ";
    text += waited_for(wait, now);
    if (const std::string evidence = evidence_of(wait); !evidence.empty()) text += ": " + evidence;
    text += '.';
    if (const std::string detail = text_at(wait, "detail"); !detail.empty()) {
      text += " (" + detail + ")";
    }
  }
  return text;
}

std::string since(const Schema& job, const char* key, const Present& now) {
  const auto from = number_at(job, key);
  return from ? " for " + in_seconds(now.time_s - *from) : "";
}

// How long it runs, and "an estimate" before its path is planned.
std::string duration_text(const Schema& job) {
  const std::string text = in_seconds(number_at(job, "duration_s").value_or(0.0));
  return flag_at(job, "duration_is_estimate") ? "about " + text : text;
}

bool waits_on(const Schema& job, std::string_view kind) {
  return std::ranges::any_of(list_at(job, "waits_on"),
                             [&](const Schema& wait) { return text_at(wait, "kind") == kind; });
}

std::string expiry_of(const Schema& job, const Present& now) {
  const auto expires = number_at(job, "expires_s");
  if (!expires) return "";
  return " If nothing changes, it " +
         std::string(text_at(job, "on_timeout") == "replan" ? "is replanned" : "expires") + " in " +
         in_seconds(*expires - now.time_s) + ".";
}

std::string end_of_waiting(const Schema& job, const Present& now) {
  return " It moves for " + duration_text(job) + " once it starts." + expiry_of(job, now);
}

// `with_cause`: says why the link is not up.
std::string start_of_controller(const UnlinkedArm& arm, bool with_cause) {
  return " Start the controller of arm " + arm.name +
         (arm.has_connected ? " again, or repair its connection" : "") +
         (with_cause ? " (" + arm.detail + ")." : ".");
}

// Says which controllers must connect before arms can be resumed, or returns "".
std::string links_needed(const Schema& job, const Present& now) {
  std::string text;
  for (const Schema& wait : list_at(job, "waits_on")) {
    const UnlinkedArm* arm = unlinked_arm(wait, now);
    if (arm == nullptr) continue;
    const bool is_told = text_at(wait, "detail").find(arm->detail) != std::string::npos;
    text += start_of_controller(*arm, !is_told);
  }
  return text;
}

// Says what a client can do about a wait.
std::string remedy_of(const Schema& job, const Present& now) {
  const std::string id = text_at(job, "id");
  const std::string cancel = "cancel it with DELETE /api/v1/jobs/" + id;
  if (!list_at(job, "cycle").empty()) {
    return " The jobs " + joined(list_at(job, "cycle"), ", ") +
           " wait for each other (a deadlock): cancel or replan one of them.";
  }
  if (const std::string links = links_needed(job, now); !links.empty()) {
    return links +
           " If an arm is still stopped when its link is up: POST /api/v1/resume, or "
           "/api/v1/arms/NAME/resume. Or " +
           cancel + ".";
  }
  if (waits_on(job, "stop")) {
    return " To let it continue: POST /api/v1/resume, or /api/v1/arms/NAME/resume; or " + cancel +
           ".";
  }
  if (waits_on(job, "speed")) {
    return " To let it continue: PUT /api/v1/speed, or /api/v1/arms/NAME/speed; or " + cancel + ".";
  }
  if (waits_on(job, "holding")) return " Or " + cancel + ".";  // its detail says how it ends
  if (waits_on(job, "action")) {
    return " It goes on by itself when this step is done. Or " + cancel + ".";
  }
  if (waits_on(job, "io")) {
    return " It goes on by itself when the signal has this value and its device is connected; "
           "GET /api/v1/io shows all signals. Or " +
           cancel + ".";
  }
  if (waits_on(job, "arm") || waits_on(job, "object") || waits_on(job, "job")) {
    return std::string(text_at(job, "state") == "paused" ? " It goes on" : " It starts") +
           " by itself as soon as its way is certified free. To change that: clear the way, plan "
           "another path with POST /api/v1/jobs/" +
           id + "/replan, or " + cancel + ".";
  }
  return list_at(job, "waits_on").empty() ? "" : " Nothing needs to be done; it starts by itself.";
}

std::string time_from_start_to_end(const Schema& job) {
  const auto started = number_at(job, "started_s"), ended = number_at(job, "ended_s");
  // A job that a later session ended has no cell time of its end.
  const auto result = job.find("result");
  const bool is_restart =
      result != job.end() && result->is_object() && text_at(*result, "reason") == "server_restart";
  if (is_restart && (!started || !ended || *ended <= *started)) {
    return started ? " The server did not see when it came to rest." : "";
  }
  if (!started || !ended) return " It never moved.";
  return " It took " + in_seconds(*ended - *started) + " from its start to its end.";
}

std::string ended_text(const Schema& job) {
  const auto result = job.find("result");
  std::string text = " ended as " + text_at(job, "state");
  if (const std::string at = text_at(job, "ended_at"); !at.empty()) text += " at " + at;
  if (result != job.end() && result->is_object()) {
    text += ": " + text_at(*result, "reason");
    if (const std::string detail = text_at(*result, "detail"); !detail.empty())
      text += ", " + detail;
  }
  return text + "." + time_from_start_to_end(job);
}

// Describes a job whose arms brake. The last report of an arm without a link may be old.
std::string braking_text(const Schema& job, const Present& now) {
  std::string absent;
  for (const Schema& name : list_at(job, "arms")) {
    const UnlinkedArm* arm = unlinked_arm(name.get<std::string>(), now);
    if (arm != nullptr) absent += start_of_controller(*arm, true);
  }
  const bool is_ending = std::ranges::find(now.ending, text_at(job, "id")) != now.ending.end();
  if (!is_ending) {
    return (absent.empty() ? " It brakes on its path." : "") + waits_text(job, now) +
           remedy_of(job, now);
  }
  return absent.empty() ? " It brakes on its path, and ends when it rests."
                        : " It ends when its controller reports again." + absent;
}

std::size_t step_index(const Schema& job) {
  return static_cast<std::size_t>(number_at(job, "step").value_or(0.0));
}

// Returns true if the present step of a job with steps moves no arm.
bool is_between_motions(const Schema& job) {
  const Schema& steps = list_at(job, "steps");
  const std::size_t at = step_index(job);
  return at < steps.size() && list_at(steps[at], "arms").empty();
}

std::string moving_text(const Schema& job, const Present& now) {
  const double left =
      (1.0 - number_at(job, "progress").value_or(0.0)) * number_at(job, "duration_s").value_or(0.0);
  std::string text =
      " has run" + since(job, "started_s", now) + " and is " + percent(job) + " done.";
  if (flag_at(job, "stopping")) return text + braking_text(job, now);
  const Schema& steps = list_at(job, "steps");
  const bool awaits_step = waits_on(job, "action") || waits_on(job, "io");
  if (text_at(job, "state") == "paused" && !steps.empty() &&
      (awaits_step || is_between_motions(job))) {
    text = " is at step " + std::to_string(step_index(job) + 1) + " of " +
           std::to_string(steps.size());
    text += awaits_step ? ": " + text_at(list_at(job, "waits_on").front(), "detail") + "."
                        : ", between its motions." + waits_text(job, now);
    return text + remedy_of(job, now);
  }
  if (text_at(job, "state") == "paused") {
    return " is paused on its path at " + percent(job) + "." + waits_text(job, now) +
           expiry_of(job, now) + remedy_of(job, now);
  }
  text += waits_text(job, now);
  return list_at(job, "waits_on").empty() ? text + " It ends in about " + in_seconds(left) + "."
                                          : text;
}

std::string state_text(const Schema& job, const Present& now) {
  const std::string state = text_at(job, "state");
  if (state == "running" || state == "paused") return moving_text(job, now);
  if (state == "scheduled") {
    const auto starts = number_at(job, "scheduled_s");
    return " is certified and starts" + (starts ? " in " + in_seconds(*starts - now.time_s) : "") +
           "." + waits_text(job, now) + " It then moves for " + duration_text(job) + ".";
  }
  if (state == "queued" || state == "backlogged") {
    const bool is_blocked = state == "backlogged";
    return std::string(is_blocked ? " is in the backlog" : " is in the queue") +
           since(job, is_blocked ? "backlogged_s" : "submitted_s", now) + "." +
           waits_text(job, now) + end_of_waiting(job, now) + remedy_of(job, now);
  }
  return ended_text(job);
}

}  // namespace

std::string job_note(const Schema& job) {
  const std::string state = text_at(job, "state");
  const Schema& waits = list_at(job, "waits_on");
  const auto result = job.find("result");
  if (result != job.end() && result->is_object()) {
    const std::string reason = text_at(*result, "reason"), detail = text_at(*result, "detail");
    return reason == "completed" || detail.empty() ? reason : reason + ": " + detail;
  }
  std::string note = state == "running" || state == "paused" ? percent(job) : "";
  if (waits.empty()) return note;
  note += (note.empty() ? "waits for " : ", waits for ") + waited_for(waits.front());
  if (waits.size() > 1) note += " and " + std::to_string(waits.size() - 1) + " more";
  return note;
}

std::string job_text(const Schema& job, const Present& now) {
  const std::string name = text_at(job, "name");
  return "Job " + text_at(job, "id") + (name.empty() ? "" : " (" + name + ")") + " of " +
         arms_of(job) + state_text(job, now) + '\n';
}

std::string distance_text(double clearance_m) {
  const std::string mm = printed("%.1f mm", 1e3 * std::abs(clearance_m));
  return clearance_m < 0.0 ? "overlap by " + mm : mm + " apart";
}

}  // namespace armloom
