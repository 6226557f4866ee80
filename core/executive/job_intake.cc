#include "core/executive/job_intake.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/base/add_below.h"
#include "core/executive/gripper_goal.h"
#include "core/executive/signals.h"
#include "core/executive/start_elsewhere.h"
#include "core/sequence/places.h"
#include "core/trajectory/implicit_start.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

// Each alternative moves one arm, a different one, and returns it to its start. So the arm's next
// job can begin there in any case.
void find_bad_alternatives(const Cell& cell, const std::vector<TrajectoryPtr>& motions,
                           Problems& problems) {
  std::vector<ArmId> arms;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const Trajectory& motion = *motions[i];
    const std::string place = "/alternatives/" + std::to_string(i);
    const ArmId arm = motion.arms().front();
    const std::string& name = cell.arm(arm).name;
    if (motion.arms().size() > 1 || std::ranges::find(arms, arm) != arms.end()) {
      problems.push_back(
          {ProblemKind::invalid, "bad-alternative", place + "/joint_names",
           "each alternative must move exactly one arm, and no two may move the same arm", name});
    }
    arms.push_back(arm);
    for (std::size_t j = 0; j < motion.joints().size(); ++j) {
      const auto index = static_cast<Eigen::Index>(j);
      const double off = motion.goal()[index] - motion.start()[index];
      if (std::abs(off) <= Places::kRounding) continue;
      problems.push_back(
          {ProblemKind::invalid, "alternative-ends-elsewhere",
           place + "/points/" + std::to_string(motion.segment_count()) + "/positions/" +
               std::to_string(j),
           cell.joint(motion.joints()[j]).name +
               ": an alternative must end where it begins, because the next job of " + name +
               " begins there whether or not this one is chosen",
           motion.goal()[index]});
    }
  }
}

// The arm that a trajectory's job names must be among those that move.
void find_other_arm(const Cell& cell, const std::string& name,
                    const std::vector<TrajectoryPtr>& motions, Problems& problems) {
  if (name.empty() || motions.empty()) return;
  const auto arm = cell.find_arm(name);
  const std::vector<ArmId>& moved = motions.front()->arms();
  if (arm && std::ranges::count(moved, *arm) > 0) return;
  problems.push_back({ProblemKind::invalid, "unknown-arm", "/arm",
                      arm ? "the trajectory moves " + cell.arm(moved.front()).name + ", not " +
                                name + ": correct or leave out \"arm\""
                          : "the cell has no arm \"" + name + "\"",
                      name});
}

bool is_too_fast(const Problems& problems) {
  return std::ranges::any_of(problems, [](const Problem& problem) {
    return problem.slug == "velocity-limit" || problem.slug == "acceleration-limit";
  });
}

Problem key_in_use(const std::string& key) {
  return Problem{
      ProblemKind::conflict, "id-in-use", "/id",
      "id \"" + key + "\" is in use by another job: give another one, or leave \"id\" out", key};
}

}  // namespace

std::size_t PreparedJob::bytes() const {
  std::size_t bytes = bytes_of(motion.alternatives);
  for (const PreparedStep& step : steps) {
    if (step.motion) bytes += bytes_of(step.motion->alternatives);
  }
  return bytes;
}

std::vector<ArmId> arms_of(const std::vector<PreparedJob::PreparedStep>& steps) {
  std::set<ArmId> arms;
  for (const PreparedJob::PreparedStep& step : steps) {
    if (!step.motion) continue;
    const std::vector<ArmId>& moved = step.motion->alternatives.front()->arms();
    arms.insert(moved.begin(), moved.end());
  }
  return {arms.begin(), arms.end()};
}

std::size_t bytes_of(const std::vector<TrajectoryPtr>& trajectories) {
  std::size_t bytes = 0;
  for (const TrajectoryPtr& trajectory : trajectories) bytes += trajectory->bytes();
  return bytes;
}

JobIntake::Ahead JobIntake::ahead() const {
  const State& state = scheduler_.state();
  return {predicted_rest(state), {}, state.arms.ways_back(), open_ends(state)};
}

