// Who may be judged next, and what is asked.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <utility>

#include "core/base/told.h"
#include "core/scheduler/scheduler.h"

namespace armloom {
namespace {

std::string format(const char* text, const std::string& name, double a, double b) {
  char buffer[256];
  std::snprintf(buffer, sizeof buffer, text, name.c_str(), a, b);
  return buffer;
}

}  // namespace

bool Scheduler::waiting(const Record& record) {
  const JobState state = record.job.state;
  return state == JobState::queued || state == JobState::backlogged ||
         (state == JobState::holding && !record.job.stopping);
}

bool Scheduler::holds_reservation(const Record& record) const {
  const JobState state = record.job.state;
  return state == JobState::scheduled || state == JobState::running ||
         (state == JobState::holding && record.job.stopping);
}

bool Scheduler::at_head(const Record& record) const {
  return record.job.after.empty() && !lets_another_pass(record) &&
         std::ranges::all_of(record.job.trajectory->arms(), [&](ArmId arm) {
           return order_[arm.index()].front() == record.job.id;
         });
}

std::vector<const Job*> Scheduler::occupying() const {
  std::vector<const Job*> jobs;
  for (JobId id : past_queue_) {
    const Record& record = records_.at(id);
    const bool held = record.job.state == JobState::holding;
    if (held || holds_reservation(record)) jobs.push_back(&record.job);
  }
  return jobs;
}

// ---- Who may be judged ----

std::optional<Wait> Scheduler::stop_of(const Record& record) const {
  for (ArmId arm : record.job.trajectory->arms()) {
    const auto& cause = stopped_[arm.index()];
    if (cause) return Wait{.kind = Wait::Kind::stop, .arm = arm, .detail = *cause};
  }
  return std::nullopt;
}

std::optional<Wait> Scheduler::capacity_of(const Record& record,
                                           const std::vector<const Job*>& occupying) const {
  if (policy_->in_rounds() && !round_.contains(record.job.id)) {
    if (round_.empty()) return std::nullopt;
    return Wait{.kind = Wait::Kind::capacity, .job = *round_.begin()};
  }
  std::optional<JobId> taken_by;
  if (record.job.state == JobState::holding) {
    std::vector<const Job*> others = occupying;
    std::erase(others, &record.job);
    taken_by = policy_->capacity_taken_by(others);
  } else {
    taken_by = policy_->capacity_taken_by(occupying);
  }
  if (!taken_by) return std::nullopt;
  return Wait{.kind = Wait::Kind::capacity, .job = *taken_by};
}

bool Scheduler::may_be_judged(const Record& record,
                              const std::vector<const Job*>& occupying) const {
  return waiting(record) && at_head(record) && !stop_of(record) && !capacity_of(record, occupying);
}

void Scheduler::set_waits(Record& record, std::vector<Wait> waits) {
  auto& old = record.job.waits_on;
  const bool same =
      std::ranges::equal(old, waits, [](const Wait& a, const Wait& b) { return a.same_cause(b); });
  old = std::move(waits);
  if (!same) changed(record);
}

// A round is over when all of its jobs have ended; until the first of them moves, arms that have no
// job in it may join. Where those that are left wait for arms that only a next job would move away,
// these jobs join too.
void Scheduler::form_round() {
  if (!policy_->in_rounds()) return;
  std::erase_if(round_, [this](JobId id) { return !active_.contains(id); });
  const bool stuck = std::ranges::all_of(round_, [this](JobId id) {
    const Record& record = records_.at(id);
    const bool tried = waiting(record) && (record.judged_at == version_ || !at_head(record));
    return tried || held_where_it_stands(record).has_value();
  });
  if (round_.empty()) round_begun_ = false;
  for (JobId id : round_) {
    if (records_.at(id).job.started_at) round_begun_ = true;
  }
  if (round_begun_ && !stuck) return;
  for (const auto& queue : order_) {
    if (queue.empty()) continue;
    const Record& record = records_.at(queue.front());
    if (waiting(record) && at_head(record) && !stop_of(record)) round_.insert(queue.front());
  }
}

// A job at the head of its arms that cannot begin where they stand will never be able to. The end
// of a job of several arms gives each of them a new head: hence until there are none.
void Scheduler::fail_impossible_starts() {
  for (std::size_t unchanged = 0, arm = 0; unchanged < order_.size();
       arm = (arm + 1) % order_.size()) {
    ++unchanged;
    if (order_[arm].empty()) continue;
    Record& head = records_.at(order_[arm].front());
    if (!waiting(head) || head.job.started_at || !at_head(head)) continue;
    if (auto mismatch = start_mismatch(*head.job.trajectory)) {
      end(head, JobState::failed, Reason::start_mismatch, std::move(*mismatch));
      unchanged = 0;
    }
  }
}

std::optional<std::string> Scheduler::start_mismatch(const Trajectory& trajectory) const {
  for (std::size_t j = 0; j < trajectory.joints().size(); ++j) {
    const JointId joint = trajectory.joints()[j];
    const double begins = trajectory.start()[static_cast<Eigen::Index>(j)];
    const double stands = rest_[static_cast<Eigen::Index>(joint.index())];
    if (std::abs(begins - stands) > cell_->execution.start_tolerance_rad) {
      return format("%s stands at %.6g, the trajectory begins at %.6g", cell_->joint(joint).name,
                    told(stands), told(begins));
    }
  }
  return std::nullopt;
}

std::optional<JobId> Scheduler::next_recheck() const {
  for (JobId id : past_queue_) {
    const Record& record = records_.at(id);
    if (holds_reservation(record) && record.checked_at < disturbed_at_) return id;
  }
  return std::nullopt;
}

std::optional<JobId> Scheduler::next_candidate() const {
  const Job* best = nullptr;
  const std::map<JobId, int> urgency = urgencies();
  const std::vector<Aged> aged = aged_jobs();
  const auto goes_before = [&](const Job& a, const Job& b) {
    const std::uint64_t a_effort = records_.at(a.id).effort;
    const std::uint64_t b_effort = records_.at(b.id).effort;
    if (a_effort != b_effort) return a_effort < b_effort;  // what takes long keeps nobody waiting
    const bool a_held = a.state == JobState::holding;
    const bool b_held = b.state == JobState::holding;
    if (a_held != b_held) return a_held;
    if (urgency.empty() || urgency.at(a.id) == urgency.at(b.id)) return a.id < b.id;
    return urgency.at(a.id) > urgency.at(b.id);
  };
  const std::vector<const Job*> occupied_by = occupying();
  for (const auto& queue : order_) {
    if (queue.empty()) continue;
    const Record& record = records_.at(queue.front());
    if (record.judged_at == version_ || !may_be_judged(record, occupied_by)) continue;
    if (held_back_by(record, aged)) continue;
    if (!best || goes_before(record.job, *best)) best = &record.job;
  }
  return best ? std::optional(best->id) : std::nullopt;
}

// ---- The question ----

// Whether jobs have been put off instead.
bool Scheduler::ask_next() {
  if (open_) return false;
  renew_lanes();
  bool put_off = false;
  if (const auto recheck = next_recheck()) {
    ask({*recheck}, Purpose::recheck);
  } else if (const auto opens = next_aside_in_a_ring()) {
    ask_aside(*opens);
  } else {
    auto candidate = next_candidate();
    for (; candidate && waits_for_sequence(*candidate); candidate = next_candidate()) {
      put_off = true;
    }
    if (candidate) {
      ask({*candidate}, Purpose::start);
    } else if (const auto aside = next_aside()) {
      ask_aside(*aside);
    }
  }
  return put_off;
}

Motion Scheduler::motion_now(const Record& record) const {
  const auto& arms = record.job.trajectory->arms();
  const bool to_come = std::ranges::any_of(
      arms, [&](ArmId arm) { return order_[arm.index()].front() != record.job.id; });
  return Motion{.job = record.job.id,
                .trajectory = record.job.trajectory,
                .progress = record.job.progress,
                .to_come = to_come};
}

// Everything else that is admitted.
void Scheduler::add_others(Question& question, const std::vector<JobId>& candidates) const {
  for (const CoordinatedMotion& motion : graph_.motions()) {
    if (std::ranges::find(candidates, motion.job) != candidates.end()) continue;
    question.others.push_back(motion_now(records_.at(motion.job)));
  }
}

void Scheduler::ask(std::vector<JobId> jobs, Purpose purpose) {
  Question question{.version = version_,
                    .start_at = now_,
                    .candidates = {},
                    .others = {},
                    .rest = rest_,
                    .method = policy_->method()};
  if (purpose == Purpose::start) question.effort = records_.at(jobs.front()).effort;
  for (JobId id : jobs) question.candidates.push_back(motion_now(records_.at(id)));
  add_others(question, jobs);
  std::vector<Passage> unknown;
  if (purpose == Purpose::start) {
    auto outlook = outlook_after(jobs);
    unknown = std::move(outlook.unknown);
    std::ranges::move(outlook.ahead, std::back_inserter(unknown));
  }
  open_ = OpenQuestion{version_, std::move(jobs), purpose};
  add_passages(question, std::move(unknown));
  effects_.push_back(Judge{std::move(question)});
}

}  // namespace armloom
