// Jobs of the server's own: arms that go aside, and back to where their clients left them.
#include <utility>

#include "core/executive/executive_impl.h"
#include "core/trajectory/joint_line.h"
#include "core/trajectory/set_joints.h"

namespace armloom {

// Clients know arms where they left them: one that was sent aside returns there for a job that
// begins there.
std::vector<TrajectoryPtr> Executive::Impl::returns_for(const Trajectory& motion,
                                                        Ahead& ahead) const {
  std::vector<TrajectoryPtr> returns;
  for (ArmId arm : motion.arms()) {
    const auto back = ahead.ways_back.find(arm);
    if (back == ahead.ways_back.end()) continue;
    Configuration returned = ahead.rest;
    set_joints(returned, *back->second, back->second->goal());
    Problems here, there;
    find_start_elsewhere(*cell_, motion, ahead.rest, here);
    find_start_elsewhere(*cell_, motion, returned, there);
    if (there.size() < here.size()) {
      ahead.rest = std::move(returned);
      returns.push_back(back->second);
    }
    ahead.ways_back.erase(back);
  }
  return returns;
}

// Of an arm that was sent aside, before a job of this priority.
Submit Executive::Impl::return_of(TrajectoryPtr back, int priority) const {
  return {.job = JobId{0},
          .trajectory = std::move(back),
          .priority = priority,
          .backlog_timeout = cell_->scheduling.backlog_timeout,
          .system_job = true};
}

void Executive::Impl::note_aside(const YieldMove& aside) {
  const std::string arm = cell_->arm(aside.arm).name;
  if (aside.to_start) {
    label(aside.job, {own_key("approach-", next_approach_),
                      arm + " goes to the start of " + key(aside.blocked_job)});
    ways_back_.erase(aside.arm);
    return;
  }
  label(aside.job, {own_key("aside-", next_aside_),
                    aside.returns ? arm + " returns to where it stood"
                                  : arm + " moves aside for " + key(aside.blocked_job)});
  if (!aside.in_ring) remember_way_back(aside.arm, *scheduler_.find(aside.job)->trajectory);
}

// Where the clients of an arm left it, however often it goes aside.
void Executive::Impl::remember_way_back(ArmId arm, const Trajectory& way) {
  TrajectoryPtr back = retraced(way);
  if (const auto before = ways_back_.find(arm); before != ways_back_.end()) {
    const Trajectory& old = *before->second;
    if (old.joints() == way.joints()) {
      if (auto line = joint_line(*cell_, way.joints(), way.goal(), old.goal())) back = *line;
    }
  }
  ways_back_[arm] = std::move(back);
}

// Of a job of the server's own.
std::string Executive::Impl::own_key(const std::string& begins, std::uint64_t& next) const {
  std::string own;
  do {
    own = begins + std::to_string(next++);
  } while (ids_.contains(own));
  return own;
}

}  // namespace armloom