Result<PreparedJob> JobIntake::prepare(JobRequest request, Ahead& ahead) const {
  if (is_closed_) {
    return failure(Problem{ProblemKind::unavailable, "server-ends", "",
                           "the server is ending and accepts no job"});
  }
  if (jobs_.active() + ahead.jobs >= active_max_.jobs) {
    return failure(
        Problem{ProblemKind::unavailable, "queue-full", "",
                "the queue is full: " + std::to_string(active_max_.jobs) + " jobs have not ended"});
  }
  Problems problems;
  const bool taken = jobs_.is_taken(request.key) || ahead.keys.contains(request.key);
  if (!request.key.empty() && taken) problems.push_back(key_in_use(request.key));
  find_bad_after(request, ahead, problems);
  if (const auto& when = request.terms.start_when) {
    auto bad = find_bad_value(cell_->io, when->signal, when->value, ProblemKind::invalid,
                              "/start_when/io", "/start_when/value");
    if (bad) problems.push_back(*std::move(bad));
  }
  PreparedMotion motion;
  std::vector<PreparedJob::PreparedStep> steps;
  if (request.steps.empty()) {
    motion = read_motion(request, ahead, problems);
    if (problems.empty()) find_hands_apart(request, motion, ahead, problems);
  } else {
    steps = read_steps(request, ahead, problems);
  }
  if (!problems.empty()) return failure(std::move(problems));
  PreparedJob prepared{.key = std::move(request.key),
                       .name = std::move(request.name),
                       .motion = std::move(motion),
                       .steps = std::move(steps),
                       .terms = request.terms,
                       .after = std::move(request.after)};
  const std::size_t bytes = ahead.bytes + prepared.bytes();
  if (auto problem = too_large(bytes)) return failure(*std::move(problem));

  ahead.bytes = bytes;
  ahead.keys.insert(prepared.key);
  ++ahead.jobs;
  return prepared;
}

PreparedMotion JobIntake::read_motion(const JobRequest& request, Ahead& ahead,
                                      Problems& problems) const {
  std::vector<MotionGoal> goals;
  std::vector<TrajectoryPtr> motions;
  if (!request.move_to && !request.arms.empty()) {
    problems.push_back({ProblemKind::invalid, "unknown-field", "/arms",
                        "\"arms\" names candidates for a \"move_to\"; the joints of a trajectory "
                        "say which arms move: leave out \"arms\"",
                        request.arms.front()});
  }
  if (request.terms.move_to_start == MoveToStart::plan &&
      (request.move_to || request.motions().size() > 1)) {
    problems.push_back(
        {ProblemKind::invalid, "not-served", "/move_to_start",
         "\"move_to_start\" applies only to a job with one trajectory: the path to a "
         "goal begins where the arm is, and alternatives must begin where it is",
         to_string(request.terms.move_to_start)});
  }
  if (moves_gripper_only(request, *cell_)) {
    motions = read_gripper_goal(request, ahead, problems);
  } else if (request.move_to) {
    goals = read_goals(request, problems);
    if (problems.empty()) motions = estimates_for(goals, ahead);
  } else {
    motions = read_motions(request, ahead, problems);
    find_other_arm(*cell_, request.arm, motions, problems);
  }
  if (!problems.empty()) return {};
  set_joints(ahead.rest, *motions.front(), motions.front()->goal());
  return {std::move(motions), std::move(goals)};
}

std::optional<Problem> JobIntake::too_large(std::size_t bytes) const {
  if (jobs_.active_bytes() + bytes <= active_max_.bytes) return std::nullopt;
  const auto kib = [](std::size_t n) { return std::to_string(n >> 10) + " KiB"; };
  return Problem{ProblemKind::unavailable, "trajectories-full", "",
                 "the trajectories of jobs that have not ended hold " + kib(jobs_.active_bytes()) +
                     ", and " + kib(bytes) + " more exceed " + kib(active_max_.bytes) +
                     ": send the job when others have ended, cancel some, or use fewer waypoints"};
}

// Returns its trajectory, or its alternatives.
std::vector<TrajectoryPtr> JobIntake::read_motions(const JobRequest& request, Ahead& ahead,
                                                   Problems& problems) const {
  std::vector<TrajectoryPtr> motions;
  const auto asked_for = request.motions();
  for (std::size_t i = 0; i < asked_for.size(); ++i) {
    const auto& [place, asked] = asked_for[i];
    const bool is_known = i < request.known.validated.size();
    auto motion = is_known ? request.known.validated[i] : validate_from(asked, ahead);
    Problems found = motion ? Problems{} : std::move(motion.error());
    if (motion) {
      *motion = with_whole_turns(*cell_, std::move(*motion), ahead.rest);
      begin_where_open(**motion, ahead);
      (void)ahead.ways_back.take(*cell_, **motion, ahead.rest);
      if (!ahead.begins_anywhere) {
        const bool is_moved = request.terms.move_to_start == MoveToStart::plan;
        find_start_elsewhere(*cell_, **motion, ahead.rest, found,
                             is_moved ? Compared::gripper_joints : Compared::all_joints);
      }
      motions.push_back(std::move(*motion));
    } else if (is_too_fast(found) && !ahead.begins_anywhere && !asked.retime &&
               request.terms.move_to_start != MoveToStart::plan &&
               !has_implicit_start(asked, *cell_)) {
      // A slower motion would not pass either.
      Problems elsewhere;
      find_start_elsewhere(*cell_, asked, ahead.rest, elsewhere);
      found.insert(found.begin(), elsewhere.begin(), elsewhere.end());
    }
    add_below(place, std::move(found), problems);
  }
  if (problems.empty() && motions.size() > 1) find_bad_alternatives(*cell_, motions, problems);
  return motions;
}

