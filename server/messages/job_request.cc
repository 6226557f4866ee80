#include "server/messages/job_request.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/base/plain_name.h"
#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/read_text.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"
#include "server/messages/job_terms.h"
#include "server/messages/plan_goal.h"
#include "server/messages/task_request.h"
#include "server/messages/time_max.h"
#include "server/messages/trajectory_request.h"

namespace armloom {

using namespace formats;

namespace {

bool is_key(std::string_view key) {
  const bool allowed = std::ranges::all_of(key, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '_' || c == '-';
  });
  return !key.empty() && key.size() <= kJobKeyMax && allowed && key != "." && key != "..";
}

std::vector<TrajectoryRequest*> own_motions_of(JobRequest& request) {
  std::vector<TrajectoryRequest*> motions{&request.trajectory};
  for (TrajectoryRequest& other : request.alternatives) motions.push_back(&other);
  return motions;
}

// Returns all trajectories of the job, also of its steps.
std::vector<TrajectoryRequest*> motions_of(JobRequest& request) {
  std::vector<TrajectoryRequest*> motions = own_motions_of(request);
  for (StepRequest& step : request.steps) {
    auto* motion = std::get_if<MotionStepRequest>(&step.what);
    if (motion != nullptr && !motion->move_to) motions.push_back(&motion->trajectory);
  }
  return motions;
}

// The member "jobs", which is read after "atomic" and "reorderable". In a non-atomic batch, each
// job is read alone: pointers of problems begin at the job's own body.
class BatchJobs final : public CustomPart<BatchRequest> {
 public:
  void list_keys(std::vector<std::string_view>& keys) const override { keys.push_back("jobs"); }
  void read(const JsonNode& object, BatchRequest& batch) const override {
    object.required("jobs", [&](const JsonNode& n) {
      if (!n.array() || !is_readable(n, size_)) return;
      check_fewest(n, size_);
      n.each([&](const JsonNode& job) { batch.jobs.push_back(entry(job, batch)); });
    });
  }
  void describe(Schema& object, const BatchRequest&, Way way) const override {
    describe_member(object, {"jobs", "", Need::required, {}},
                    list(job_request_format(), size_)->schema(way), std::nullopt, way);
  }

 private:
  static BatchRequest::Entry entry(const JsonNode& node, const BatchRequest& batch) {
    nlohmann::json body = node.raw();
    const bool adds_it = batch.reorderable && body.is_object() && !body.contains("reorderable");
    if (adds_it) body["reorderable"] = true;
    std::string text = body.dump();
    if (!batch.atomic) return {read_job(body), std::move(text)};
    JobRequest job;
    job_request_format()->read(node, job);
    if (adds_it) job.terms.reorderable = true;
    return {std::move(job), std::move(text)};
  }

  const ListSize size_{.fewest = 1, .most = kBatchMax, .noun = "jobs"};
};

template <class T>
Result<Submission<T>> read_submission(const Format<T>& format, std::string_view text) {
  const auto body = parse_json(text, JsonComments::refused);
  if (!body) return failure(body.error());
  Problems faults;
  Submission<T> submission{{}, body->dump()};
  format.read(JsonNode(*body, "", faults), submission.request);
  if (!faults.empty()) return failure(std::move(faults));
  return submission;
}

FormatPtr<std::vector<TimedJob>> jobs_file_format() {
  static const auto format = list(object<TimedJob>({
      required("at", &TimedJob::at, cell_time(kTimeMax_s), "Submission time, in cell time"),
      required("job", &TimedJob::job, job_request_format(), "Body of POST /jobs"),
  }));
  return format;
}

// The member "arm": the arm of a goal. With a trajectory, the arm gives the prefix of joint names.
PartPtr<JobRequest> arm_part() {
  using Request = JobRequest;
  return member<Request>(
      {"arm",
       "With `move_to`: the arm that moves. With `trajectory`: joint names may lack the prefix of "
       "this arm's robot. With `steps`: default of the steps",
       Need::optional,
       {}},
      formats::name(),
      [](const Request& request) {
        return request.arm.empty() ? std::nullopt : std::optional(request.arm);
      },
      [](Request& request, std::string arm) {
        for (TrajectoryRequest* motion : motions_of(request)) {
          if (motion->arm.empty()) motion->arm = arm;
        }
        for (StepRequest& step : request.steps) {
          auto* motion = std::get_if<MotionStepRequest>(&step.what);
          if (motion != nullptr && motion->move_to && motion->arm.empty()) motion->arm = arm;
        }
        request.arm = std::move(arm);
      });
}

enum class WhenRetimed { never, always, if_needed };

// Reads true, false or "if_needed".
class RetimeFormat final : public CustomFormat<WhenRetimed> {
 public:
  void read(const JsonNode& node, WhenRetimed& out) const override {
    if (node.raw() == kIfNeeded) {
      out = WhenRetimed::if_needed;
    } else if (node.raw().is_boolean()) {
      out = node.raw().get<bool>() ? WhenRetimed::always : WhenRetimed::never;
    } else {
      node.fault(ProblemKind::malformed, "wrong-type",
                 std::string("expected true, false or \"if_needed\", found ") + node.raw().dump());
    }
  }
  void write(JsonWriter& out, const WhenRetimed& when) const override {
    when == WhenRetimed::if_needed ? out.value(kIfNeeded) : out.value(when == WhenRetimed::always);
  }
  Schema schema(Way) const override {
    return {{"oneOf", Schema::array({{{"type", "boolean"}}, {{"const", kIfNeeded}}})}};
  }

