#include "core/audit/audit.h"

#include <cmath>
#include <iostream>

#include "server/codec/json_writer.h"
#include "server/command/command.h"
#include "server/command/progress.h"
#include "server/recording/recorded_scenes.h"
#include "server/recording/states_csv.h"

namespace armloom {
namespace {

void write_finding(JsonWriter& out, const AuditFinding& finding) {
  out.begin_object().field("time_s", finding.time).key("links").begin_array();
  out.value(finding.body_a).value(finding.body_b).end_array();
  out.field("distance_m", finding.distance_m).end_object();
}

// Returns {"contact": null | {...}, "smallest_clearance_m", "time_s", "links", "states"}.
std::string report_json(const AuditReport& report) {
  JsonWriter out;
  out.begin_object().key("contact");
  if (report.first_contact) {
    write_finding(out, *report.first_contact);
  } else {
    out.value(nullptr);
  }
  const auto& smallest = report.smallest_clearance;
  if (smallest) {
    out.field("smallest_clearance_m", smallest->distance_m);
    out.field("time_s", smallest->time).key("links").begin_array();
    out.value(smallest->body_a).value(smallest->body_b).end_array();
  } else {
    out.field("smallest_clearance_m", nullptr).field("time_s", nullptr);
    out.key("links").begin_array().end_array();
  }
  out.field("states", report.states_checked).end_object();
  return out.take();
}

void print_report(const AuditReport& report) {
  std::cout << report.states_checked << " states checked\n";
  if (const auto& smallest = report.smallest_clearance) {
    std::cout << "smallest clearance " << smallest->distance_m << " m at "
              << to_seconds(smallest->time) << " s: " << smallest->body_a << " and "
              << smallest->body_b << '\n';
  }
  if (const auto& contact = report.first_contact) {
    std::cout << "first contact at " << to_seconds(contact->time) << " s: " << contact->body_a
              << " and " << contact->body_b << '\n';
  } else {
    std::cout << "no contact\n";
  }
  std::cout << report_json(report) << std::endl;
}

}  // namespace

int audit_recording(const AuditOptions& options) {
  const auto loaded = load_cell(options.cell_file);
  if (!loaded) return kExitBadInput;
  std::error_code ec;
  if (!std::filesystem::is_directory(options.recording, ec)) {
    complain("", {Problem{ProblemKind::not_found, "no-folder", "--recording",
                          "no such folder: " + options.recording, options.recording}});
    return kExitBadInput;
  }
  std::vector<std::string> warnings;
  const auto states = read_true_states(options.recording, *loaded->cell, &warnings);
  if (!states) {
    complain(options.recording, states.error());
    return kExitBadInput;
  }
  const auto scenes = read_scenes(options.recording, *loaded->cell, &warnings);
  if (!scenes) {
    complain(options.recording, scenes.error());
    return kExitBadInput;
  }
  for (const std::string& warning : warnings) std::cerr << "armloom: warning: " << warning << '\n';
  const auto report = [&] {
    const Progress progress("audit of " + std::to_string(states->states.size()) + " states");
    return audit(*loaded->cell, states->states, from_seconds(options.step_s), *scenes);
  }();
  if (!report) {
    complain(options.cell_file, report.error());
    return kExitBadInput;
  }
  if (states->true_from) {
    std::cout << "true positions of simulated arms from " << to_seconds(*states->true_from)
              << " s on (" << kTrueStates << "), measured ones before\n";
  }
  if (!scenes->empty()) {
    std::cout << "objects as in the " << scenes->size() << " scene events of events.jsonl\n";
  }
  print_report(*report);
  return report->first_contact ? kExitFound : kExitDone;
}

}  // namespace armloom
