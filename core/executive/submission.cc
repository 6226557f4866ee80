// What clients ask for: jobs and batches.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "core/base/told.h"
#include "core/base/whole_turns.h"
#include "core/executive/executive_impl.h"
#include "core/scheduler/sequence/places.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

Problems prefixed(const std::string& prefix, Problems problems) {
  for (Problem& problem : problems) problem.pointer.insert(0, prefix);
  return problems;
}

// Each moves one arm, not another one's, and leaves it where it was: so the next job of an arm that
// does not get this one can begin there.
void find_bad_alternatives(const Cell& cell, const std::vector<TrajectoryPtr>& motions,
                           Problems& problems) {
  std::vector<ArmId> arms;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const Trajectory& motion = *motions[i];
    const std::string place = "/alternatives/" + std::to_string(i);
    const ArmId arm = motion.arms().front();
    const std::string& name = cell.arm(arm).name;
    if (motion.arms().size() > 1 || std::ranges::find(arms, arm) != arms.end()) {
      problems.push_back({ProblemKind::invalid, "bad-alternative", place + "/joint_names",
                          "each alternative moves one arm, that no other alternative moves", name});
    }
    arms.push_back(arm);
    for (std::size_t j = 0; j < motion.joints().size(); ++j) {
      const auto index = static_cast<Eigen::Index>(j);
      const double off = motion.goal()[index] - motion.start()[index];
      if (std::abs(off) <= Places::kRounding) continue;
      problems.push_back({ProblemKind::invalid, "alternative-ends-elsewhere",
                          place + "/points/" + std::to_string(motion.segments().size()) +
                              "/positions/" + std::to_string(j),
                          cell.joint(motion.joints()[j]).name +
                              ": an alternative has to end where it begins, as the next job of " +
                              name + " cannot know whether it is taken",
                          motion.goal()[index]});
    }
  }
}

Problem key_in_use(const std::string& key) {
  return Problem{ProblemKind::conflict, "id-in-use", "/id",
                 "id \"" + key + "\" is in use by another job", key};
}

}  // namespace

Result<JobView> Executive::Impl::submit(JobRequest request) {
  Ahead ahead = ahead_now();
  auto prepared = prepare(std::move(request), ahead);
  if (!prepared) return failure(std::move(prepared.error()));
  ways_back_ = std::move(ahead.ways_back);
  return accept(std::move(*prepared));
}

Executive::Impl::Ahead Executive::Impl::ahead_now() const {
  return {scheduler_.predicted_rest(), {}, ways_back_, scheduler_.open_ends()};
}

Result<std::vector<Result<JobView>>> Executive::Impl::submit_batch(std::vector<JobRequest> requests,
                                                                   bool atomic) {
  std::vector<Result<JobView>> answers;
  if (!atomic) {
    for (JobRequest& request : requests) answers.push_back(submit(std::move(request)));
    return answers;
  }
  Ahead ahead = ahead_now();
  std::vector<Prepared> all;
  Problems problems;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    auto prepared = prepare(std::move(requests[i]), ahead);
    if (prepared) {
      all.push_back(std::move(*prepared));
    } else {
      for (Problem& p : prefixed("/jobs/" + std::to_string(i), std::move(prepared.error()))) {
        problems.push_back(std::move(p));
      }
    }
  }
  if (!problems.empty()) return failure(std::move(problems));
  ways_back_ = std::move(ahead.ways_back);
  for (Prepared& prepared : all) answers.push_back(accept(std::move(prepared)));
  return answers;
}