 private:
  static constexpr const char* kIfNeeded = "if_needed";
};

PartPtr<JobRequest> retime_part() {
  using Request = JobRequest;
  return member<Request>(
      {"retime",
       "true: time-parameterizes the waypoints. The motion is as fast as the joints' limits allow, "
       "rests at both ends, and cuts corners by at most 0.01 rad. Times, velocities and "
       "accelerations of the waypoints are ignored. \"if_needed\": does this only if the "
       "trajectory is not valid as given; the job's `retimed` says whether it was done. A "
       "`move_to` is always time-parameterized",
       Need::optional, Schema(false)},
      make_format<RetimeFormat>(), [](const Request&) { return std::optional<WhenRetimed>(); },
      [](Request& request, WhenRetimed when) {
        for (TrajectoryRequest* motion : motions_of(request)) {
          motion->retime.reset();
          if (when == WhenRetimed::never) continue;
          motion->retime = {.only_if_needed = when == WhenRetimed::if_needed};
        }
      });
}

PartPtr<JobRequest> velocity_scaling_part() {
  using Request = JobRequest;
  return member<Request>(
      {"velocity_scaling_factor",
       "Velocity scaling as in MoveIt: stretches the trajectory in time before it is checked. "
       "Default: 1 for a trajectory with times; the cell's `execution.velocity_scaling_factor` for "
       "`move_to` and `retime`",
       Need::optional,
       {}},
      number({kVelocityScalingMin, 1.0}), [](const Request&) { return std::optional<double>(); },
      [](Request& request, double factor) {
        request.speed = factor;
        for (TrajectoryRequest* motion : motions_of(request)) slow_down(*motion, factor);
      });
}

// Members of every job.
PartPtr<JobRequest> label_parts() {
  using Request = JobRequest;
  return parts<Request>({
      field("id", &Request::key, job_id_format(), "Id of the job; default: the server assigns one"),
      field("name", &Request::name, job_name_format(), "Display name; no control characters"),
      inlined(&Request::terms, job_terms_part()),
      field("after", &Request::after,
            list(job_id_format(), {.most = kAfterMax, .noun = "ids", .what = "predecessors"}),
            "Ids of jobs that must succeed first"),
      not_served<Request>(
          {"sub_trajectory", "not-served",
           "a task's solution has several pieces: send the \"trajectory\" of each as a "
           "job of its own (POST /batches), in the order of the list"}),
  });
}

// Members that change the trajectory, and are read after it.
PartPtr<JobRequest> parts_after_trajectory() {
  return parts<JobRequest>({arm_part(), retime_part(), velocity_scaling_part()});
}

// Members that tools write around a trajectory: rosbridge ("op", "action", "args"), ROS 1's actions
// ("goal_id"), RViz ("model_id", "trajectory_start").
PartPtr<JobRequest> wrapper_parts() {
  using Request = JobRequest;
  const auto only = [](const char* key, const char* value) {
    return not_served<Request>({key, "not-served",
                                "only \"" + std::string(value) + "\" can be sent as a job", value,
                                "As rosbridge writes it"});
  };
  const auto no_id = text(TextRule{[](std::string_view id) { return id.empty(); },
                                   "not-served",
                                   "name the job with \"id\", and leave this id out",
                                   {{"maxLength", 0}}});
  struct GoalId {
    std::string id;
  };
  const auto goal_id = object<GoalId>({
      ignored<GoalId>("stamp", time_format(), "Ignored: the time of sending"),
      ignored<GoalId>("uuid", list(integer(0, 255)), "Ignored: `id` names the job"),
      field("id", &GoalId::id, no_id, "Empty: `id` names the job"),
  });
  return parts<Request>({
      only("op", "send_action_goal"),
      ignored<Request>("action", text(), "Ignored: the joint names say which arm moves"),
      only("action_type", "control_msgs/action/FollowJointTrajectory"),
      ignored<Request>("feedback", flag(), "Ignored: progress is in the events of every job"),
      ignored<Request>("goal_id", goal_id, "As in ROS 1"),
      ignored<Request>("header", anything("object"), "Ignored: the time of sending"),
      ignored<Request>("compression", text(), "Ignored"),
      ignored<Request>("fragment_size", integer(0, std::numeric_limits<int>::max()), "Ignored"),
      ignored<Request>("model_id", text(), "Ignored"),
      ignored<Request>("controller_names", list(text()),
                       "Ignored: the joint names say which arm moves"),
      ignored<Request>("info", anything("object"), "Ignored"),
      ignored<Request>("execution_info", anything("object"), "Ignored"),
      not_served<Request>({"scene_diff", "not-served",
                           "a job does not change the scene: use PUT /scene/objects/{name} or PUT "
                           "/scene, and leave this out"}),
      ignored<Request>("trajectory_start", anything("object"),
                       "Ignored: the first waypoint is the start"),
      tolerance_parts<Request>(),
  });
}

FormatPtr<std::vector<StepRequest>> steps_format() {
  return list(step_request_format(), {.fewest = 1, .most = kStepsMax, .noun = "steps"});
}

FormatPtr<JobRequest> plain_job_format() {
  using Request = JobRequest;
  return named(
      "JobRequest", "",
      object<Request>({
          label_parts(),
          unless(
              "steps",
              unless_refused(
                  "sub_trajectory",
                  unless("alternatives",
                         unless("move_to",
                                unless("goal",
                                       unless("args", member({.key = "trajectory",
                                                              .text = "Motion of the job",
                                                              .need = Need::required,
                                                              .give = "motion of the job, or "
                                                                      "\"move_to\", \"steps\" or "
                                                                      "\"alternatives\" instead"},
                                                             &Request::trajectory,
                                                             trajectory_request_format()))))))),
          field("steps", &Request::steps, steps_format(),
                "Instead of `trajectory`: steps that are executed in this order. Other jobs of the "
                "same arms wait until the last motion has ended"),
          field("goal", &Request::trajectory, action_goal_format(),
                "Instead of `trajectory`: the goal of an action"),
          field("args", &Request::trajectory, action_goal_format(),
                "Instead of `trajectory`: the goal of an action, as rosbridge writes it"),
          field("alternatives", &Request::alternatives,
                list(trajectory_request_format(),
                     {.fewest = 2, .most = kAlternativesMax, .noun = "trajectories"}),
                "Instead of `trajectory`: several trajectories that do the same work with "
                "different arms. Each of them ends where it begins. Exactly one is executed"),
          field("move_to", &Request::move_to, plan_goal_format(),
                "Instead of `trajectory`: a goal for `arm`. The path is planned from where the arm "
                "will be after its earlier jobs. It is planned again if that position changes"),
          field("arms", &Request::arms,
                list(formats::name(), {.fewest = 1, .most = kAlternativesMax, .noun = "arms"}),
                "With `move_to`, instead of `arm`: candidate arms. A path is planned for each; the "
                "arm that arrives first takes the job"),
          at_most_one<Request>({"arm", "arms"}),
          at_most_one<Request>({"trajectory", "alternatives", "move_to", "goal", "args", "steps"}),
          parts_after_trajectory(),
          wrapper_parts(),
      }));
}

// A job whose body is a ROS message, to which members of a job may be added.
FormatPtr<JobRequest> message_format(const char* name, const char* text,
                                     const PartPtr<TrajectoryRequest>& message) {
  return named(name, text,
               object<JobRequest>({label_parts(), inlined(&JobRequest::trajectory, message),
                                   parts_after_trajectory()}));
}

// A job, or a trajectory message that becomes one.
class JobOrMessage final : public CustomFormat<JobRequest> {
 public:
  void read(const JsonNode& node, JobRequest& out) const override {
    const bool is_object = node.raw().is_object() && !node.has("trajectory");
    const bool is_nested = is_object && node.has("joint_trajectory");
    const bool is_bare = is_object && !is_nested && node.has("joint_names") && node.has("points");
    (is_nested ? robot_trajectory_ : is_bare ? trajectory_ : job_)->read(node, out);
    if (is_bare) out.trajectory.place = node.pointer();
    // The place is relative to the job.
    const std::size_t above = node.pointer().size();
    for (TrajectoryRequest* motion : own_motions_of(out)) {
      if (motion->place) motion->place->erase(0, above);
    }
  }
  void write(JsonWriter& out, const JobRequest& job) const override { job_->write(out, job); }
  Schema schema(Way way) const override {
    return {{"anyOf", Schema::array({job_->schema(way), trajectory_->schema(way),
                                     robot_trajectory_->schema(way)})}};
  }

