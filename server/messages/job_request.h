#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/problem.h"
#include "core/executive/executive.h"
#include "core/executive/simulation.h"
#include "server/codec/format.h"
#include "server/codec/part.h"

namespace armloom {

// Body of POST /jobs.
[[nodiscard]] FormatPtr<JobRequest> job_request_format();
// The members of a job with `steps`, for an object that has other members too.
[[nodiscard]] formats::PartPtr<JobRequest> steps_job_parts();
[[nodiscard]] FormatPtr<std::string> job_id_format();
// Returns true if the name has at most kJobNameMax characters and no control characters.
[[nodiscard]] bool is_job_name(std::string_view name);
[[nodiscard]] FormatPtr<std::string> job_name_format();

// Ids consist of [A-Za-z0-9._-], so that they fit into a URL.
inline constexpr std::size_t kJobKeyMax = 128;
inline constexpr std::size_t kJobNameMax = 256;
inline constexpr std::size_t kAfterMax = 100;   // predecessors of one job
inline constexpr std::size_t kBatchMax = 1000;  // jobs of one batch
inline constexpr std::size_t kAlternativesMax = 8;

// Reads a job. Checks only the structure of the JSON; validate() checks limits, names and times.
// Returns all faults, at most JsonNode::kFaultsMax. ROS's `header` and `effort` are ignored;
// MoveIt's nesting is accepted.
[[nodiscard]] Result<JobRequest> read_job(const nlohmann::json& body);

[[nodiscard]] Result<JobRequest> read_job_text(std::string_view text);

// A request, and its body in canonical form (members sorted, no white space). The canonical form
// identifies repeated requests.
template <class T>
struct Submission {
  T request;
  std::string canonical;
};
[[nodiscard]] Result<Submission<JobRequest>> read_job_submission(std::string_view text);

// Body of POST /batches. In an atomic batch, all jobs have been read without problems. Otherwise
// each entry has its own result.
struct BatchRequest {
  struct Entry {
    Result<JobRequest> job;
    std::string text;  // body of the job
  };
  bool atomic = true;
  bool reorderable = false;  // default for its jobs
  std::vector<Entry> jobs;
};
[[nodiscard]] FormatPtr<BatchRequest> batch_request_format();
[[nodiscard]] Result<BatchRequest> read_batch_text(std::string_view text);
[[nodiscard]] Result<Submission<BatchRequest>> read_batch_submission(std::string_view text);

// Reads [{"at": seconds, "job": {...}}, ...], in any order of time.
[[nodiscard]] Result<std::vector<TimedJob>> read_jobs_text(std::string_view text);

}  // namespace armloom
