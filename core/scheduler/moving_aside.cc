// Arms that rest in the way (scheduling.on_idle_blocker "park"): without a job, or in a ring.
#include <algorithm>
#include <utility>
#include <vector>

#include "core/scheduler/scheduler.h"
#include "core/scheduler/ways_aside.h"

namespace armloom {
namespace {

// Ways that are tried for one job of a client and one arm, lest arms go to and fro for ever.
constexpr std::size_t kAsidesMax = 8;
// So often an arm goes to one and the same place for it: clients may have sent it back there.
constexpr std::ptrdiff_t kSamePlaceMax = 2;
constexpr double kSamePlace = 1e-3;  // relative

// Whether the second motion, pausing at `progress`, is in the way of the first, which lasts so
// long: unless they stand close now, and the first one leaves that for good.
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

}  // namespace

// The first job that waits for an arm which no job will move.
std::optional<Scheduler::Aside> Scheduler::next_aside() const {
  for (JobId id : past_queue_) {
    const Record& record = records_.at(id);
    const bool put_off = waiting(record) && record.judged_at == version_;
    if (!put_off && !record.job.pausing) continue;
    for (const Wait& wait : put_off ? record.found : record.job.waits_on) {
      if (wait.kind != Wait::Kind::arm || !wait.arm || !order_[wait.arm->index()].empty()) continue;
      if (auto aside = untried(record, *wait.arm)) return aside;
    }
  }
  return std::nullopt;
}

std::optional<Scheduler::Aside> Scheduler::next_aside_in_a_ring() const {
  for (const NamedRing& named : rings_) {
    if (named.opens) continue;
    if (auto aside = aside_in(named.ring)) return aside;
  }
  return std::nullopt;
}

// Each job of a ring waits for the next one, mostly for the arm that only that will move: could it
// move before its job? The one whose job would have to give way otherwise is tried first. Not where
// a move aside is in the ring that can give way itself.
std::optional<Scheduler::Aside> Scheduler::aside_in(const Ring& ring) const {
  const bool dispensable = std::ranges::any_of(ring, [this](JobId id) {
    const Record& record = records_.at(id);
    return record.job.own && !is_counted_on(record);
  });
  if (dispensable) return std::nullopt;
  const Ring from_last = beginning_with(*std::ranges::max_element(ring), ring);
  for (std::size_t i = 0; i < from_last.size(); ++i) {
    const Record& next = records_.at(from_last[i]);
    const Record& waits = records_.at(from_last[(i + from_last.size() - 1) % from_last.size()]);
    if (!waiting(next) || next.job.started_at || next.job.own) continue;
    for (const Wait& wait : waiting(waits) ? waits.found : waits.job.waits_on) {
      const bool near = wait.kind == Wait::Kind::arm || wait.kind == Wait::Kind::job;
      if (!near || !wait.arm) continue;
      const auto& queue = order_[wait.arm->index()];
      if (queue.empty() || queue.front() != next.job.id) continue;
      auto aside = untried(waits, *wait.arm);
      if (!aside) continue;
      aside->before = next.job.id;
      return aside;
    }
  }
  return std::nullopt;
}

// A way aside of this arm that has not been tried for the job. Nobody makes way any more for what
// was to help a job that has ended.
std::optional<Scheduler::Aside> Scheduler::untried(const Record& record, ArmId arm) const {
  if (cell_->scheduling.on_idle_blocker != "park" || stopped_[arm.index()]) return std::nullopt;
  const TrajectoryPtr& came_by = came_by_[arm.index()];
  const auto found = record.asides_tried.find(arm);
  const AsidesTried tried = found == record.asides_tried.end() ? AsidesTried{} : found->second;
  if (!active_.contains(record.helps)) return std::nullopt;
  const auto& of_all = records_.at(record.helps).asides_tried;
  const auto all = of_all.find(arm);
  if (all != of_all.end() && all->second.total >= kAsidesMax) return std::nullopt;
  const auto been_there = [&](const Trajectory& way) {
    return all != of_all.end() &&
           std::ranges::count_if(all->second.went_to, [&](const Eigen::VectorXd& goal) {
             return goal.size() == way.goal().size() && goal.isApprox(way.goal(), kSamePlace);
           }) >= kSamePlaceMax;
  };
  const auto ways = ways_aside(*cell_, arm, rest_, came_by);
  for (std::size_t i = tried.from == came_by ? tried.next : 0; i < ways.size(); ++i) {
    if (been_there(*ways[i])) continue;
    return Aside{.way_of = record.job.id, .arm = arm, .way = ways[i], .index = i};
  }
  return std::nullopt;
}

Question Scheduler::about_way(TrajectoryPtr way) const {
  Question question{.version = version_,
                    .start_at = now_,
                    .candidates = {Motion{JobId{0}, std::move(way), Duration{}}},
                    .others = {},
                    .rest = rest_,
                    .method = policy_->method()};
  add_others(question, {});
  return question;
}

// First whether the way itself will be free, then whether the job would find the arm gone.
void Scheduler::ask_aside(Aside aside) {
  Question question = about_way(aside.way);
  if (aside.is_free) {
    const Record& record = records_.at(aside.way_of);
    const auto& joints = aside.way->joints();
    question.candidates = {motion_now(record)};
    for (std::size_t j = 0; j < joints.size(); ++j) {
      question.rest[static_cast<Eigen::Index>(joints[j].index())] =
          aside.way->goal()[static_cast<Eigen::Index>(j)];
    }
    question.others.clear();
    add_others(question, {aside.way_of});
  }
  open_ = OpenQuestion{version_, {aside.way_of}, Purpose::aside, aside};
  effects_.push_back(Judge{std::move(question)});
}

void Scheduler::answer_aside(const Verdict& verdict, Aside aside) {
  const auto& queue = order_[aside.arm.index()];
  const bool as_it_was = aside.before ? !queue.empty() && queue.front() == *aside.before  //
                                      : queue.empty();
  if (!as_it_was) return;  // it has got a job meanwhile
  const bool passes = lets_through(verdict, aside);
  if (passes && !aside.is_free) {
    aside.is_free = true;
    return ask_aside(std::move(aside));
  }
  AsidesTried& tried = records_.at(aside.way_of).asides_tried[aside.arm];
  const TrajectoryPtr& came_by = came_by_[aside.arm.index()];
  tried.from = came_by;
  tried.next = aside.index + 1;
  const JobId helped = records_.at(aside.way_of).helps;
  if (active_.contains(helped)) {
    AsidesTried& of_all = records_.at(helped).asides_tried[aside.arm];
    ++of_all.total;
    if (passes) of_all.went_to.push_back(aside.way->goal());
  }
  if (passes) move_aside(aside);
}

// Whether nothing that stays keeps the arm from its way, or, where that is free, the job from its
// own: an object, the moving arm itself, an arm of the ring; or the arm that has gone aside.
bool Scheduler::lets_through(const Verdict& verdict, const Aside& aside) const {
  const auto stays = [&](ArmId arm) {
    if (aside.is_free) return arm == aside.arm;
    const auto& queue = order_[arm.index()];
    if (queue.empty()) return false;  // it may go aside too
    return queue.front() == aside.way_of || (aside.before && waiting(records_.at(queue.front())));
  };
  for (const Conflict& conflict : verdict.conflicts) {
    if (conflict.with == Conflict::With::motion) continue;
    const bool at_rest = conflict.with == Conflict::With::rest && conflict.proximity.arm_b;
    if (!at_rest || stays(*conflict.proximity.arm_b)) return false;
  }
  return std::ranges::none_of(verdict.regions, [&](const PairRegions& pair) {
    const auto* arm = std::get_if<ArmId>(&pair.b);
    if (arm != nullptr) return stays(*arm);
    const bool of_it = !aside.is_free && std::get<JobId>(pair.b) == aside.way_of;
    return of_it && rests_in(pair, records_.at(aside.way_of).job.progress, aside.way->duration());
  });
}

void Scheduler::move_aside(const Aside& aside) {
  effects_.push_back(MoveAside{aside.arm, aside.way_of, aside.way, aside.before});
  for (NamedRing& named : rings_) {
    const auto in_ring = [&](JobId job) {
      return std::ranges::find(named.ring, job) != named.ring.end();
    };
    if (aside.before && in_ring(*aside.before)) named.opens = true;
  }
}

}  // namespace armloom
