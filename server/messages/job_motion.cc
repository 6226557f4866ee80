#include "server/messages/job_motion.h"

#include <algorithm>

#include "server/codec/object_format.h"
#include "server/codec/output_part.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"
#include "server/messages/job_request.h"
#include "server/messages/trajectory_request.h"

namespace armloom {

using namespace formats;

namespace {

// Returns true for a cubic segment. A quintic segment is only reproduced if its waypoints have
// accelerations. With accelerations, a cubic segment would be read as another curve.
bool is_cubic(const Segment& segment) { return segment.coefficients.rightCols<2>().isZero(0.0); }

WaypointRequest waypoint_of(const Trajectory& trajectory, Duration at, bool with_accelerations) {
  JointState state;
  trajectory.sample(at, state);
  WaypointRequest point;
  point.positions = {state.position.begin(), state.position.end()};
  point.velocities = {state.velocity.begin(), state.velocity.end()};
  if (with_accelerations) {
    point.accelerations = {state.acceleration.begin(), state.acceleration.end()};
  }
  point.time_from_start_s = to_seconds(at);
  return point;
}

}  // namespace

TrajectoryRequest request_of(const Trajectory& trajectory, const Cell& cell) {
  TrajectoryRequest request;
  for (JointId joint : trajectory.joints()) request.joint_names.push_back(cell.joint(joint).name);
  const bool with_accelerations = !std::ranges::all_of(trajectory.segments(), is_cubic);
  for (const Segment& segment : trajectory.segments()) {
    request.points.push_back(waypoint_of(trajectory, segment.start, with_accelerations));
  }
  request.points.push_back(waypoint_of(trajectory, trajectory.duration(), with_accelerations));
  return request;
}

FormatPtr<JobMotion> job_motion_format() {
  using Told = JobMotion;
  static const auto format = named(
      "JobMotion", "The motion of a job.",
      object<Told>({
          output_only("id", &Told::job, job_id_format(), "Id of the job"),
          output_only("duration_s", &Told::duration, seconds(kPositive)),
          output_only(
              "trajectory", &Told::trajectory, told_trajectory_format(),
              "The trajectory in the form of POST /jobs; submitting it gives the same motion"),
      }));
  return format;
}

}  // namespace armloom