// Everything that can be said against a request, before anything is stored. `ahead` then holds what
// the next request of a batch finds.
Result<Executive::Impl::Prepared> Executive::Impl::prepare(JobRequest request, Ahead& ahead) const {
  if (wound_down_) {
    return failure(Problem{ProblemKind::unavailable, "server-ends", "",
                           "the server is ending and accepts no job"});
  }
  if (scheduler_.active().size() + ahead.keys.size() >= options_.waiting_max) {
    return failure(Problem{
        ProblemKind::unavailable, "queue-full", "",
        "the queue is full: " + std::to_string(options_.waiting_max) + " jobs have not ended"});
  }
  Problems problems;
  std::vector<TrajectoryPtr> returns;
  const bool taken =
      ids_.contains(request.key) || std::ranges::find(ahead.keys, request.key) != ahead.keys.end();
  if (!request.key.empty() && taken) problems.push_back(key_in_use(request.key));
  find_bad_after(request, ahead, problems);
  std::optional<MotionGoal> goal;
  std::vector<TrajectoryPtr> motions;
  if (!request.move_to && !request.arm.empty()) {
    problems.push_back({ProblemKind::invalid, "unknown-field", "/arm",
                        "an arm is named with move_to; a trajectory's joints say which arms move",
                        request.arm});
  }
  if (request.approach == Approach::plan && (request.move_to || request.motions().size() > 1)) {
    problems.push_back({ProblemKind::invalid, "not-served", "/approach",
                        "a goal's way begins where the arm stands, and alternatives end where they "
                        "begin: neither has an approach",
                        to_string(request.approach)});
  }
  if (request.move_to) {
    goal = read_goal(request, problems);
    if (goal && problems.empty()) motions.push_back(estimate_for(*goal, ahead));
  } else {
    motions = read_motions(request, ahead, returns, problems);
  }
  if (!problems.empty()) return failure(std::move(problems));

  set_joints(ahead.rest, *motions.front(), motions.front()->goal());
  ahead.keys.push_back(request.key);
  return Prepared{std::move(request.key),
                  std::move(request.name),
                  std::move(motions),
                  std::move(goal),
                  request.order,
                  request.on_timeout,
                  request.approach,
                  request.priority,
                  request.backlog_timeout.value_or(cell_->scheduling.backlog_timeout),
                  std::move(request.after),
                  std::move(returns)};
}

// Its trajectory, or its alternatives; and what has to move first so that they can begin.
std::vector<TrajectoryPtr> Executive::Impl::read_motions(const JobRequest& request, Ahead& ahead,
                                                         std::vector<TrajectoryPtr>& returns,
                                                         Problems& problems) const {
  std::vector<TrajectoryPtr> motions;
  for (const auto& [place, asked] : request.motions()) {
    auto motion = validate(asked, *cell_);
    Problems found = motion ? Problems{} : std::move(motion.error());
    if (motion) {
      begin_where_open(**motion, ahead);
      for (TrajectoryPtr& back : returns_for(**motion, ahead)) returns.push_back(std::move(back));
      const bool begins_anywhere = ahead.begins_anywhere || request.approach == Approach::plan;
      if (!begins_anywhere) find_start_elsewhere(*cell_, **motion, ahead.rest, found);
      motions.push_back(std::move(*motion));
    }
    for (Problem& p : prefixed(place, std::move(found))) problems.push_back(std::move(p));
  }
  if (problems.empty() && motions.size() > 1) find_bad_alternatives(*cell_, motions, problems);
  return motions;
}

// Where it is not known yet where an arm will be, it is taken to be where the motion begins; at its
// turn that is seen.
void Executive::Impl::begin_where_open(const Trajectory& motion, Ahead& ahead) const {
  for (std::size_t j = 0; j < motion.joints().size(); ++j) {
    const JointId joint = motion.joints()[j];
    const auto arm = cell_->joint(joint).arm;
    if (!arm || std::ranges::find(ahead.open, *arm) == ahead.open.end()) continue;
    ahead.rest[static_cast<Eigen::Index>(joint.index())] =
        motion.start()[static_cast<Eigen::Index>(j)];
  }
  for (ArmId arm : motion.arms()) std::erase(ahead.open, arm);
}

