// Jobs that wait for each other in a ring: they are told, and one of them gives way.
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "core/scheduler/deadlock.h"
#include "core/scheduler/scheduler.h"

namespace armloom {

// Every job of a ring is told of it now; what becomes of the ring is decided in a later step, so
// that it is seen by clients whatever that is.
void Scheduler::name_deadlocks() {
  // Orders alone make no ring: all follow one sequence. And only the first job of an arm is judged.
  const bool in_the_way = std::ranges::any_of(order_, [this](const auto& queue) {
    if (queue.empty()) return false;
    const Record& record = records_.at(queue.front());
    return std::ranges::any_of(found_in_the_way(record), [&](const Wait& wait) {
      return wait.kind != Wait::Kind::order && has_to_move_first(wait).has_value();
    });
  });
  if (!in_the_way) return;
  for (Ring& ring : find_rings(waits_for())) {
    const bool told = std::ranges::any_of(rings_, [&](const NamedRing& named) {
      return std::ranges::find_first_of(named.ring, ring) != named.ring.end();
    });
    if (told) continue;
    for (JobId id : ring) {
      Record& record = records_.at(id);
      record.job.ring = beginning_with(id, ring);
      changed(record);
    }
    rings_.push_back({std::move(ring), disturbed_at_});
  }
}

// No arm of a ring moves while its jobs wait. So a ring that was found stands until one of these
// goes, or the scene is another one.
bool Scheduler::stands(const NamedRing& named) const {
  return named.disturbed_at == disturbed_at_ && std::ranges::all_of(named.ring, [this](JobId id) {
           return active_.contains(id) && stands(records_.at(id));
         });
}

void Scheduler::settle_deadlocks() {
  for (NamedRing& named : std::exchange(rings_, {})) {
    const bool stood = stands(named);
    named.way_out = stood && aside_in(named.ring).has_value();
    if (named.way_out || (stood && named.opens)) {
      rings_.push_back(std::move(named));
      continue;
    }
    if (stood) resolve(named.ring);
    untell(named.ring);
  }
}

void Scheduler::untell(const Ring& ring) {
  for (JobId id : ring) {
    if (!active_.contains(id)) continue;
    Record& record = records_.at(id);
    const bool ends_for_it = record.job.stopping && record.after_stop == AfterStop::fail &&
                             record.fail_reason == Reason::deadlock;
    if (ends_for_it) continue;  // it names the ring when it has come to rest
    record.job.ring.clear();
    changed(record);
  }
}

// A client's job behind this one of one's own does not begin where their arm stands without it.
bool Scheduler::is_counted_on(const Record& own) const {
  const ArmId arm = own.job.trajectory->arms().front();
  const auto& queue = order_[arm.index()];
  const auto of_a_client = [this](JobId id) { return !records_.at(id).job.own; };
  const auto next = std::find_if(std::ranges::find(queue, own.job.id), queue.end(), of_a_client);
  if (next == queue.end()) return false;
  if (own.job.started_at) return true;
  const Trajectory& motion = *records_.at(*next).job.trajectory;
  for (std::size_t j = 0; j < motion.joints().size(); ++j) {
    const JointId joint = motion.joints()[j];
    if (cell_->joint(joint).arm != arm) continue;
    const double begins = motion.start()[static_cast<Eigen::Index>(j)];
    const double stands = rest_[static_cast<Eigen::Index>(joint.index())];
    if (std::abs(begins - stands) > cell_->execution.start_tolerance_rad) return true;
  }
  return false;
}

// An arm that is aside for the sake of another one of the ring comes back first. Else a move aside
// gives way, or the last job that a client sent: the others were there before it closed the ring.
// Not a return, or a move aside on which a client's job counts by now.
void Scheduler::resolve(const Ring& ring) {
  for (JobId id : ring) {
    Record& record = records_.at(id);
    if (lets_another_pass(record) && std::ranges::find(ring, *record.lets_pass) != ring.end()) {
      record.lets_pass.reset();
      lanes_changed_ = true;
      return;
    }
  }
  const auto dispensable = [this](JobId id) {
    const Record& record = records_.at(id);
    return std::tuple(!record.job.own || !is_counted_on(record), record.job.own, id);
  };
  Record& last = records_.at(*std::ranges::max_element(ring, {}, dispensable));
  if (holds_reservation(last)) {
    last.fail_reason = Reason::deadlock;
    last.fail_detail.clear();
    return brake(last, AfterStop::fail);
  }
  const bool held = last.job.state == JobState::holding;
  end(last, JobState::failed, Reason::deadlock, "");
  if (held) effects_.push_back(Release{last.job.id});
}

}  // namespace armloom
