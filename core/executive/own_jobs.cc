// Jobs of the server's own: arms that go aside, and back to where their clients left them.
#include <utility>

#include "core/executive/job_intake.h"
#include "core/executive/start_elsewhere.h"
#include "core/trajectory/joint_line.h"
#include "core/trajectory/set_joints.h"

namespace armloom {

// Clients know arms where they left them: one that was sent aside returns there for a job that
// begins there.
std::vector<TrajectoryPtr> JobIntake::returns_for(const Trajectory& motion, Ahead& ahead) const {
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

Submit JobIntake::return_of(TrajectoryPtr back, int priority) const {
  return {.job = JobId{0},
          .trajectory = std::move(back),
          .terms = {.priority = priority},
          .system_job = true};
}

void JobIntake::remember_way_back(ArmId arm, const Trajectory& way) {
  TrajectoryPtr back = retraced(way);
  if (const auto before = ways_back_.find(arm); before != ways_back_.end()) {
    const Trajectory& old = *before->second;
    if (old.joints() == way.joints()) {
      if (auto line = joint_line(*cell_, way.joints(), way.goal(), old.goal())) back = *line;
    }
  }
  ways_back_[arm] = std::move(back);
}

}  // namespace armloom
