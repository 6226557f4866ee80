#include "server/codec/cell_format.h"

#include "core/executive/known_policies.h"
#include "server/codec/io_format.h"
#include "server/codec/list_formats.h"
#include "server/codec/robot_format.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/scene_format.h"
#include "server/codec/value_formats.h"

namespace armloom {

using namespace formats;

namespace {

FormatPtr<CheckingSettings> checking_format() {
  using Checking = CheckingSettings;
  return object<Checking>({
      field("time_step_s", &Checking::time_step, seconds(Checking::time_step_range),
            "Time step of the policy timed_discrete. This policy compares motions only at these "
            "instants."),
      field("tracking_error_rad", &Checking::tracking_error_rad,
            number(Checking::tracking_error_range),
            "Largest deviation of a joint from its path. All certificates allow for it."),
      field("delay_s", &Checking::delay, seconds(Checking::delay_range),
            "Expected delay of a motion behind its plan. `validate` warns of controllers with a "
            "larger lag_s. Certificates do not depend on this value, because motions are "
            "coordinated by measured progress."),
      field("limit_tolerance", &Checking::limit_tolerance, number(Checking::limit_tolerance_range),
            "Share by which a trajectory may exceed a velocity, acceleration or jerk limit between "
            "its waypoints."),
  });
}

FormatPtr<SchedulingSettings> scheduling_format() {
  using Scheduling = SchedulingSettings;
  return object<Scheduling>({
      field("policy", &Scheduling::policy, one_of(known_policies()),
            "Policy that decides when jobs start. `armloom compare` simulates your jobs under each "
            "policy."),
      field("backlog_timeout_s", &Scheduling::backlog_timeout,
            seconds(Scheduling::backlog_timeout_range),
            "Time in the backlog after which a job expires; a job can override it."),
      field("aging_s", &Scheduling::aging, seconds(Scheduling::aging_range),
            "Waiting time after which a job can no longer be overtaken."),
      field("on_idle_blocker", &Scheduling::on_idle_blocker, choice<OnIdleBlocker>(),
            "Action when an idle arm or a deadlock cycle blocks a job. park: move an arm out of "
            "the way (retreat). replan: plan another path to the job's end, which loses the rest "
            "of its trajectory; if there is no path, park. report: only report the blockade; in a "
            "deadlock cycle, the job submitted last fails."),
      field("horizon_steps", &Scheduling::horizon_steps, integer(Scheduling::horizon_steps_range),
            "Number of jobs per arm that are scheduled together, including the running one (only "
            "for the policy coordinated). The time for a decision grows with the square of this "
            "number: above 12, it is tens of milliseconds."),
      field("on_restart", &Scheduling::on_restart, choice<OnRestart>(),
            "Action after a restart of a server with `--data` if jobs had not ended. ask: all arms "
            "stay stopped until they are resumed. continue: jobs that had not begun continue by "
            "themselves."),
  });
}

FormatPtr<MonitorSettings> monitor_format() {
  using Monitor = MonitorSettings;
  return object<Monitor>({
      field("rate_hz", &Monitor::rate_hz, number(Monitor::rate_range),
            "Rate at which the measured state is checked."),
      field("reaction_s", &Monitor::reaction, seconds(Monitor::reaction_range),
            "Time from a finding to the start of braking."),
      field("stop_clearance_m", &Monitor::stop_clearance_m, number(Monitor::stop_clearance_range),
            "Clearance below which the monitor stops the arms; at most clearance_m."),
  });
}

FormatPtr<ExecutionSettings> execution_format() {
  using Execution = ExecutionSettings;
  return object<Execution>({
      field("start_tolerance_rad", &Execution::start_tolerance_rad,
            number(Execution::start_tolerance_range),
            "Largest deviation of an arm from the start of its job."),
      field("duration_scaling", &Execution::duration_scaling,
            number(Execution::duration_scaling_range),
            "A motion fails as overrun if two conditions hold: it takes longer than its duration "
            "times this factor plus duration_margin_s, and it has not moved for 10 s."),
      field("duration_margin_s", &Execution::duration_margin,
            seconds(Execution::duration_margin_range),
            "Margin added to the scaled duration; increase it if arms may stall for longer."),
      field("velocity_scaling_factor", &Execution::velocity_scaling_factor,
            number(Execution::velocity_scaling_range),
            "Default velocity scaling of every motion that the server time-parameterizes: goals, "
            "`retime`, replans and retreats. A request can override it, as in MoveIt. Trajectories "
            "with times run as given."),
  });
}

PartPtr<CellDescription> make_settings_part() {
  using Description = CellDescription;
  return parts<Description>({
      field("clearance_m", &Description::clearance_m, number(Description::clearance_range),
            "Clearance that every admitted motion keeps from other arms and the scene."),
      field("self_clearance_m", &Description::self_clearance_m,
            number(Description::clearance_range),
            "Clearance between links of the same arm; limited to clearance_m."),
      field("mount_clearance_m", &Description::mount_clearance_m,
            number(Description::clearance_range),
            "Clearance between an arm and the link that carries it; limited to clearance_m. "
            "Default: clearance_m, because that link may be a table. Set it lower (0.005) if an "
            "arm folds onto its own base or works next to its own body."),
      field("checking", &Description::checking, checking_format(),
            "Tolerances of the collision checks."),
      field("scheduling", &Description::scheduling, scheduling_format(), "Scheduling of jobs."),
      field("monitor", &Description::monitor, monitor_format(),
            "Monitoring of the measured state of all arms."),
      field("execution", &Description::execution, execution_format(),
            "Tolerances for starting and finishing motions; the defaults are MoveIt's."),
  });
}

}  // namespace

PartPtr<CellDescription> settings_part() {
  static const PartPtr<CellDescription> part = make_settings_part();
  return part;
}

std::string settings_text(const CellDescription& settings) {
  JsonWriter out;
  out.begin_object();
  settings_part().write(out, settings);
  out.end_object();
  std::string first, groups;
  const auto add = [](std::string& line, const std::string& key, const Schema& value) {
    const std::string told = value.is_string() ? value.get<std::string>() : value.dump();
    line += (line.empty() ? "" : ", ") + key + " " + told;
  };
  const Schema all = as_json(out);
  for (const auto& [key, value] : all.items()) {
    if (!value.is_object()) {
      add(first, key, value);
      continue;
    }
    std::string line;
    for (const auto& [name, setting] : value.items()) add(line, name, setting);
    groups.append(key).append(": ").append(line).append("\n");
  }
  return first + "\n" + groups;
}

const Format<CellDescription>& cell_format() {
  using Description = CellDescription;
  static const FormatPtr<Description> format = object<Description>({
      ignored<Description>(
          "$schema", path(),
          "Path of this JSON schema; editors use it to check and complete the file."),
      required("name", &Description::name, name(), "Name of the cell."),
      required("robots", &Description::robots, list(robot_format(), {.fewest = 1}),
               "Robots with their arms."),
      field("objects", &Description::objects, list(scene_object_format()),
            "Collision objects at start: tables, fixtures, fences."),
      field("allowed_collisions", &Description::allowed_collisions, list(pair_of(name())),
            "Pairs that may touch: two links, or a link and an object. Link names include the "
            "prefix. Collisions of these pairs are not checked, so the bodies may hit each other."),
      field("io", &Description::io, io_format(), "Inputs and outputs, such as those of a PLC."),
      settings_part(),
  });
  return *format;
}

}  // namespace armloom
