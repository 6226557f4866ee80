#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/executive/events.h"
#include "core/executive/executive.h"
#include "server/codec/object_format.h"

namespace armloom {

// Jobs as the server tells them, and what is told of several. Each is described once: its format
// writes it and gives its schema.

[[nodiscard]] FormatPtr<JobState> job_state_format();
[[nodiscard]] FormatPtr<WaitView> wait_format();
[[nodiscard]] FormatPtr<JobView> job_format();
// Which jobs are in which list, by their ids.
[[nodiscard]] FormatPtr<QueueView> queue_ids_format();

// As the executive has it, or JSON already: as it was written for another list before, or as it was
// told last if only the store has it.
using JobText = std::shared_ptr<const std::string>;
using ListedJob = std::variant<JobView, JobText>;
[[nodiscard]] FormatPtr<ListedJob> listed_job_format();
// The answer to GET /jobs.
struct JobPage {
  std::vector<ListedJob> jobs;  // newest first
  std::optional<std::string> next_cursor;
};
[[nodiscard]] FormatPtr<JobPage> job_page_format();

// The answer to GET /queue.
struct QueueJobs {
  std::string policy;
  bool stopped;
  std::vector<ListedJob> queued, backlog, scheduled, running;
};
[[nodiscard]] FormatPtr<QueueJobs> queue_format();

// The answers to POST /batches, atomic and not.
[[nodiscard]] FormatPtr<std::vector<ListedJob>> batch_accepted_format();
[[nodiscard]] FormatPtr<std::vector<Result<ListedJob>>> batch_results_format();

// The answer to "what if"; its members alone, so that others can stand beside them.
[[nodiscard]] FormatPtr<CheckView> verdict_format();
[[nodiscard]] const formats::PartPtr<CheckView>& verdict_part();

[[nodiscard]] FormatPtr<DiagramView> diagram_format();

}  // namespace armloom
