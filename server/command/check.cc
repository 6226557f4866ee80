#include <iostream>

#include "core/executive/dry_run.h"
#include "server/codec/json_writer.h"
#include "server/command/command.h"
#include "server/messages/job.h"
#include "server/messages/job_request.h"
#include "server/recording/recording.h"

namespace armloom {

int check_jobs_file(const CheckOptions& options) {
  const auto loaded = load_cell(options.cell_file);
  if (!loaded) return kExitBadInput;
  const auto text = read_text_file(options.jobs_file);
  if (!text) return refuse(options.jobs_file, text.error());
  const auto jobs = read_jobs_text(*text);
  if (!jobs) return refuse(options.jobs_file, jobs.error());
  auto checked = check_jobs(loaded->cell, options.policy, *jobs);
  if (!checked) {
    // Faults of the policy and of homes belong to the cell file.
    const std::string& place = checked.error().front().pointer;
    const bool of_cell = place.starts_with("/scheduling") || place.starts_with("/robots");
    Problems problems = std::move(checked.error());
    if (!options.policy.empty()) {
      problems = said_of_option(std::move(problems), "unknown-policy", "--policy");
    }
    return refuse(of_cell ? options.cell_file : options.jobs_file, problems);
  }
  for (const CheckedJob& job : *checked) {
    JsonWriter out;
    out.begin_object().field("id", job.key);
    verdict_part().write(out, job.verdict);
    out.end_object();
    std::cout << out.text() << '\n';
  }
  std::cout.flush();
  return kExitDone;
}

}  // namespace armloom
