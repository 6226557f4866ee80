#include "core/executive/views.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>

#include "core/executive/arms_of.h"
#include "core/scheduler/deadlines.h"

namespace armloom {
namespace {

// Names the setting with which `whom` would retreat.
std::string to_send_aside(const std::string& whom) {
  return "set \"on_idle_blocker\": \"park\" or \"replan\" in the cell's scheduling, so that " +
         whom + " retreats if a path is free";
}

// Lists the retreats that are tried.
std::string ways_aside(const Cell& cell) {
  const std::string known = "back along its last motion, home, ";
  const bool plans = cell.scheduling.on_idle_blocker == OnIdleBlocker::replan;
  return known + (plans ? "to a named pose of its group, or to a planned position clear of the path"
                        : "or to a named pose of its group");
}

// Hint on how to unblock a job that waits for a resting arm; nullopt if the arm's own jobs will
// move it.
std::optional<std::string> opens(const Wait& wait, bool in_vain, const Cell& cell,
                                 const JobNames& names) {
  const std::string arm = "arm " + cell.arm(*wait.arm).name;
  const bool stopped = names.is_stopped(*wait.arm);
  if (names.has_job(*wait.arm)) {
    if (!stopped) return std::nullopt;
    return arm + " is stopped: resume it, and its own job will move it away";
  }
  const std::string begins = arm + (stopped ? " is stopped and has no job: " : " has no job: ");
  const OnIdleBlocker setting = cell.scheduling.on_idle_blocker;
  if (setting == OnIdleBlocker::report) {
    return begins + (stopped ? "resume it and " : "") + "move it away with another job, or " +
           to_send_aside("it") + (stopped ? " when it is resumed" : "");
  }
  const std::string none = "no free retreat was found (" + ways_aside(cell) + "); ";
  if (in_vain && !stopped)
    return begins + none + "moving it away with another job would have unblocked this one";
  if (wait.has_no_way_aside && !stopped) {
    return begins + none + "move it away with another job to unblock this one" +
           (setting == OnIdleBlocker::park
                ? ", or set \"on_idle_blocker\": \"replan\", so that retreats are planned"
                : "");
  }
  return begins + (stopped ? "when it is resumed " : "") + "it retreats if a path is free (" +
         ways_aside(cell) + "); otherwise move it away with another job to unblock this one";
}

// Hint on how to unblock a job that waits for an object or a fixed link.
std::string opens(const Proximity& proximity, Duration own_time, const Cell& cell) {
  const auto link_a = cell.find_link(proximity.body_a), link = cell.find_link(proximity.body_b);
  if (link_a && link && cell.is_own(*link_a, *link)) {
    return "both links are of the same arm: change the trajectory to unblock this job";
  }
  std::string text = proximity.body_b + " does not move: change the trajectory" +
                     (link ? "" : ", or move or delete the object,") + " to unblock this job";
  if (own_time > Duration{} || (link_a && link)) return text;
  // For example after a restart, which ends the contact that steps allowed.
  if (!link_a) return text + "; if " + proximity.body_a + " rests there, begin with a detach step";
  return text + "; if the hand is at " + proximity.body_b +
         ", begin with an attach and a detach step";
}

// "a -> b -> a: each waits for the next one, so none can move", and how to avoid it.
std::string deadlock_text(const std::vector<std::string>& cycle, const Cell& cell) {
  if (cycle.size() == 1) {
    return "motions of " + cycle.front() +
           " wait for each other, so none can move: change its steps " +
           "so that each arm leaves before another one comes, or " + to_send_aside("an arm");
  }
  std::string text;
  for (const std::string& key : cycle) text += key + " -> ";
  text += cycle.front() + ": each waits for the next one, so none can move; submit a job before " +
          "them that moves an arm out of the others' paths, or ";
  if (cell.scheduling.on_idle_blocker == OnIdleBlocker::report) {
    return text + to_send_aside("an arm");
  }
  return text + "clear a retreat for one of the arms: none was free (" + ways_aside(cell) + ")";
}

}  // namespace

WaitView view_of(const Wait& wait, const Cell& cell, const JobNames& names, bool in_vain) {
  WaitView view{.kind = wait.kind, .detail = wait.detail};
  if (wait.job) view.job = names.key(*wait.job);
  if (wait.kind == Wait::Kind::io) view.job = wait.signal;
  if (wait.arm) view.arm = cell.arm(*wait.arm).name;
  std::optional<std::string> opening;
  if (wait.kind == Wait::Kind::arm && wait.arm) opening = opens(wait, in_vain, cell, names);
  if (wait.kind == Wait::Kind::object && wait.proximity)
    opening = opens(*wait.proximity, wait.own_time, cell);
  if (wait.kind == Wait::Kind::predecessor && wait.proximity) {
    opening = "this job would end in the path of " + view.job + ", so that job goes first";
  }
  if (opening) view.detail += (view.detail.empty() ? "" : "; ") + *opening;
  if (wait.proximity) {
    view.links = {wait.proximity->body_a, wait.proximity->body_b};
    view.own_time_s = to_seconds(wait.own_time);
    view.clearance_m = wait.proximity->clearance_m;
    const bool of_job = wait.kind == Wait::Kind::job || wait.kind == Wait::Kind::predecessor;
    if (of_job) view.other_time_s = to_seconds(wait.other_time);
  }
  return view;
}

namespace {

const char* why_first(const Step& step, std::size_t among) {
  if (among == 1) return "no other candidate is possible";
  return step.goal ? "no other candidate arrives sooner"
                   : "no other candidate makes the plan shorter";
}

ChoiceView view_of(const Step& step, const Choice& choice, const Cell& cell,
                   const JobNames& names) {
  ChoiceView view;
  for (JobId other : choice.jobs) view.candidates.push_back(names.key(other));
  for (ArmId arm : choice.arms) view.candidates.push_back(cell.arm(arm).name);
  const bool by_arm = !choice.arms.empty();
  view.selected = by_arm ? cell.arm(step.trajectory->arms().front()).name : names.key(step.id.job);
  const std::string& first = view.candidates.front();
  if (view.selected == first) {
    view.detail = why_first(step, view.candidates.size());
  } else if (!choice.saves) {
    view.detail = first + " was not possible at the time";
  } else {
    view.time_saved_s = to_seconds(*choice.saves);
    char text[64];
    std::snprintf(
        text, sizeof text,
        step.goal ? "it arrives %.2f s sooner than " : "the plan costs %.2f s less than with ",
        *view.time_saved_s);
    view.detail = text + first;
  }
  for (const Choice::Without& other : choice.without) {
    const std::string& name = cell.arm(other.arm).name;
    view.candidates.push_back(name);
    view.detail += "; " + name + " cannot: " + other.why;
  }
  return view;
}

DetourView view_of(const Detour& detour) {
  DetourView view{.candidates_evaluated = static_cast<std::uint64_t>(detour.request.tries),
                  .is_selected = detour.is_taken,
                  .time_saved_s = {}};
  if (detour.saves > Duration{}) view.time_saved_s = to_seconds(detour.saves);
  return view;
}

// A job that continues after a pause is scheduled again. Clients see the first start.
std::optional<TimePoint> first_scheduled(const StepTimes& times) {
  if (!times.scheduled_at || !times.started_at) return times.scheduled_at;
  return std::min(*times.scheduled_at, *times.started_at);
}

JobTimesView times_of(const Step& step) {
  return {.submitted_at = step.job->submitted_at,
          .backlogged_at = step.times.backlogged_at,
          .scheduled_at = first_scheduled(step.times),
          .started_at = step.times.started_at,
          .ended_at = step.ended_at()};
}

JobMotionView motion_of(const Step& step) {
  const Duration duration = step.trajectory->duration();
  const bool is_retimed = !step.goal && !step.job->system_job && step.trajectory->timed_here();
  const auto* braking = step.in<Braking>();
  return {.duration = duration,
          .planned = step.goal ? std::optional(!step.is_unplanned()) : std::nullopt,
          .retimed = is_retimed ? std::optional(true) : std::nullopt,
          .velocity_scaling = step.goal
                                  ? std::optional(step.goal->ways[step.goal->taken].goal.speed)
                                  : std::nullopt,
          .progress = to_seconds(step.progress) / to_seconds(duration),
          .stopping = braking != nullptr,
          .ends_at_rest = braking != nullptr && braking->after.ends()};
}

JobWaysView ways_of(const Step& step, const Cell& cell, const JobNames& names) {
  JobWaysView ways;
  for (const TrajectoryPtr& other : step.alternatives) {
    ways.alternatives.push_back(cell.arm(other->arms().front()).name);
  }
  if (step.goal && step.goal->ways.size() > 1 && ways.alternatives.empty()) {
    for (const GoalWay& way : step.goal->ways) {
      ways.alternatives.push_back(cell.arm(way.goal.arm).name);
    }
  }
  if (step.choice) ways.choice = view_of(step, *step.choice, cell, names);
  if (step.goal && step.goal->detour) ways.detour = view_of(*step.goal->detour);
  if (const auto& other = step.another_way) {
    ways.another_way = AnotherWayView{other->done, other->is_open && !step.has_ended(),
                                      other->cause, other->refusal};
  }
  return ways;
}

std::vector<std::string> ring_of(const Step& step, const JobNames& names) {
  std::vector<std::string> cycle;
  for (JobId on_it : step.job->ring) {
    const std::string key = names.key(on_it);
    cycle.push_back(key.empty() ? "this job" : key);  // a job in a query
  }
  // Motions of one job are told as one.
  const auto same = std::ranges::unique(cycle);
  cycle.erase(same.begin(), same.end());
  if (cycle.size() > 1 && cycle.back() == cycle.front()) cycle.pop_back();
  return cycle;
}

// Precondition: the job has ended. `waits`: as published.
JobResultView result_of(const Step& step, const std::vector<WaitView>& waits, const Cell& cell,
                        const JobNames& names) {
  JobResultView result{*step.reason(), step.detail()};
  // A move-to-start ends with its job, and is in no cycle itself.
  if (result.reason == Reason::deadlock && !step.job->ring.empty()) {
    result.detail = deadlock_text(ring_of(step, names), cell);
  }
  if (result.reason != Reason::backlog_timeout) return result;
  for (const WaitView& wait : waits) {
    if (wait.kind != Wait::Kind::arm && wait.kind != Wait::Kind::object) continue;
    if (result.detail.find(wait.detail) == result.detail.npos) result.detail += "; " + wait.detail;
  }
  return result;
}

}  // namespace

JobView view_of(const Step& step, const Cell& cell, const JobNames& names) {
  JobView view{.id = step.id.job,
               .key = names.key(step.id.job),
               .name = names.name(step.id.job),
               .state = step.pausing() ? JobState::paused : step.state(),
               .terms = step.job->terms,
               .system_job = step.job->system_job,
               .times = times_of(step),
               .motion = motion_of(step),
               .ways = ways_of(step, cell, names)};
  view.arms = each_name(cell, step.trajectory->arms());
  const bool in_vain = step.reason() == Reason::backlog_timeout;
  for (const Wait& wait : step.waits_on) {
    view.waits_on.push_back(view_of(wait, cell, names, in_vain));
  }
  if (step.starvation) {
    view.starvation =
        StarvationView{step.starvation->waits_since, to_seconds(cell.scheduling.aging),
                       step.starvation->overtaken_by};
  }
  view.cycle = ring_of(step, names);
  if (step.reason()) view.result = result_of(step, view.waits_on, cell, names);
  return view;
}

CheckView view_of(const Trial::Outcome& outcome, const Cell& cell, const JobNames& names) {
  CheckView view{.kind = outcome.kind, .scene_version = 0};
  if (outcome.approach) view.move_to_start_s = to_seconds(*outcome.approach);
  const Step& step = *outcome.step;
  if (step.goal && step.choice) view.choice = view_of(step, *step.choice, cell, names);
  if (outcome.starts_in) view.earliest_start_s = to_seconds(*outcome.starts_in);
  if (outcome.clearance_bound) {
    view.clearance_bound_m = outcome.clearance_bound->apart_m;
    view.self_clearance_bound_m = outcome.clearance_bound->self_m;
  }
  view.evaluations = outcome.evaluations;
  for (Wait wait : outcome.waits) {
    if (wait.job && outcome.added.contains(*wait.job)) {
      wait.job.reset();
      wait.detail = "a motion that the server would add and run first";
    }
    view.waits_on.push_back(view_of(wait, cell, names));
  }
  if (view.kind != Verdict::Kind::free) view.conflicts = view.waits_on;
  if (step.has_ended()) view.result = result_of(step, view.waits_on, cell, names);
  return view;
}

namespace {

std::optional<double> smaller(const std::optional<double>& a, const std::optional<double>& b) {
  return a && b ? std::optional(std::min(*a, *b)) : std::nullopt;
}

}  // namespace

void add_step(CheckView& all, CheckView one, std::size_t step, bool is_first) {
  one.scene_version = all.scene_version;
  if (one.kind != Verdict::Kind::free) one.step = step;
  if (one.result) one.result->step = step;
  if (!is_first) {
    one.earliest_start_s = all.earliest_start_s;
    one.move_to_start_s = all.move_to_start_s;
    one.evaluations += all.evaluations;
    one.clearance_bound_m = smaller(one.clearance_bound_m, all.clearance_bound_m);
    one.self_clearance_bound_m = smaller(one.self_clearance_bound_m, all.self_clearance_bound_m);
    if (one.kind == Verdict::Kind::free) one.waits_on = std::move(all.waits_on);
  }
  all = std::move(one);
}

CheckView failed_step(const Problems& problems) {
  CheckView view{.kind = Verdict::Kind::conflict};
  view.result = {Reason::step_failed, problems.front().detail};
  return view;
}

}  // namespace armloom
