#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/problem.h"
#include "core/executive/executive.h"
#include "core/executive/simulation.h"

namespace armloom {

// A client's id for a job: 1..128 characters of [A-Za-z0-9._-], so that it can stand in a URL.
inline constexpr std::size_t kJobKeyMax = 128;
// Of a job's name: for people, any text without control characters.
inline constexpr std::size_t kJobNameMax = 256;

// The body of POST /jobs: its shape only; limits, names and times are validate()'s. `prefix` stands
// in front of every pointer. All faults are returned, at most JsonNode::kFaultsMax.
// ROS's `header` and `effort` are read over; `after`, `on_timeout` and `retime` may say what is
// done anyway (nothing, "abort", false), anything else in them is refused.
[[nodiscard]] Result<JobRequest> read_job(const nlohmann::json& body, std::string_view prefix = "");

// The same from text.
[[nodiscard]] Result<JobRequest> read_job_text(std::string_view text);

// A jobs file: an array of {"at": seconds, "job": {...}}, in any order of time.
[[nodiscard]] Result<std::vector<TimedJob>> read_jobs_text(std::string_view text);

}  // namespace armloom