std::optional<Problem> JobIntake::unknown_start(ArmId arm, const Ahead& ahead) const {
  if (std::ranges::find(ahead.open, arm) == ahead.open.end()) return std::nullopt;
  const std::string& name = cell_->arm(arm).name;
  return Problem{ProblemKind::invalid, "unknown-start", "",
                 "the motion begins where " + name +
                     " will be, but this is not known before its last job is planned, or has come "
                     "to rest: send the job then, or give the start as a waypoint with time 0",
                 name};
}

Result<TrajectoryPtr> JobIntake::validate_from(const TrajectoryRequest& asked,
                                               const Ahead& ahead) const {
  if (!has_implicit_start(asked, *cell_)) return validate(asked, *cell_);
  for (const ArmId arm : arms_of(asked, *cell_)) {
    if (auto problem = unknown_start(arm, ahead)) return failure(*std::move(problem));
  }
  return armloom::validate_from(asked, *cell_, ahead.rest);
}

std::vector<TrajectoryPtr> JobIntake::read_gripper_goal(const JobRequest& request,
                                                        const Ahead& ahead,
                                                        Problems& problems) const {
  auto motion = gripper_motion(request, *cell_, ahead.rest);
  if (!motion) {
    add_below("", std::move(motion.error()), problems);
    return {};
  }
  if (auto problem = unknown_start((*motion)->arms().front(), ahead)) {
    add_below("/move_to", {*std::move(problem)}, problems);
  }
  return {*std::move(motion)};
}

// If an arm's position is not known yet, the motion's start is assumed, and checked at its turn.
void JobIntake::begin_where_open(const Trajectory& motion, Ahead& ahead) const {
  for (std::size_t j = 0; j < motion.joints().size(); ++j) {
    const JointId joint = motion.joints()[j];
    const auto arm = cell_->joint(joint).arm;
    if (!arm || std::ranges::find(ahead.open, *arm) == ahead.open.end()) continue;
    ahead.rest[static_cast<Eigen::Index>(joint.index())] =
        motion.start()[static_cast<Eigen::Index>(j)];
  }
  for (ArmId arm : motion.arms()) std::erase(ahead.open, arm);
}

// Jobs come only after known jobs, so `after` never forms a cycle.
void JobIntake::find_bad_after(const JobRequest& request, const Ahead& ahead,
                               Problems& problems) const {
  for (std::size_t i = 0; i < request.after.size(); ++i) {
    const std::string& key = request.after[i];
    const std::string pointer = "/after/" + std::to_string(i);
    if (!key.empty() && ahead.keys.contains(key)) continue;
    if (std::ranges::find(request.known.succeeded, key) != request.known.succeeded.end()) continue;
    if (key == request.key) {
      problems.push_back({ProblemKind::invalid, "after-itself", pointer,
                          "job \"" + key + "\" cannot come after itself", key});
    } else if (const auto known = jobs_.find(key); !known) {
      problems.push_back({ProblemKind::invalid, "unknown-job", pointer,
                          "no job before this one has the id \"" + key + "\"", key});
    } else if (const JobState state = jobs_.state(*known);
               is_terminal(state) && state != JobState::succeeded) {
      problems.push_back({ProblemKind::invalid, "predecessor-failed", pointer,
                          "job \"" + key + "\" has ended without success: " + to_string(state),
                          key});
    }
  }
}

std::vector<JobId> JobIntake::ids_of(const std::vector<std::string>& after) const {
  std::vector<JobId> ids;
  for (const std::string& before : after) {
    const auto job = jobs_.find(before);
    if (!job) continue;  // it is known to have succeeded
    const Task* task = tasks_.find(*job);
    const JobId last = task == nullptr ? *job : task->motions().back();
    if (!is_terminal(scheduler_.find(last)->state())) ids.push_back(last);
  }
  return ids;
}

Submit JobIntake::submission(PreparedJob prepared) const {
  const std::vector<JobId> after = ids_of(prepared.after);
  PreparedMotion& motion = prepared.motion;
  Submit job{.job = JobId{0},
             .trajectory = motion.alternatives.front(),
             .terms = prepared.terms,
             .goals = std::move(motion.goals),
             .after = after};
  if (motion.alternatives.size() > 1) job.alternatives = std::move(motion.alternatives);
  return job;
}

Submit JobIntake::submission(const PreparedJob& prepared, PreparedMotion motion,
                             std::optional<JobId> before) const {
  Submit job{.job = JobId{0},
             .trajectory = motion.alternatives.front(),
             .terms = prepared.terms,
             .goals = std::move(motion.goals)};
  if (!before) {
    job.after = ids_of(prepared.after);
    return job;
  }
  job.after = {*before};
  job.terms.start_when.reset();
  job.terms.move_to_start = MoveToStart::none;
  return job;
}

}  // namespace armloom
