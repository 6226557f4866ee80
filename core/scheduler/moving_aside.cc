// Arms without a job that rest in the way (scheduling.on_idle_blocker "park").
#include <algorithm>
#include <utility>

#include "core/scheduler/scheduler.h"
#include "core/scheduler/ways_aside.h"

namespace armloom {
namespace {

// Ways that are tried for one job and one arm, lest they go to and fro for ever.
constexpr std::size_t kAsidesMax = 8;

}  // namespace

// The first job that waits for an arm which no job will move, and a pose of that arm that has not
// been tried for it.
std::optional<Scheduler::Aside> Scheduler::next_aside() const {
  if (cell_->scheduling.on_idle_blocker != "park") return std::nullopt;
  for (JobId id : active_) {
    const Record& record = records_.at(id);
    const bool put_off = waiting(record) && record.judged_at == version_;
    if (!put_off && !record.job.pausing) continue;
    for (const Wait& wait : put_off ? record.found : record.job.waits_on) {
      if (wait.kind != Wait::Kind::arm || !wait.arm) continue;
      const ArmId arm = *wait.arm;
      if (!order_[arm.index()].empty() || stopped_[arm.index()]) continue;
      const TrajectoryPtr& came_by = came_by_[arm.index()];
      const auto found = record.asides_tried.find(arm);
      const AsidesTried tried = found == record.asides_tried.end() ? AsidesTried{} : found->second;
      const std::size_t next = tried.from == came_by ? tried.next : 0;
      const auto ways = ways_aside(*cell_, arm, rest_, came_by);
      if (next < ways.size() && tried.total < kAsidesMax) return Aside{id, arm, ways[next]};
    }
  }
  return std::nullopt;
}

// Would the job find that arm out of its way?
void Scheduler::ask_aside(Aside aside) {
  const Record& record = records_.at(aside.way_of);
  const auto& joints = aside.way->joints();
  Question question{
      .version = version_,
      .start_at = now_ + allowance_,
      .candidates = {graph_ ? motion_now(record)
                            : Motion{record.job.id, record.job.trajectory, record.job.progress}},
      .others = {},
      .rest = rest_,
      .method = policy_->method()};
  for (std::size_t j = 0; j < joints.size(); ++j) {
    question.rest[static_cast<Eigen::Index>(joints[j].index())] =
        aside.way->goal()[static_cast<Eigen::Index>(j)];
  }
  add_others(question, {aside.way_of});
  open_ = OpenQuestion{version_, now_, question.start_at, {aside.way_of}, Purpose::aside, aside};
  effects_.push_back(Judge{std::move(question)});
}

void Scheduler::answer_aside(const Verdict& verdict, const Aside& aside) {
  if (!order_[aside.arm.index()].empty()) return;  // it has got a job meanwhile
  AsidesTried& tried = records_.at(aside.way_of).asides_tried[aside.arm];
  const TrajectoryPtr& came_by = came_by_[aside.arm.index()];
  if (tried.from != came_by) tried.next = 0;
  tried.from = came_by;
  ++tried.next;
  ++tried.total;
  const bool in_the_way =
      std::ranges::any_of(verdict.conflicts,
                          [&](const Conflict& conflict) {
                            const bool lasting = conflict.with != Conflict::With::motion;
                            const bool other_arm = conflict.with == Conflict::With::rest &&
                                                   conflict.proximity.arm_b != aside.arm;
                            return lasting && !other_arm;
                          }) ||
      std::ranges::any_of(verdict.regions, [&](const PairRegions& pair) {
        const auto* arm = std::get_if<ArmId>(&pair.b);
        return arm != nullptr && *arm == aside.arm;
      });
  if (!in_the_way) effects_.push_back(MoveAside{aside.arm, aside.way_of, aside.way});
}

}  // namespace armloom
