#include "server/codec/cell_format.h"

#include "core/executive/known_policies.h"
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
            "Time between the instants that the policy timed_discrete compares."),
      field("tracking_error_rad", &Checking::tracking_error_rad,
            number(Checking::tracking_error_range),
            "How far each joint may be off its path: every proof covers it."),
      field(
          "delay_s", &Checking::delay, seconds(Checking::delay_range),
          "How far a motion is expected to be behind its plan: controllers with a larger lag_s are "
          "warned of. Motions go by measured progress, so nothing that is certified depends on "
          "it."),
      field("limit_tolerance", &Checking::limit_tolerance, number(Checking::limit_tolerance_range),
            "Share by which a trajectory may exceed a limit of velocity, acceleration or jerk "
            "between its waypoints."),
  });
}

FormatPtr<SchedulingSettings> scheduling_format() {
  using Scheduling = SchedulingSettings;
  return object<Scheduling>({
      field("policy", &Scheduling::policy, one_of(known_policies()),
            "The rule by which jobs start; `armloom compare` shows what each makes of your jobs."),
      field("backlog_timeout_s", &Scheduling::backlog_timeout,
            seconds(Scheduling::backlog_timeout_range),
            "A job that has waited so long in the backlog expires, unless it says otherwise."),
      field("aging_s", &Scheduling::aging, seconds(Scheduling::aging_range),
            "A job that has waited so long is overtaken no more."),
      field("on_idle_blocker", &Scheduling::on_idle_blocker, choice<OnIdleBlocker>(),
            "An arm without a job in the way of one, and jobs that wait for each other: park sends "
            "an arm aside, replan plans another way to where the job ends (what its trajectory was "
            "to do on the way is lost) and parks where there is none, report only tells of it."),
      field(
          "horizon_steps", &Scheduling::horizon_steps, integer(Scheduling::horizon_steps_range),
          "Of each arm so many jobs are admitted together, the one under way included; who passes "
          "first is chosen for all of them (coordinated only). Decisions take longer with the "
          "square of it: above 12 tens of milliseconds."),
      field("on_restart", &Scheduling::on_restart, choice<OnRestart>(),
            "What a server with `--data` that is started again does with jobs that had not ended: "
            "ask stops all arms until they are resumed, continue goes on with those that had not "
            "begun."),
  });
}

FormatPtr<MonitorSettings> monitor_format() {
  using Monitor = MonitorSettings;
  return object<Monitor>({
      field("rate_hz", &Monitor::rate_hz, number(Monitor::rate_range),
            "How often the measured state is looked at."),
      field("reaction_s", &Monitor::reaction, seconds(Monitor::reaction_range),
            "Time from a finding to the first arm that brakes."),
      field("stop_clearance_m", &Monitor::stop_clearance_m, number(Monitor::stop_clearance_range),
            "Links closer than this stop their arms. At most clearance_m."),
  });
}

FormatPtr<ExecutionSettings> execution_format() {
  using Execution = ExecutionSettings;
  return object<Execution>({
      field("start_tolerance_rad", &Execution::start_tolerance_rad,
            number(Execution::start_tolerance_range),
            "How far an arm may stand from where its job begins."),
      field("duration_scaling", &Execution::duration_scaling,
            number(Execution::duration_scaling_range),
            "A motion fails as overrun when it takes longer than this times its duration, plus the "
            "margin, and has not moved for 10 s."),
      field("duration_margin_s", &Execution::duration_margin,
            seconds(Execution::duration_margin_range),
            "The margin of that; larger where arms may stall for longer."),
      field("velocity_scaling_factor", &Execution::velocity_scaling_factor,
            number(Execution::velocity_scaling_range),
            "As MoveIt's default: the share of the joints' speeds of every motion whose times the "
            "server makes: goals, paths to be timed, other ways, ways aside. A request's own "
            "velocity_scaling_factor takes its place. Trajectories with times are run as they are "
            "given."),
  });
}

PartPtr<CellDescription> make_settings_part() {
  using Description = CellDescription;
  return parts<Description>({
      field("clearance_m", &Description::clearance_m, number(Description::clearance_range),
            "What every admitted motion keeps from other arms and the scene."),
      field("self_clearance_m", &Description::self_clearance_m,
            number(Description::clearance_range),
            "What an arm's own links keep from each other; at most clearance_m counts."),
      field("mount_clearance_m", &Description::mount_clearance_m,
            number(Description::clearance_range),
            "What an arm keeps from the link that carries it: clearance_m unless given, as that "
            "link may be a table; at most clearance_m counts. Less (0.005) where an "
            "arm folds on its own base or works beside its own body."),
      field("checking", &Description::checking, checking_format(),
            "What the checks of motions allow for."),
      field("scheduling", &Description::scheduling, scheduling_format(), "Which job goes when."),
      field("monitor", &Description::monitor, monitor_format(),
            "The watch over the measured state of all arms."),
      field("execution", &Description::execution, execution_format(),
            "When a motion may begin and when it has failed; the defaults are MoveIt's."),
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
      ignored<Description>("$schema", path(),
                           "This schema: editors check and complete the file by it."),
      required("name", &Description::name, name(), "The cell's name."),
      required("robots", &Description::robots, list(robot_format(), {.fewest = 1}),
               "The robots with their arms."),
      field("objects", &Description::objects, list(scene_object_format()),
            "The scene at start: tables, fixtures, fences."),
      field("allowed_collisions", &Description::allowed_collisions, list(pair_of(name())),
            "Pairs that may touch: two links, or a link and an object; links with their prefix. "
            "Nothing checks them."),
      settings_part(),
  });
  return *format;
}

}  // namespace armloom
