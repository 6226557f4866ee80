#include "core/scheduler/yielding/yield_moves.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/jobs/standing.h"
#include "core/model/cell.h"
#include "core/scheduler/motion_questions.h"
#include "core/scheduler/ways/approach.h"
#include "core/scheduler/ways/path_requests.h"
#include "core/trajectory/joint_line.h"
#include "core/trajectory/joints_elsewhere.h"
#include "core/trajectory/set_joints.h"
#include "core/trajectory/trajectory.h"

namespace armloom {
namespace {

// Returns the arm's joints at `end`, the motion's start or goal. Joints that the motion does not
// move stay as in `here`.
Eigen::VectorXd end_of(const Trajectory& motion, const Eigen::VectorXd& end,
                       const std::vector<JointId>& joints, Eigen::VectorXd here) {
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const auto found = std::ranges::find(motion.joints(), joints[j]);
    if (found == motion.joints().end()) continue;
    here[static_cast<Eigen::Index>(j)] = end[found - motion.joints().begin()];
  }
  return here;
}

// Returns the ways by which the arm can make way for another one, in the order in which they are
// tried. All begin where the arm rests (`rest`: whole cell):
// - back along the motion that brought it here (`came_by`, may be null); if it stopped on that
//   motion, straight joint lines to the motion's start and goal
// - lines to its home and to the named poses of its group, except where it rests already
std::vector<TrajectoryPtr> ways_aside(const Cell& cell, ArmId arm, const Configuration& rest,
                                      const TrajectoryPtr& came_by) {
  std::vector<TrajectoryPtr> ways;
  const Arm& description = cell.arm(arm);
  const Eigen::VectorXd here = joints_of(rest, description.joints);
  const auto add = [&](const Eigen::VectorXd& pose) {
    if (pose.size() != here.size()) return;
    if (joints_elsewhere(cell, description.joints, pose, rest).empty()) return;
    if (auto line = joint_line(cell, description.joints, here, pose)) ways.push_back(*line);
  };
  if (came_by && joints_elsewhere(cell, came_by->joints(), came_by->goal(), rest).empty()) {
    ways.push_back(retraced(*came_by));
  } else if (came_by) {
    add(end_of(*came_by, came_by->start(), description.joints, here));
    add(end_of(*came_by, came_by->goal(), description.joints, here));
  }
  add(description.home);
  for (const auto& [name, pose] : description.named_states) add(pose);
  return ways;
}

// Limits the retreats for one client job and arm, so that arms do not move to and fro forever.
constexpr std::size_t kYieldsMax = 8;
// Limits the retreats to one place. Clients may have sent the arm back from there.
constexpr std::ptrdiff_t kSamePlaceMax = 2;
constexpr double kSamePlace = 1e-3;  // relative

// Returns true if the second motion, resting at `progress`, is in the way of the first, which takes
// `lasts`. The two may be close now if the first leaves the second for good.
bool rests_in(const PairRegions& pair, Duration progress, Duration lasts) {
  std::vector<std::pair<Duration, Duration>> close;  // when
  for (const ConflictRegion& region : pair.regions) {
    for (const ProgressBox& box : region.boxes) {
      const bool holds = box.from_b <= progress && progress <= box.to_b;
      if (holds) close.emplace_back(box.from_a, box.to_a);
    }
  }
  std::ranges::sort(close);
  Duration leaves{};
  for (const auto& [from, to] : close) {
    if (from > leaves) return true;
    leaves = std::max(leaves, to);
  }
  return leaves >= lasts;
}

bool has_been_there(const YieldsTried& tried, const Trajectory& way) {
  return std::ranges::count_if(tried.went_to, [&](const Eigen::VectorXd& goal) {
           return goal.size() == way.goal().size() && goal.isApprox(way.goal(), kSamePlace);
         }) >= kSamePlaceMax;
}

// Returns a retreat of this arm that has not been tried for the job. There is none for a job that
// helped an ended job.
std::optional<YieldTrial> untried(const State& state, const Step& step, ArmId arm) {
  if (state.cell->scheduling.on_idle_blocker == OnIdleBlocker::report ||
      state.arms.is_stopped(arm) || is_in(arm, state.around.shared_holds)) {
    return std::nullopt;
  }
  if (!state.jobs.active().contains(step.job->errand.on_behalf_of)) return std::nullopt;
  const YieldsTried& tried = tried_for(step, arm);
  const YieldsTried& of_all = tried_for(state.jobs.at(step.job->errand.on_behalf_of), arm);
  if (of_all.total >= kYieldsMax) return std::nullopt;
  const TrajectoryPtr& came_by = state.arms.came_by(arm);
  const auto ways = ways_aside(*state.cell, arm, state.arms.rest(), came_by);
  YieldTrial trial{.blocked_job = step.id.job, .arm = arm, .way = nullptr};
  const bool is_there_still = tried.from == came_by;
  for (trial.index = is_there_still ? tried.next : 0; trial.index < ways.size(); ++trial.index) {
    trial.way = ways[trial.index];
    if (!has_been_there(of_all, *trial.way)) return trial;
  }
  if (state.cell->scheduling.on_idle_blocker != OnIdleBlocker::replan) return std::nullopt;
  const bool is_planned = is_there_still && tried.planned.is_answered;
  trial.way = is_planned ? tried.planned.way : nullptr;
  if (!is_planned) return trial;
  const bool goes = trial.way && trial.index == ways.size() && !has_been_there(of_all, *trial.way);
  return goes ? std::optional(trial) : std::nullopt;
}

const std::vector<Wait>& waits_of(const Step& step) {
  return step.is_waiting() ? step.judgement().found : step.waits_on;
}

void tell_of_way_aside(Transitions& state, const Step& step, ArmId arm, bool has_none) {
  const auto* queued = step.in<Queued>();
  if (queued == nullptr || !queued->in_backlog) return;
  Judgement found = queued->judgement;
  for (Wait& wait : found.found)
    if (wait.kind == Wait::Kind::arm && wait.arm == arm) wait.has_no_way_aside = has_none;
  state.jobs().set_waits(step, found.found);
  state.jobs().set(step, std::move(found));
}

}  // namespace

