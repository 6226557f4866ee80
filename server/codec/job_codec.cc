#include "server/codec/job_codec.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "server/codec/json_node.h"
#include "server/codec/json_text.h"

namespace armloom {
namespace {

constexpr double kTimeMax_s = 1e6;  // of anything that a client names in seconds

// {"sec", "nanosec"} as ROS 2 prints it, {"secs", "nsecs"} as ROS 1 does, or a number of seconds.
void read_time(const JsonNode& node, double& seconds) {
  if (node.raw().is_number()) {
    node.read(seconds);
    return;
  }
  if (!node.raw().is_object()) {
    node.fault(ProblemKind::malformed, "wrong-type",
               std::string("expected {\"sec\", \"nanosec\"} or a number of seconds, found ") +
                   node.raw().type_name());
    return;
  }
  const bool ros1 = node.has("secs") || node.has("nsecs");
  const char* whole_key = ros1 ? "secs" : "sec";
  const char* rest_key = ros1 ? "nsecs" : "nanosec";
  if (!node.object({whole_key, rest_key})) return;
  std::int64_t whole = 0;
  std::int64_t rest = 0;
  node.required(whole_key, [&](const JsonNode& n) {
    n.read_integer(whole, std::numeric_limits<std::int32_t>::min(),
                   std::numeric_limits<std::int32_t>::max());
  });
  node.required(rest_key, [&](const JsonNode& n) { n.read_integer(rest, 0, 999'999'999); });
  seconds = static_cast<double>(whole) + static_cast<double>(rest) * 1e-9;
}

void read_waypoint(const JsonNode& node, WaypointRequest& point) {
  if (!node.object({"positions", "velocities", "accelerations", "effort", "time_from_start"}))
    return;
  node.required("positions", [&](const JsonNode& n) { n.read(point.positions); });
  node.optional("velocities", [&](const JsonNode& n) { n.read(point.velocities); });
  node.optional("accelerations", [&](const JsonNode& n) { n.read(point.accelerations); });
  node.optional("effort", [&](const JsonNode& n) { (void)n.array(); });
  node.required("time_from_start",
                [&](const JsonNode& n) { read_time(n, point.time_from_start_s); });
}

// MoveIt's RobotTrajectory holds the trajectory of the joints one level deeper, beside one of
// floating joints, which no cell has. Problems are then to be found below "/joint_trajectory".
constexpr const char* kNested = "joint_trajectory";

bool is_nested(const JsonNode& node) { return node.raw().is_object() && node.has(kNested); }

// The multi-DoF trajectory as ROS prints one that is empty.
void read_empty_multi_dof(const JsonNode& node) {
  if (!node.is_object()) return;
  for (const char* list : {"joint_names", "points"}) {
    node.optional(list, [](const JsonNode& n) {
      if (n.array() && !n.raw().empty()) {
        n.invalid("unsupported", "joints of several degrees of freedom are not moved by any arm");
      }
    });
  }
}

void read_trajectory(const JsonNode& node, TrajectoryRequest& trajectory) {
  if (is_nested(node)) {
    if (!node.object({kNested, "multi_dof_joint_trajectory"})) return;
    node.optional("multi_dof_joint_trajectory", [](const JsonNode& n) { read_empty_multi_dof(n); });
    return node.required(kNested, [&](const JsonNode& n) {
      if (is_nested(n)) {
        n.invalid("unknown-field", "a trajectory is nested once, not twice");
      } else {
        read_trajectory(n, trajectory);
      }
    });
  }
  if (!node.object({"joint_names", "points", "header"})) return;
  node.optional("header", [&](const JsonNode& n) { (void)n.is_object(); });
  node.required("joint_names", [&](const JsonNode& n) { n.read(trajectory.joint_names); });
  node.required("points", [&](const JsonNode& n) {
    if (!n.array()) return;
    if (n.raw().size() > kWaypointsMax) {
      n.fault(ProblemKind::too_large, "too-many-waypoints",
              std::to_string(n.raw().size()) + " waypoints, at most " +
                  std::to_string(kWaypointsMax) + " are read");
      return;
    }
    trajectory.points.reserve(n.raw().size());
    n.each([&](const JsonNode& point) { read_waypoint(point, trajectory.points.emplace_back()); });
  });
}

void read_key(const JsonNode& node, std::string& key) {
  if (!node.read(key)) return;
  const bool allowed = std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '_' || c == '-';
  });
  if (key.empty() || key.size() > kJobKeyMax || !allowed || key == "." || key == "..") {
    node.invalid("bad-id", "an id is 1 to 128 characters of A-Z a-z 0-9 . _ -");
  }
}

void read_name(const JsonNode& node, std::string& name) {
  if (!node.read(name)) return;
  const bool control = std::any_of(name.begin(), name.end(),
                                   [](char c) { return static_cast<unsigned char>(c) < 0x20; });
  if (name.size() > kJobNameMax || control) {
    node.invalid("bad-name", "a name is at most 256 bytes without control characters");
  }
}

