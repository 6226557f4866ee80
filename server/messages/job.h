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

[[nodiscard]] FormatPtr<JobState> job_state_format();
[[nodiscard]] FormatPtr<WaitView> wait_format();
[[nodiscard]] FormatPtr<JobView> job_format();
// Ids of the jobs in each list of the queue.
[[nodiscard]] FormatPtr<QueueView> queue_ids_format();

// A job in a list: a view from the executive, or JSON text (cached, or from the store).
using JobText = std::shared_ptr<const std::string>;
using ListedJob = std::variant<JobView, JobText>;
[[nodiscard]] FormatPtr<ListedJob> listed_job_format();
// Answer to GET /jobs.
struct JobPage {
  std::vector<ListedJob> jobs;  // newest first
  std::optional<std::string> next_cursor;
};
[[nodiscard]] FormatPtr<JobPage> job_page_format();

// Answer to GET /queue.
struct QueueJobs {
  std::string policy;
  bool stopped;
  std::vector<ListedJob> queued, backlog, scheduled, running;
};
[[nodiscard]] FormatPtr<QueueJobs> queue_format();

// Answers to POST /batches: of an atomic batch, and of a non-atomic batch.
[[nodiscard]] FormatPtr<std::vector<ListedJob>> batch_accepted_format();
[[nodiscard]] FormatPtr<std::vector<Result<ListedJob>>> batch_results_format();

// Answer to POST /check. verdict_part() describes the same members for use in another object.
[[nodiscard]] FormatPtr<CheckView> verdict_format();
[[nodiscard]] const formats::PartPtr<CheckView>& verdict_part();

[[nodiscard]] FormatPtr<DiagramView> diagram_format();

}  // namespace armloom
