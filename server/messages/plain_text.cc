#include "server/messages/plain_text.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "server/messages/fault.h"
#include "server/messages/text_parts.h"

namespace armloom {
namespace {

// Columns as wide as their longest cell. No line ends with a space.
using Row = std::vector<std::string>;
std::string table_of(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      text += row[i] + std::string(widths[i] + 2 - row[i].size(), ' ');
    }
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  }
  return text;
}

Row row_of(const Schema& job) {
  return {text_at(job, "id"), text_at(job, "state"), joined(list_at(job, "arms"), ","),
          number_at(job, "priority") ? printed("%g", *number_at(job, "priority")) : "",
          job_note(job)};
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

// "stopped: operator; link lost: unix:/tmp/left.sock: Connection refused", or "".
std::string arm_note(const Schema& arm) {
  const std::string cause = text_at(arm, "stop_cause"), link = text_at(arm, "link");
  std::string note = cause.empty() ? "" : "stopped: " + cause;
  if (link != "up") {
    const std::string why = text_at(arm, "link_detail");
    note += (note.empty() ? "" : "; ") + ("link " + link) + (why.empty() ? "" : ": " + why);
  }
  return note;
}

// Says which arms a command does not reach.
std::string absent_text(const Present& now) {
  std::string text;
  for (const UnlinkedArm& arm : now.unlinked) {
    text += "arm " + arm.name + " gets no command, because there is no link to its controller (" +
            arm.detail + ")" + (arm.has_connected ? "; it brakes by itself\n" : "\n");
  }
  return text;
}

// The data of an event, on one line.
std::string news_of(const std::string& type, const Schema& data) {
  if (type == "job") {
    const std::string note = job_note(data);
    return text_at(data, "id") + " " + text_at(data, "state") + (note.empty() ? "" : ": " + note);
  }
  if (type == "arm") {
    const std::string job = text_at(data, "job");
    const auto speed = number_at(data, "effective_speed_override");
    const std::string note = arm_note(data);
    return text_at(data, "name") + " " + text_at(data, "state") +
           (job.empty() ? "" : ", job " + job) +
           (speed && *speed < 1.0 ? ", speed override " + override_text(speed) : "") +
           (note.empty() ? "" : "; " + note);
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
  if (type == "guard") {
    return "refused arm " + text_at(data, "arm") + ", job " + text_at(data, "job") + ": " +
           text_at(data, "kind");
  }
  if (type == "monitor") {
    const Schema& stopped = list_at(data, "stopped");
    return text_at(data, "text") + (stopped.empty() ? "" : "; stopped: " + joined(stopped, ", "));
  }
  if (type == "snapshot") {
    return std::to_string(list_at(data, "jobs").size()) + " jobs, " +
           std::to_string(list_at(data, "arms").size()) + " arms" +
           (flag_at(data, "gap") ? "; earlier events are missing" : "");
  }
  return data.dump();
}

}  // namespace

std::string job_page_text(const Schema& page, const Present&) {
  const Schema& jobs = list_at(page, "jobs");
  if (jobs.empty()) return "no jobs\n";
  const std::string next = text_at(page, "next_cursor");
  return jobs_table(jobs) + (next.empty() ? "" : "more: ?cursor=" + next + '\n');
}

std::string queue_text(const Schema& queue, const Present&) {
  std::string text = "policy " + text_at(queue, "policy") +
                     (flag_at(queue, "stopped") ? ", all arms are stopped" : "") + '\n';
  Schema jobs = Schema::array();
  for (const char* list : {"running", "scheduled", "backlog", "queued"}) {
    for (const Schema& job : list_at(queue, list)) jobs.push_back(job);
  }
  return text + (jobs.empty() ? "no jobs\n" : jobs_table(jobs));
}

std::string speed_text(const Schema& speed, const Present&) {
  const std::string arm = text_at(speed, "name");
  std::string text = "speed override of " + (arm.empty() ? "the cell" : "arm " + arm) + ": " +
                     override_text(number_at(speed, "speed_override"));
  const auto effective = number_at(speed, "effective_speed_override");
  if (effective) text += "; the arm moves at " + override_text(effective);
  return text + '\n';
}

std::string arm_list_text(const Schema& arms, const Present&) {
  std::vector<Row> rows{{"ARM", "STATE", "JOB", "PROGRESS", "OVERRIDE", "POSITIONS", "NOTE"}};
  for (const Schema& arm : list_at(arms, "arms")) {
    const std::string job = text_at(arm, "job");
    std::string q;
    for (const Schema& position : list_at(arm, "q")) {
      q += (q.empty() ? "" : " ") + printed("%.3f", position.get<double>() + 0.0);
    }
    rows.push_back({text_at(arm, "name"), text_at(arm, "state"), job.empty() ? "-" : job,
                    job.empty() ? "-" : percent(arm),
                    override_text(number_at(arm, "effective_speed_override")), q, arm_note(arm)});
  }
  return table_of(rows);
}

std::string arm_text(const Schema& arm, const Present& now) {
  return arm_list_text({{"arms", Schema::array({arm})}}, now);
}

std::string fault_list_text(const Schema& faults, const Present& now) {
  if (list_at(faults, "faults").empty()) return "no faults\n";
  std::vector<Row> rows{{"FAULT", "ARM", "KIND", "VALUE", "STARTS", "REMAINING"}};
  for (const Schema& fault : list_at(faults, "faults")) {
    const double waits_s = number_at(fault, "at_s").value_or(now.time_s) - now.time_s;
    const char* const lasts = fault.contains("remaining_s") ? "remaining_s" : "for_s";
    const auto remaining = number_at(fault, lasts);
    rows.push_back({text_at(fault, "id"), text_at(fault, "arm"), text_at(fault, "kind"),
                    has_value(text_at(fault, "kind"))
                        ? printed("%g", number_at(fault, "value").value_or(0.0))
                        : "-",
                    waits_s > 0.0 ? "in " + in_seconds(waits_s) : "now",
                    remaining ? in_seconds(*remaining) : "-"});
  }
  return table_of(rows);
}

std::string fault_text(const Schema& fault, const Present& now) {
  return fault_list_text({{"faults", Schema::array({fault})}}, now);
}

std::string stopped_text(const Schema& stopped, const Present& now) {
  static constexpr const char* kEffects[] = {
      "switch their drives off, each joint brakes by itself, and moving arms leave their paths",
      "brake on their paths, then switch their drives off",
      "brake on their paths, then hold their positions"};
  if (const auto category = number_at(stopped, "category")) {
    return std::string("all arms ") + kEffects[static_cast<int>(*category)] +
           "; they stay stopped until resumed\n" + absent_text(now);
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
    if (value != fault.end() && !value->is_null()) {
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