void read_after(const JsonNode& node, JobRequest& job) {
  if (!node.array()) return;
  if (node.raw().size() > kAfterMax) {
    node.fault(ProblemKind::too_large, "too-many-predecessors",
               std::to_string(node.raw().size()) + " ids, at most " + std::to_string(kAfterMax) +
                   " are read");
    return;
  }
  node.each([&](const JsonNode& n) { read_key(n, job.after.emplace_back()); });
}

// Fields of the contract whose other values are still to come: what is accepted is what is done.
void read_fixed_choices(const JsonNode& node) {
  node.optional("on_timeout", [](const JsonNode& n) {
    std::string choice;
    if (n.read(choice) && choice != "abort") {
      n.invalid("not-served", "\"on_timeout\" can only be \"abort\" in this version");
    }
  });
  node.optional("retime", [](const JsonNode& n) {
    bool retime = false;
    if (n.read(retime) && retime) {
      n.invalid("not-served", "\"retime\" needs time parameterisation, which this version lacks");
    }
  });
  node.optional("steps", [](const JsonNode& n) {
    n.invalid("not-served", "\"steps\" are not served by this version; give one \"trajectory\"");
  });
}

void read_job_fields(const JsonNode& node, JobRequest& job) {
  if (!node.object({"id", "name", "trajectory", "priority", "backlog_timeout_s", "after",
                    "on_timeout", "retime", "steps"})) {
    return;
  }
  node.optional("id", [&](const JsonNode& n) { read_key(n, job.key); });
  node.optional("name", [&](const JsonNode& n) { read_name(n, job.name); });
  node.optional("priority", [&](const JsonNode& n) {
    std::int64_t priority = 0;
    if (n.read_integer(priority, -1'000'000, 1'000'000)) job.priority = static_cast<int>(priority);
  });
  node.optional("backlog_timeout_s", [&](const JsonNode& n) {
    double seconds = 0.0;
    if (n.read_within(seconds, 0.0, kTimeMax_s)) job.backlog_timeout = from_seconds(seconds);
  });
  node.optional("after", [&](const JsonNode& n) { read_after(n, job); });
  read_fixed_choices(node);
  if (!node.has("steps")) {
    node.required("trajectory", [&](const JsonNode& n) { read_trajectory(n, job.trajectory); });
  }
}

}  // namespace

Result<JobRequest> read_job(const nlohmann::json& body, std::string_view prefix) {
  Problems faults;
  JobRequest job;
  read_job_fields(JsonNode(body, prefix, faults), job);
  if (!faults.empty()) return failure(std::move(faults));
  return job;
}

Result<JobRequest> read_job_text(std::string_view text) {
  const auto body = parse_json(text, JsonComments::refused);
  if (!body) return failure(body.error());
  return read_job(*body);
}

Result<BatchRequest> read_batch_text(std::string_view text) {
  const auto body = parse_json(text, JsonComments::refused);
  if (!body) return failure(body.error());
  Problems faults;
  BatchRequest batch;
  const JsonNode node(*body, "", faults);
  if (!node.object({"jobs", "atomic"})) return failure(std::move(faults));
  node.optional("atomic", [&](const JsonNode& n) { n.read(batch.atomic); });
  node.required("jobs", [&](const JsonNode& n) {
    if (!n.array()) return;
    if (n.raw().empty()) n.invalid("no-job", "a batch has at least one job");
    if (n.raw().size() > kBatchMax) {
      n.fault(ProblemKind::too_large, "too-many-jobs",
              std::to_string(n.raw().size()) + " jobs, at most " + std::to_string(kBatchMax) +
                  " are read");
      return;
    }
    for (std::size_t i = 0; i < n.raw().size(); ++i) {
      const nlohmann::json& job = n.raw()[i];
      // Alone each job has its own answer, with places in its own body.
      const std::string prefix = batch.atomic ? "/jobs/" + std::to_string(i) : "";
      batch.jobs.push_back({read_job(job, prefix), job.dump()});
    }
  });
  for (const BatchRequest::Entry& entry : batch.jobs) {
    if (!batch.atomic || entry.job) continue;
    for (const Problem& problem : entry.job.error()) {
      if (faults.size() < JsonNode::kFaultsMax) faults.push_back(problem);
    }
  }
  if (!faults.empty()) return failure(std::move(faults));
  return batch;
}

Result<std::vector<TimedJob>> read_jobs_text(std::string_view text) {
  const auto file = parse_json(text, JsonComments::refused);
  if (!file) return failure(file.error());
  Problems faults;
  std::vector<TimedJob> jobs;
  JsonNode(*file, "", faults).each([&](const JsonNode& node) {
    if (!node.object({"at", "job"})) return;
    TimedJob timed{};
    node.required("at", [&](const JsonNode& n) {
      double seconds = 0.0;
      if (n.read_within(seconds, 0.0, kTimeMax_s)) timed.at = at(from_seconds(seconds));
    });
    node.required("job", [&](const JsonNode& n) { read_job_fields(n, timed.job); });
    jobs.push_back(std::move(timed));
  });
  if (!faults.empty()) return failure(std::move(faults));
  return jobs;
}

}  // namespace armloom