// A job can only come after one that is known before it: so there are no rings.
void Executive::Impl::find_bad_after(const JobRequest& request, const Ahead& ahead,
                                     Problems& problems) const {
  for (std::size_t i = 0; i < request.after.size(); ++i) {
    const std::string& key = request.after[i];
    const std::string pointer = "/after/" + std::to_string(i);
    if (!key.empty() && std::ranges::find(ahead.keys, key) != ahead.keys.end()) continue;
    if (std::ranges::find(request.succeeded, key) != request.succeeded.end()) continue;
    if (key == request.key) {
      problems.push_back({ProblemKind::invalid, "after-itself", pointer,
                          "job \"" + key + "\" cannot come after itself", key});
    } else if (const auto it = ids_.find(key); it == ids_.end()) {
      problems.push_back({ProblemKind::invalid, "unknown-job", pointer,
                          "no job before this one has the id \"" + key + "\"", key});
    } else if (const Job& job = *scheduler_.find(it->second);
               job.has_ended() && job.state() != JobState::succeeded) {
      problems.push_back(
          {ProblemKind::invalid, "predecessor-failed", pointer,
           "job \"" + key + "\" has ended without success: " + to_string(job.state()), key});
    }
  }
}

void find_start_elsewhere(const Cell& cell, const Trajectory& trajectory, const Configuration& rest,
                          Problems& problems) {
  for (std::size_t j = 0; j < trajectory.joints().size(); ++j) {
    const Joint& joint = cell.joint(trajectory.joints()[j]);
    const double begins = trajectory.start()[static_cast<Eigen::Index>(j)];
    const double stands = rest[static_cast<Eigen::Index>(trajectory.joints()[j].index())];
    if (std::abs(begins - stands) <= cell.execution.start_tolerance_rad) continue;
    char text[256];
    std::snprintf(text, sizeof text,
                  "waypoint 0, %s: begins at %.6g, but will stand at %.6g when the jobs accepted "
                  "for the arm have run",
                  joint.name.c_str(), told(begins), told(stands));
    std::string detail = text;
    if (joint.kind != JointKind::prismatic)
      detail += whole_turns_apart(stands, begins, cell.execution.start_tolerance_rad);
    problems.push_back({ProblemKind::invalid, "start-mismatch",
                        "/points/0/positions/" + std::to_string(j), std::move(detail), begins});
  }
}

JobView Executive::Impl::accept(Prepared prepared) {
  for (TrajectoryPtr& back : prepared.returns) {
    std::string name = cell_->arm(back->arms().front()).name + " returns to where it was left";
    Submit way = return_of(std::move(back), prepared.priority);
    way.job = next_job();
    enter(std::move(way), {own_key("aside-", next_aside_), std::move(name)});
  }
  const JobId id = next_job();
  Label label{std::move(prepared.key), std::move(prepared.name)};
  if (label.key.empty()) label.key = free_key(id);
  Submit submitted = submission(std::move(prepared));
  submitted.job = id;
  enter(std::move(submitted), std::move(label));
  return view(*scheduler_.find(id));
}

JobId Executive::Impl::next_job() const {
  return std::max(scheduler_.next_job(), options_.first_job);
}

void Executive::Impl::enter(Submit submitted, Label label) {
  this->label(submitted.job, std::move(label));
  step(submitted);
}

void Executive::Impl::label(JobId id, Label label) {
  ids_.emplace(label.key, id);
  labels_.emplace(id, std::move(label));
  ++active_;
}

Submit Executive::Impl::submission(Prepared prepared) const {
  std::vector<JobId> after;
  for (const std::string& before : prepared.after) {
    const auto job = ids_.find(before);
    if (job == ids_.end()) continue;  // it is known to have succeeded
    if (!is_terminal(scheduler_.find(job->second)->state())) after.push_back(job->second);
  }
  Submit job{.job = JobId{0},
             .trajectory = prepared.alternatives.front(),
             .priority = prepared.priority,
             .backlog_timeout = prepared.backlog_timeout,
             .after = std::move(after),
             .any_order = prepared.order == JobOrder::any,
             .goal = std::move(prepared.goal),
             .replans_on_timeout = prepared.on_timeout == OnTimeout::replan,
             .approaches = prepared.approach == Approach::plan};
  if (prepared.alternatives.size() > 1) job.alternatives = std::move(prepared.alternatives);
  return job;
}

// "job-17"; where a client has taken that name, "job-17.2", ...
std::string Executive::Impl::free_key(JobId id) const {
  const std::string base = "job-" + std::to_string(id.value());
  std::string key = base;
  for (int n = 2; ids_.contains(key); ++n) key = base + "." + std::to_string(n);
  return key;
}

}  // namespace armloom