 private:
  FormatPtr<JobRequest> job_ = plain_job_format();
  FormatPtr<JobRequest> trajectory_ = message_format(
      "JointTrajectoryJob", "A message trajectory_msgs/JointTrajectory, with any members of a job.",
      bare_trajectory_parts());
  FormatPtr<JobRequest> robot_trajectory_ = message_format(
      "RobotTrajectoryJob", "A message moveit_msgs/RobotTrajectory, with any members of a job.",
      bare_robot_trajectory_parts());
};

}  // namespace

PartPtr<JobRequest> steps_job_parts() {
  return parts<JobRequest>({
      label_parts(),
      required("steps", &JobRequest::steps, steps_format(),
               "Steps that are executed in this order"),
      parts_after_trajectory(),
  });
}

FormatPtr<std::string> job_id_format() {
  static const auto format =
      named("JobId", "Id of a job, chosen by the client or the server.",
            text(TextRule{
                is_key,
                "bad-id",
                "an id must have 1 to 128 characters of A-Z a-z 0-9 . _ - and must not be . or ..",
                {{"pattern", "^[A-Za-z0-9._-]{1,128}$"}, {"not", {{"enum", {".", ".."}}}}}}));
  return format;
}

bool is_job_name(std::string_view name) {
  return characters(name) <= kJobNameMax &&
         std::ranges::none_of(name, [](char c) { return static_cast<unsigned char>(c) < 0x20; });
}

