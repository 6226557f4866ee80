#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/problem.h"
#include "core/executive/executive.h"
#include "core/executive/simulation.h"
#include "server/codec/format.h"

namespace armloom {

// The body of POST /jobs.
[[nodiscard]] FormatPtr<JobRequest> job_request_format();
// A client's id for a job: what may stand in a URL.
[[nodiscard]] FormatPtr<std::string> job_id_format();
// For people: not too long, and without control characters.
[[nodiscard]] bool is_job_name(std::string_view name);
[[nodiscard]] FormatPtr<std::string> job_name_format();

// A client's id for a job: 1..128 characters of [A-Za-z0-9._-], so that it can stand in a URL.
inline constexpr std::size_t kJobKeyMax = 128;
// Of a job's name: for people, any text without control characters.
inline constexpr std::size_t kJobNameMax = 256;
inline constexpr std::size_t kAfterMax = 100;   // predecessors of one job
inline constexpr std::size_t kBatchMax = 1000;  // jobs of one batch
inline constexpr std::size_t kAlternativesMax = 8;

// The body of POST /jobs: its shape only; limits, names and times are validate()'s. All
// faults are returned, at most JsonNode::kFaultsMax.
// ROS's `header` and `effort` are read over. The trajectory may stand one level deeper, as
// MoveIt has it ("trajectory": {"joint_trajectory": {...}}).
[[nodiscard]] Result<JobRequest> read_job(const nlohmann::json& body);

// The same from text.
[[nodiscard]] Result<JobRequest> read_job_text(std::string_view text);

// What was asked for, and its body in one way of writing, by which it is known again: members in
// order of their names, no space between.
template <class T>
struct Submission {
  T request;
  std::string canonical;
};
[[nodiscard]] Result<Submission<JobRequest>> read_job_submission(std::string_view text);

// The body of POST /batches: {"jobs": [...], "atomic": true}. Of an atomic batch every job could be
// read; else each entry says for itself whether it could.
struct BatchRequest {
  struct Entry {
    Result<JobRequest> job;
    std::string text;  // the body of this job
  };
  bool atomic = true;
  bool reorderable = false;  // of every job that does not set it
  std::vector<Entry> jobs;
};
[[nodiscard]] FormatPtr<BatchRequest> batch_request_format();
[[nodiscard]] Result<BatchRequest> read_batch_text(std::string_view text);
[[nodiscard]] Result<Submission<BatchRequest>> read_batch_submission(std::string_view text);

// A jobs file: an array of {"at": seconds, "job": {...}}, in any order of time.
[[nodiscard]] Result<std::vector<TimedJob>> read_jobs_text(std::string_view text);

}  // namespace armloom
