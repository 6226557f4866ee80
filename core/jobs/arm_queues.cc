#include "core/jobs/arm_queues.h"

#include <algorithm>
#include <cstddef>

namespace armloom {
namespace {

void count(const Job& job, std::vector<Duration>& work, int sign) {
  if (job.alternatives.empty() || job.in<Queued>() == nullptr) {
    for (ArmId arm : job.trajectory->arms()) work[arm.index()] += sign * job.trajectory->duration();
    return;
  }
  const auto share = static_cast<int>(job.alternatives.size());
  for (const TrajectoryPtr& one : job.alternatives) {
    for (ArmId arm : one->arms()) work[arm.index()] += sign * (one->duration() / share);
  }
}

}  // namespace

bool ArmQueues::is_first(const Job& job) const {
  return std::ranges::all_of(job.trajectory->arms(),
                             [&](ArmId arm) { return queues_[arm.index()].front() == job.step(); });
}

std::optional<StepId> ArmQueues::before(const Job& job, ArmId arm) const {
  const Queue& own = queues_[arm.index()];
  const auto place = std::ranges::find(own, job.step());
  return place == own.begin() ? std::nullopt : std::optional(*std::prev(place));
}

std::optional<StepId> ArmQueues::behind(const Job& job, ArmId arm) const {
  const Queue& own = queues_[arm.index()];
  const auto next = std::ranges::find(own, job.step()) + 1;
  return next == own.end() ? std::nullopt : std::optional(*next);
}

void ArmQueues::insert(const Job& job, std::optional<StepId> before) {
  for (ArmId arm : job.trajectory->arms()) {
    Queue& queue = queues_[arm.index()];
    queue.insert(before ? std::ranges::find(queue, *before) : queue.end(), job.step());
  }
}

void ArmQueues::insert_at(const Job& job, std::size_t place) {
  for (ArmId arm : job.trajectory->arms()) {
    Queue& queue = queues_[arm.index()];
    queue.insert(queue.begin() + static_cast<std::ptrdiff_t>(place), job.step());
  }
}

void ArmQueues::erase(const Job& job) {
  for (ArmId arm : job.trajectory->arms()) {
    Queue& queue = queues_[arm.index()];
    queue.erase(std::ranges::find(queue, job.step()));
  }
}

void ArmQueues::put_in_order(const Job& any_of_them, const std::vector<StepId>& steps) {
  const auto is_one = [&](StepId step) { return std::ranges::find(steps, step) != steps.end(); };
  for (ArmId arm : any_of_them.trajectory->arms()) {
    std::ranges::copy(steps, std::ranges::find_if(queues_[arm.index()], is_one));
  }
}

void ArmQueues::add_work(const Job& job) { count(job, work_, 1); }
void ArmQueues::remove_work(const Job& job) { count(job, work_, -1); }

std::vector<Duration> ArmQueues::work_but(const std::vector<const Job*>& in_front) const {
  std::vector<Duration> work = work_;
  for (const Job* job : in_front) count(*job, work, -1);
  return work;
}

}  // namespace armloom