const YieldsTried& tried_for(const Step& step, ArmId arm) {
  static const YieldsTried kUntried;
  const auto found = step.yields.find(arm);
  return found == step.yields.end() ? kUntried : found->second;
}

std::optional<YieldTrial> next_yield(Transitions& state) {
  if (state->cell->scheduling.on_idle_blocker == OnIdleBlocker::report) return std::nullopt;
  for (const Step& step : state->jobs.past_queue()) {
    const std::vector<Wait>* waits = known_waits(state, step);
    if (waits == nullptr || step.is_replanned_now()) continue;  // the new path may pass
    for (const Wait& wait : *waits) {
      if (!is_idle_arm(state, wait)) continue;
      auto move = untried(state, step, *wait.arm);
      const bool has_none = !move && !state->arms.is_stopped(*wait.arm);
      if (has_none != wait.has_no_way_aside) tell_of_way_aside(state, step, *wait.arm, has_none);
      if (move) return move;
    }
  }
  return std::nullopt;
}

std::optional<YieldTrial> yield_in(const State& state, const WaitCycle& ring) {
  const bool dispensable = std::ranges::any_of(ring, [&](JobId id) {
    const Step& step = state.jobs.at(id);
    return step.job->system_job && !is_counted_on(state, step);
  });
  if (dispensable) return std::nullopt;
  const WaitCycle from_last = beginning_with(*std::ranges::max_element(ring), ring);
  for (std::size_t i = 0; i < from_last.size(); ++i) {
    const Step& next = state.jobs.at(from_last[i]);
    const Step& waits = state.jobs.at(from_last[(i + from_last.size() - 1) % from_last.size()]);
    const bool may_go_later = !next.job->system_job || approached_job(state, next.id.job);
    if (!next.is_waiting() || next.has_started() || !may_go_later) continue;
    for (const Wait& wait : waits_of(waits)) {
      const bool near = wait.kind == Wait::Kind::arm || wait.kind == Wait::Kind::job;
      if (!near || !wait.arm) continue;
      const auto& queue = state.jobs.queues()[*wait.arm];
      if (queue.empty() || queue.front() != next.id) continue;
      auto move = untried(state, waits, *wait.arm);
      if (!move) continue;
      move->before = next.id.job;
      return move;
    }
  }
  return std::nullopt;
}

