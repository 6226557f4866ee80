#pragma once

#include <string>

#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"
#include "core/trajectory/validate.h"
#include "server/codec/format.h"

namespace armloom {

// Returns a request for the same trajectory, with accelerations if a segment needs them.
[[nodiscard]] TrajectoryRequest request_of(const Trajectory& trajectory, const Cell& cell);

// Answer to GET /jobs/{id}/trajectory.
struct JobMotion {
  std::string job;  // key of the job
  Duration duration;
  TrajectoryRequest trajectory;
};
[[nodiscard]] FormatPtr<JobMotion> job_motion_format();

}  // namespace armloom
