#include "core/jobs/arm_queues.h"

#include <algorithm>
#include <cstddef>

namespace armloom {
namespace {

void count(const Step& step, std::vector<Duration>& work, int sign) {
  if (step.alternatives.empty() || step.in<Queued>() == nullptr) {
    for (ArmId arm : step.trajectory->arms())
      work[arm.index()] += sign * step.trajectory->duration();
    return;
  }
  const auto share = static_cast<int>(step.alternatives.size());
  for (const TrajectoryPtr& one : step.alternatives) {
    for (ArmId arm : one->arms()) work[arm.index()] += sign * (one->duration() / share);
  }
}

}  // namespace

bool ArmQueues::is_first(const Step& step) const {
  return std::ranges::all_of(step.trajectory->arms(),
                             [&](ArmId arm) { return queues_[arm.index()].front() == step.id; });
}

std::optional<StepId> ArmQueues::before(const Step& step, ArmId arm) const {
  const Queue& own = queues_[arm.index()];
  const auto place = std::ranges::find(own, step.id);
  return place == own.begin() ? std::nullopt : std::optional(*std::prev(place));
}

std::optional<StepId> ArmQueues::behind(const Step& step, ArmId arm) const {
  const Queue& own = queues_[arm.index()];
  const auto next = std::ranges::find(own, step.id) + 1;
  return next == own.end() ? std::nullopt : std::optional(*next);
}

void ArmQueues::insert(const Step& step, std::optional<StepId> before) {
  for (ArmId arm : step.trajectory->arms()) {
    Queue& queue = queues_[arm.index()];
    queue.insert(before ? std::ranges::find(queue, *before) : queue.end(), step.id);
  }
}

void ArmQueues::insert_at(const Step& step, std::size_t place) {
  for (ArmId arm : step.trajectory->arms()) {
    Queue& queue = queues_[arm.index()];
    queue.insert(queue.begin() + static_cast<std::ptrdiff_t>(place), step.id);
  }
}

void ArmQueues::erase(const Step& step) {
  for (ArmId arm : step.trajectory->arms()) {
    Queue& queue = queues_[arm.index()];
    queue.erase(std::ranges::find(queue, step.id));
  }
}

void ArmQueues::put_in_order(const Step& any_of_them, const std::vector<StepId>& steps) {
  const auto is_one = [&](StepId id) { return std::ranges::find(steps, id) != steps.end(); };
  for (ArmId arm : any_of_them.trajectory->arms()) {
    std::ranges::copy(steps, std::ranges::find_if(queues_[arm.index()], is_one));
  }
}

void ArmQueues::add_work(const Step& step) { count(step, work_, 1); }
void ArmQueues::remove_work(const Step& step) { count(step, work_, -1); }

std::vector<Duration> ArmQueues::work_but(const std::vector<const Step*>& in_front) const {
  std::vector<Duration> work = work_;
  for (const Step* step : in_front) count(*step, work, -1);
  return work;
}

}  // namespace armloom
