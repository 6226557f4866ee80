// The lanes of the arms: where each will stand, and the sequence in which all that waits can be
// done.
#include <algorithm>
#include <utility>

#include "core/scheduler/scheduler.h"

namespace armloom {
namespace {

// Of one arm's joints, in its order.
Eigen::VectorXd part_of(const Arm& arm, const Configuration& q) {
  Eigen::VectorXd part(static_cast<Eigen::Index>(arm.joints.size()));
  for (std::size_t j = 0; j < arm.joints.size(); ++j) {
    part[static_cast<Eigen::Index>(j)] = q[static_cast<Eigen::Index>(arm.joints[j].index())];
  }
  return part;
}

// The same of a position of the trajectory's joints, which names all of the arm's.
Eigen::VectorXd part_of(const Arm& arm, const Trajectory& trajectory,
                        const Eigen::VectorXd& position) {
  Eigen::VectorXd part(static_cast<Eigen::Index>(arm.joints.size()));
  const auto& joints = trajectory.joints();
  for (std::size_t j = 0; j < arm.joints.size(); ++j) {
    part[static_cast<Eigen::Index>(j)] =
        position[std::ranges::find(joints, arm.joints[j]) - joints.begin()];
  }
  return part;
}

bool waits_in_queue(const Job& job) {
  return job.state == JobState::queued || job.state == JobState::backlogged;
}

}  // namespace

// The last job of an arm says where it ends.
Configuration Scheduler::predicted_rest() const {
  Configuration q = rest_;
  for (std::size_t arm = 0; arm < order_.size(); ++arm) {
    if (order_[arm].empty()) continue;
    const Trajectory& last = *records_.at(order_[arm].back()).job.trajectory;
    for (std::size_t j = 0; j < last.joints().size(); ++j) {
      const JointId joint = last.joints()[j];
      if (cell_->joint(joint).arm != ArmId{static_cast<std::uint32_t>(arm)}) continue;
      q[static_cast<Eigen::Index>(joint.index())] = last.goal()[static_cast<Eigen::Index>(j)];
    }
  }
  return q;
}

WaitingLeg Scheduler::leg_of(const Job& job) {
  WaitingLeg leg{.job = job.id, .arms = job.trajectory->arms(), .from = {}, .to = {}};
  const Trajectory& motion = *job.trajectory;
  for (ArmId arm : leg.arms) {
    const Arm& moved = cell_->arm(arm);
    leg.from.push_back(places_.of(arm, part_of(moved, motion, motion.start())));
    leg.to.push_back(places_.of(arm, part_of(moved, motion, motion.goal())));
  }
  return leg;
}

void Scheduler::rest_where_it_stands(ArmId arm) {
  rests_at_[arm.index()] = places_.of(arm, part_of(cell_->arm(arm), rest_));
}

// At its goal, it counts as standing exactly there.
void Scheduler::rest_at_goal(const Record& record) {
  for (std::size_t i = 0; i < record.leg.arms.size(); ++i) {
    rests_at_[record.leg.arms[i].index()] = record.leg.to[i];
  }
}

// What waits in the queue is a leg; what is admitted, held on its path or not, will come to its
// end; what ended elsewhere leaves its arms where they stand.
void Scheduler::follow_lanes(const Job& job, JobState before) {
  const bool waited = before == JobState::queued || before == JobState::backlogged;
  if (waited && is_terminal(job.state)) {
    if (!sequence_.remove(job.id)) lanes_changed_ = true;
  } else if (!waited && (waits_in_queue(job) ||
                         (is_terminal(job.state) && job.state != JobState::succeeded))) {
    lanes_changed_ = true;
  }
}

void Scheduler::renew_lanes() {
  if (!std::exchange(lanes_changed_, false)) return;
  std::vector<PlacePtr> stands = rests_at_;
  std::set<JobId> waiting_jobs;
  for (const auto& queue : order_) {
    for (JobId id : queue) {
      const Record& record = records_.at(id);
      if (waits_in_queue(record.job)) {
        waiting_jobs.insert(id);
        continue;
      }
      for (std::size_t i = 0; i < record.leg.arms.size(); ++i) {
        stands[record.leg.arms[i].index()] = record.leg.to[i];
      }
    }
  }
  std::vector<WaitingLeg> legs;
  for (JobId id : in_turn(waiting_jobs)) {
    const Record& record = records_.at(id);
    WaitingLeg& leg = legs.emplace_back(record.leg);
    leg.after = record.job.after;
    if (record.lets_pass && active_.contains(*record.lets_pass)) {
      leg.after.push_back(*record.lets_pass);
    }
    leg.stopped = stop_of(record).has_value();
  }
  sequence_.renew(std::move(stands), legs);
}

// ---- Admission ----

// Whether these may be asked about, or admitted: a sequence of all else remains. Not where jobs are
// on their paths: they are admitted already.
SafeSequence::Outlook Scheduler::outlook_after(const std::vector<JobId>& jobs) {
  for (JobId id : jobs) {
    if (!waits_in_queue(records_.at(id).job)) return {};
  }
  renew_lanes();
  return sequence_.after(jobs);
}

bool Scheduler::waits_for_sequence(JobId job) {
  const auto outlook = outlook_after({job});
  if (outlook.first) wait_in_turn(records_.at(job), *outlook.first);
  return outlook.first.has_value();
}

// Not the backlog: it could go, or soon could, but for those that have to come before it.
void Scheduler::wait_in_turn(Record& record, JobId first) {
  if (record.job.state == JobState::backlogged) {
    set_state(record, JobState::queued);
    record.job.backlogged_at.reset();
    changed(record);
  }
  record.judged_at = version_;
  record.found = {Wait{.kind = Wait::Kind::order, .job = first}};
  if (!record.ages_from) record.ages_from = now_;
  set_waits(record, record.found);
}

// Whether the jobs go; else they wait, or what has to be known is asked.
bool Scheduler::leaves_a_sequence(const std::vector<JobId>& jobs) {
  const auto outlook = outlook_after(jobs);
  if (!outlook.unknown.empty()) {
    ask(jobs, Purpose::start);
  } else if (outlook.first && jobs.size() > 1) {
    put_off(records_.at(jobs.front()), records_.at(jobs.front()).found);  // not so
  } else if (outlook.first) {
    wait_in_turn(records_.at(jobs.front()), *outlook.first);
  } else {
    return true;
  }
  return false;
}

void Scheduler::add_passages(Question& question, std::vector<Passage> unknown) {
  for (const Passage& passage : unknown) {
    question.passages.push_back({Motion{.job = passage.leg,
                                        .trajectory = records_.at(passage.leg).job.trajectory,
                                        .progress = Duration{},
                                        .to_come = true},
                                 passage.place->arm, passage.place->q});
  }
  open_->passages = std::move(unknown);
}

// Whatever has become of the question since: what legs and places do to each other stays.
void Scheduler::learn(const OpenQuestion& question, const Verdict& verdict) {
  for (std::size_t i = 0; i < question.passages.size(); ++i) {
    const Passage& passage = question.passages[i];
    const PassageAnswer answer =
        verdict.passages.empty() ? PassageAnswer::free : verdict.passages[i];
    sequence_.learn(passage, answer != PassageAnswer::blocked);
    if (answer != PassageAnswer::apart) continue;
    const auto leg = records_.find(passage.leg);
    if (leg == records_.end()) continue;
    for (ArmId arm : leg->second.leg.arms) sequence_.learn_apart(arm, passage.place->arm);
  }
}

// Found in its way when it was judged: an arm that rests without anything admitted.
void Scheduler::learn_in_the_way(JobId job, ArmId arm) {
  const auto& queue = order_[arm.index()];
  const bool rests = queue.empty() || waits_in_queue(records_.at(queue.front()).job);
  if (rests && !lanes_changed_) sequence_.learn({job, rests_at_[arm.index()]}, false);
}

}  // namespace armloom