FormatPtr<std::string> job_name_format() {
  return text(TextRule{is_job_name,
                       "bad-name",
                       "a name must have at most 256 characters and no control characters",
                       {{"maxLength", kJobNameMax}, {"pattern", R"(^[^\u0000-\u001f]*$)"}}});
}

FormatPtr<JobRequest> job_request_format() {
  static const FormatPtr<JobRequest> format = make_format<JobOrMessage>();
  return format;
}

FormatPtr<BatchRequest> batch_request_format() {
  static const auto format = named(
      "BatchRequest", "",
      object<BatchRequest>({
          field("atomic", &BatchRequest::atomic, flag(), "true: all jobs are accepted or none"),
          field("reorderable", &BatchRequest::reorderable, flag(),
                "Default of `reorderable` for the jobs of the batch"),
          make_part<BatchJobs>(),
      }));
  return format;
}

Result<JobRequest> read_job(const nlohmann::json& body) {
  Problems faults;
  JobRequest job;
  job_request_format()->read(JsonNode(body, "", faults), job);
  if (!faults.empty()) return failure(std::move(faults));
  return job;
}

Result<JobRequest> read_job_text(std::string_view text) {
  return read_text(*job_request_format(), text);
}

Result<Submission<JobRequest>> read_job_submission(std::string_view text) {
  return read_submission(*job_request_format(), text);
}

Result<Submission<BatchRequest>> read_batch_submission(std::string_view text) {
  return read_submission(*batch_request_format(), text);
}

Result<BatchRequest> read_batch_text(std::string_view text) {
  return read_text(*batch_request_format(), text);
}

Result<std::vector<TimedJob>> read_jobs_text(std::string_view text) {
  return read_text(*jobs_file_format(), text);
}

}  // namespace armloom
