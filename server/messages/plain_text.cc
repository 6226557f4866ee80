#include "server/messages/plain_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string_view>
#include <vector>

namespace armloom {
namespace {

// Reads of members that may be absent or null.
std::string text_at(const Schema& object, const char* key) {
  const auto it = object.find(key);
  return it != object.end() && it->is_string() ? it->get<std::string>() : std::string();
}
std::optional<double> number_at(const Schema& object, const char* key) {
  const auto it = object.find(key);
  return it != object.end() && it->is_number() ? std::optional(it->get<double>()) : std::nullopt;
}
bool flag_at(const Schema& object, const char* key) {
  const auto it = object.find(key);
  return it != object.end() && it->is_boolean() && it->get<bool>();
}
const Schema& list_at(const Schema& object, const char* key) {
  static const Schema kEmpty = Schema::array();
  const auto it = object.find(key);
  return it != object.end() && it->is_array() ? *it : kEmpty;
}

std::string printed(const char* format, double number) {
  char text[64];
  std::snprintf(text, sizeof text, format, number);
  return text;
}
std::string in_seconds(double s) {
  return printed(s < 9.95 ? "%.1f s" : "%.0f s", std::max(0.0, s));
}
std::string percent(const Schema& of) {
  return printed("%.0f %%", std::floor(100.0 * number_at(of, "progress").value_or(0.0)));
}

std::string joined(const Schema& names, const char* between) {
  std::string all;
  for (const Schema& name : names) {
    all +=
        (all.empty() ? "" : between) + (name.is_string() ? name.get<std::string>() : name.dump());
  }
  return all;
}
std::string arms_of(const Schema& job) {
  const Schema& arms = list_at(job, "arms");
  return (arms.size() == 1 ? "arm " : "arms ") + joined(arms, ", ");
}

// Columns as wide as their longest cell; the last column is not padded.
using Row = std::vector<std::string>;
std::string table_of(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const Row& row : rows) {
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
      text += row[i] + std::string(widths[i] + 2 - row[i].size(), ' ');
    }
    text += row.back() + '\n';
  }
  return text;
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

// A phrase after "it waits for", such as "job reach of arm left to pass".
std::string waited_for(const Schema& wait) {
  const std::string kind = text_at(wait, "kind");
  if (kind == "plan") return "its path to be planned";
  if (kind == "check") {
    const bool is_known = number_at(wait, "progress").has_value();
    return "its collision check" + (is_known ? " (" + percent(wait) + " of the limit)" : "");
  }
  if (kind == "stop") {
    const std::string arm = text_at(wait, "arm");
    return (arm.empty() ? std::string("a stopped arm") : "arm " + arm) + " to be resumed";
  }
  if (kind == "speed") return "the speed override to be raised";
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

std::string waits_text(const Schema& job) {
  std::string text;
  for (const Schema& wait : list_at(job, "waits_on")) {
    text += text.empty() ? " It waits for " : " It also waits for ";
    text += waited_for(wait);
    if (const std::string evidence = evidence_of(wait); !evidence.empty()) text += ": " + evidence;
    text += '.';
    if (const std::string detail = text_at(wait, "detail"); !detail.empty()) {
      text += " (" + detail + ")";
    }
  }
  return text;
}

std::string since(const Schema& job, const char* key, double now_s) {
  const auto from = number_at(job, key);
  return from ? " for " + in_seconds(now_s - *from) : "";
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

std::string expiry_of(const Schema& job, double now_s) {
  const auto expires = number_at(job, "expires_s");
  if (!expires) return "";
  return " If nothing changes, it " +
         std::string(text_at(job, "on_timeout") == "replan" ? "is replanned" : "expires") + " in " +
         in_seconds(*expires - now_s) + ".";
}

std::string end_of_waiting(const Schema& job, double now_s) {
  return " It moves for " + duration_text(job) + " once it starts." + expiry_of(job, now_s);
}

// Says what a client can do about a wait.
std::string remedy_of(const Schema& job) {
  const std::string id = text_at(job, "id");
  const std::string cancel = "cancel it with DELETE /api/v1/jobs/" + id;
  if (!list_at(job, "cycle").empty()) {
    return " The jobs " + joined(list_at(job, "cycle"), ", ") +
           " wait for each other (a deadlock): cancel or replan one of them.";
  }
  if (waits_on(job, "stop")) {
    return " To let it continue: POST /api/v1/resume, or /api/v1/arms/NAME/resume; or " + cancel +
           ".";
  }
  if (waits_on(job, "speed")) {
    return " To let it continue: PUT /api/v1/speed, or /api/v1/arms/NAME/speed; or " + cancel + ".";
  }
  if (waits_on(job, "arm") || waits_on(job, "object") || waits_on(job, "job")) {
    return std::string(text_at(job, "state") == "paused" ? " It goes on" : " It starts") +
           " by itself as soon as its way is certified free. To change that: clear the way, plan "
           "another path with POST /api/v1/jobs/" +
           id + "/replan, or " + cancel + ".";
  }
  return list_at(job, "waits_on").empty() ? "" : " Nothing needs to be done; it starts by itself.";
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
  const auto started = number_at(job, "started_s"), ended = number_at(job, "ended_s");
  if (started && ended) {
    text += ". It took " + in_seconds(*ended - *started) + " from its start to its end";
  } else {
    text += ". It never moved";
  }
  return text + ".";
}

std::string moving_text(const Schema& job, double now_s) {
  const double left =
      (1.0 - number_at(job, "progress").value_or(0.0)) * number_at(job, "duration_s").value_or(0.0);
  std::string text =
      " has run" + since(job, "started_s", now_s) + " and is " + percent(job) + " done.";
  if (flag_at(job, "stopping")) return text + " It brakes on its path.";
  if (text_at(job, "state") == "paused") {
    return " is paused on its path at " + percent(job) + "." + waits_text(job) +
           expiry_of(job, now_s) + remedy_of(job);
  }
  text += waits_text(job);
  return list_at(job, "waits_on").empty() ? text + " It ends in about " + in_seconds(left) + "."
                                          : text;
}

std::string state_text(const Schema& job, double now_s) {
  const std::string state = text_at(job, "state");
  if (state == "running" || state == "paused") return moving_text(job, now_s);
  if (state == "scheduled") {
    const auto starts = number_at(job, "scheduled_s");
    return " is certified and starts" + (starts ? " in " + in_seconds(*starts - now_s) : "") + "." +
           waits_text(job) + " It then moves for " + duration_text(job) + ".";
  }
  if (state == "queued" || state == "backlogged") {
    const bool is_blocked = state == "backlogged";
    return std::string(is_blocked ? " is in the backlog" : " is in the queue") +
           since(job, is_blocked ? "backlogged_s" : "submitted_s", now_s) + "." + waits_text(job) +
           end_of_waiting(job, now_s) + remedy_of(job);
  }
  return ended_text(job);
}

// "waits for job reach of arm left to pass", "40 %", "completed".
std::string note_of(const Schema& job) {
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

Row row_of(const Schema& job) {
  return {text_at(job, "id"), text_at(job, "state"), joined(list_at(job, "arms"), ","),
          number_at(job, "priority") ? printed("%g", *number_at(job, "priority")) : "",
          note_of(job)};
}

std::string jobs_table(const Schema& jobs) {
  std::vector<Row> rows{{"JOB", "STATE", "ARMS", "PRIORITY", "NOTE"}};
  for (const Schema& job : jobs) rows.push_back(row_of(job));
  return table_of(rows);
}

// "25 %", "0.1 %"
std::string override_text(std::optional<double> share) {
  return share ? printed("%g %%", 100.0 * *share) : "-";
}

// The data of an event, on one line.
std::string news_of(const std::string& type, const Schema& data) {
  if (type == "job") {
    const std::string note = note_of(data);
    return text_at(data, "id") + " " + text_at(data, "state") + (note.empty() ? "" : ": " + note);
  }
  if (type == "arm") {
    const std::string job = text_at(data, "job");
    const auto speed = number_at(data, "effective_speed_override");
    return text_at(data, "name") + " " + text_at(data, "state") +
           (job.empty() ? "" : ", job " + job) +
           (speed && *speed < 1.0 ? ", speed override " + override_text(speed) : "");
  }
  if (type == "queue") {
    std::string text = flag_at(data, "stopped") ? "all arms are stopped; " : "";
    const auto speed = number_at(data, "speed_override");
    if (speed && *speed < 1.0) text += "speed override " + override_text(speed) + "; ";
    for (const char* list : {"queued", "backlog", "scheduled", "running"}) {
      text += (std::string_view(list) == "queued" ? "" : ", ") +
              std::to_string(list_at(data, list).size()) + " " + list;
    }
    return text;
  }
  if (type == "scene")
    return printed("version %.0f", number_at(data, "version").value_or(0)) + ", " +
           std::to_string(list_at(data, "objects").size()) + " objects";
  if (type == "alert") return text_at(data, "level") + ": " + text_at(data, "text");
  if (type == "snapshot") {
    return std::to_string(list_at(data, "jobs").size()) + " jobs, " +
           std::to_string(list_at(data, "arms").size()) + " arms" +
           (flag_at(data, "gap") ? "; earlier events are missing" : "");
  }
  std::string text = joined(list_at(data, "arms"), ", ");
  if (const std::string kind = text_at(data, "kind"); !kind.empty())
    text += (text.empty() ? "" : ": ") + kind;
  if (const Schema& links = list_at(data, "links"); links.size() == 2)
    text += ", " + joined(links, " and ");
  if (const auto clearance = number_at(data, "clearance_m"))
    text += " " + distance_text(*clearance);
  if (const Schema& stopped = list_at(data, "stopped"); !stopped.empty())
    text += "; stopped: " + joined(stopped, ", ");
  return text.empty() ? data.dump() : text;
}

}  // namespace

std::string distance_text(double clearance_m) {
  const std::string mm = printed("%.1f mm", 1e3 * std::abs(clearance_m));
  return clearance_m < 0.0 ? "overlap by " + mm : mm + " apart";
}

std::string job_text(const Schema& job, double now_s) {
  const std::string name = text_at(job, "name");
  return "Job " + text_at(job, "id") + (name.empty() ? "" : " (" + name + ")") + " of " +
         arms_of(job) + state_text(job, now_s) + '\n';
}

std::string job_page_text(const Schema& page, double) {
  const Schema& jobs = list_at(page, "jobs");
  if (jobs.empty()) return "no jobs\n";
  const std::string next = text_at(page, "next_cursor");
  return jobs_table(jobs) + (next.empty() ? "" : "more: ?cursor=" + next + '\n');
}

std::string queue_text(const Schema& queue, double) {
  std::string text = "policy " + text_at(queue, "policy") +
                     (flag_at(queue, "stopped") ? ", all arms are stopped" : "") + '\n';
  Schema jobs = Schema::array();
  for (const char* list : {"running", "scheduled", "backlog", "queued"}) {
    for (const Schema& job : list_at(queue, list)) jobs.push_back(job);
  }
  return text + (jobs.empty() ? "no jobs\n" : jobs_table(jobs));
}

std::string speed_text(const Schema& speed, double) {
  const std::string arm = text_at(speed, "name");
  std::string text = "speed override of " + (arm.empty() ? "the cell" : "arm " + arm) + ": " +
                     override_text(number_at(speed, "speed_override"));
  const auto effective = number_at(speed, "effective_speed_override");
  if (effective) text += "; with the cell's: " + override_text(effective);
  return text + '\n';
}

std::string arm_list_text(const Schema& arms, double) {
  std::vector<Row> rows{{"ARM", "STATE", "JOB", "PROGRESS", "OVERRIDE", "POSITIONS"}};
  for (const Schema& arm : list_at(arms, "arms")) {
    const std::string job = text_at(arm, "job");
    std::string q;
    for (const Schema& position : list_at(arm, "q")) {
      q += (q.empty() ? "" : " ") + printed("%.3f", position.get<double>() + 0.0);
    }
    rows.push_back({text_at(arm, "name"), text_at(arm, "state"), job.empty() ? "-" : job,
                    job.empty() ? "-" : percent(arm),
                    override_text(number_at(arm, "effective_speed_override")), q});
  }
  return table_of(rows);
}

std::string arm_text(const Schema& arm, double now_s) {
  return arm_list_text({{"arms", Schema::array({arm})}}, now_s);
}

std::string fault_list_text(const Schema& faults, double now_s) {
  if (list_at(faults, "faults").empty()) return "no faults\n";
  std::vector<Row> rows{{"FAULT", "ARM", "KIND", "VALUE", "STARTS", "REMAINING"}};
  for (const Schema& fault : list_at(faults, "faults")) {
    const double waits_s = number_at(fault, "at_s").value_or(now_s) - now_s;
    const char* const lasts = fault.contains("remaining_s") ? "remaining_s" : "for_s";
    const auto remaining = number_at(fault, lasts);
    rows.push_back({text_at(fault, "id"), text_at(fault, "arm"), text_at(fault, "kind"),
                    printed("%g", number_at(fault, "value").value_or(0.0)),
                    waits_s > 0.0 ? "in " + in_seconds(waits_s) : "now",
                    remaining ? in_seconds(*remaining) : "-"});
  }
  return table_of(rows);
}

std::string fault_text(const Schema& fault, double now_s) {
  return fault_list_text({{"faults", Schema::array({fault})}}, now_s);
}

std::string stopped_text(const Schema& stopped, double) {
  static constexpr const char* kEffects[] = {
      "switch their drives off, each joint brakes by itself, and moving arms leave their paths",
      "brake on their paths, then switch their drives off",
      "brake on their paths, then hold their positions"};
  if (const auto category = number_at(stopped, "category")) {
    return std::string("all arms ") + kEffects[static_cast<int>(*category)] +
           "; they stay stopped until resumed\n";
  }
  const Schema& absent = list_at(stopped, "not_resumed");
  return absent.empty()
             ? "all arms are resumed\n"
             : "not resumed, because there is no link to the controller: " + joined(absent, ", ") +
                   "\n";
}

std::string problem_text(const Schema& problem) {
  const auto line = [](const Schema& fault) {
    const std::string pointer = text_at(fault, "pointer");
    const std::string detail = text_at(fault, "detail");
    std::string text =
        pointer.empty() || pointer == "request target" ? detail : pointer + ": " + detail;
    const auto value = fault.find("value");
    if (value != fault.end()) {
      const std::string found = value->is_string() ? value->get<std::string>() : value->dump();
      if (!found.empty() && detail.find(found) == detail.npos) text += " (found " + found + ")";
    }
    return text + '\n';
  };
  const Schema& errors = list_at(problem, "errors");
  if (errors.empty()) return line(problem);
  std::string text;
  for (const Schema& error : errors) text += line(error);
  return text;
}

std::string event_text(const Schema& message) {
  const std::string type = text_at(message, "type");
  const auto data = message.find("data");
  if (type == "state" || data == message.end()) return "";
  return printed("%10.3f  ", number_at(message, "t_s").value_or(0.0)) + type + "  " +
         news_of(type, *data) + '\n';
}

}  // namespace armloom