Question question_about(const State& state, const YieldTrial& move) {
  if (!move.is_free) {
    Question question = question_now(state, {});
    question.candidates = {Motion{StepId{JobId{0}}, move.way, Duration{}}};
    return question;
  }
  Question question = question_now(state, {only_step(move.blocked_job)});
  set_joints(question.rest, *move.way, move.way->goal());
  return question;
}

bool is_as_asked(const State& state, const YieldTrial& move) {
  if (!state.jobs.active().contains(move.blocked_job)) return false;
  const auto& queue = state.jobs.queues()[move.arm];
  return move.before ? !queue.empty() && queue.front().job == *move.before : queue.empty();
}

bool lets_through(const State& state, const Verdict& verdict, const YieldTrial& move) {
  const auto stays = [&](ArmId arm) {
    if (move.is_free) return arm == move.arm;
    const auto& queue = state.jobs.queues()[arm];
    if (queue.empty()) return false;  // it may retreat, too
    return queue.front().job == move.blocked_job ||
           (move.before && state.jobs.at(queue.front()).is_waiting());
  };
  for (const Conflict& conflict : verdict.conflicts) {
    if (conflict.with == Conflict::With::motion) continue;
    const bool at_rest = conflict.with == Conflict::With::rest && conflict.proximity.arm_b;
    if (!at_rest || stays(*conflict.proximity.arm_b)) return false;
  }
  return std::ranges::none_of(verdict.regions, [&](const PairRegions& pair) {
    const auto* arm = std::get_if<ArmId>(&pair.b);
    if (arm != nullptr) return stays(*arm);
    const bool of_it = !move.is_free && std::get<StepId>(pair.b).job == move.blocked_job;
    return of_it && rests_in(pair, state.jobs.at(move.blocked_job).progress, move.way->duration());
  });
}

void note_tried(Transitions& state, const YieldTrial& move, bool goes) {
  const Step& step = state->jobs.at(move.blocked_job);
  YieldsTried tried = tried_for(step, move.arm);
  tried.from = state->arms.came_by(move.arm);
  tried.next = move.index + 1;
  state.jobs().set(step, move.arm, std::move(tried));
  const Step* helped = state->jobs.find(step.job->errand.on_behalf_of);
  if (helped == nullptr || helped->has_ended()) return;
  YieldsTried of_all = tried_for(*helped, move.arm);
  ++of_all.total;
  if (goes) of_all.went_to.push_back(move.way->goal());
  state.jobs().set(*helped, move.arm, std::move(of_all));
}

void ask_for_way_aside(Transitions& state, const YieldTrial& move) {
  const Step& step = state->jobs.at(move.blocked_job);
  if (step.plans.is_open(ForRetreat{move.arm})) return;
  YieldsTried tried = tried_for(step, move.arm);
  tried.from = state->arms.came_by(move.arm);
  tried.next = move.index;
  tried.planned = {};
  state.jobs().set(step, move.arm, std::move(tried));
  (void)send(state, step, ForRetreat{move.arm}, {},
             {.goal = {.arm = move.arm, .to = ClearOf{step.trajectory, step.progress}},
              .at = rest_after_admitted(state),
              .seed = step.id.job.value()});
}

void take_way_aside(Transitions& state, const Step& step, ArmId arm, const PlanMade& answer) {
  YieldsTried tried = tried_for(step, arm);
  const bool is_there_still = tried.from == state->arms.came_by(arm);
  tried.planned = {.is_answered = is_there_still, .way = answer.trajectory};
  state.jobs().set(step, arm, std::move(tried));
}

bool is_counted_on(const State& state, const Step& own) {
  const ArmId arm = own.trajectory->arms().front();
  const auto& queue = state.jobs.queues()[arm];
  const auto of_a_client = [&](StepId step) { return !state.jobs.at(step).job->system_job; };
  const auto next = std::find_if(std::ranges::find(queue, own.id), queue.end(), of_a_client);
  if (next == queue.end()) return false;
  if (state.jobs.at(*next).goal) return false;  // begins wherever the arm stands
  if (own.has_started()) return true;
  return state.arms.begins_elsewhere(*state.cell, *state.jobs.at(*next).trajectory, arm);
}

}  // namespace armloom
