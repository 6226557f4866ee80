#include "server/api/route.h"
#include "server/messages/job_motion.h"

namespace armloom {
namespace {

void get_trajectory(Call call) {
  const ApiParts& parts = call.parts;
  const std::string& key = call.arguments.front();
  ask(
      parts, [key](Executive& executive) { return executive.trajectory(key); },
      [&parts, respond = call.respond, key](const TrajectoryPtr& trajectory) {
        if (trajectory == nullptr) return respond(no_such("job", key));
        respond(
            answer(200, job_motion_format(),
                   JobMotion{key, trajectory->duration(), request_of(*trajectory, *parts.cell)}));
      });
}

}  // namespace

std::vector<Route> motion_routes() {
  return {
      {.method = "GET",
       .path = api_path("/jobs/{id}/trajectory"),
       .id = "getTrajectory",
       .tag = "jobs",
       .summary = "How a job moves",
       .text =
           "The motion that is executed, or will be: made, where the job had no times; planned, "
           "where it had a goal (until then the straight way, as an estimate); of the "
           "alternatives the one that is taken, or likeliest. 404 also of jobs that have been "
           "forgotten: only a file of a former run has them.",
       .outcomes = {outcome(200, "The motion", job_motion_format())},
       .refuses = {404},
       .run = get_trajectory},
  };
}

}  // namespace armloom
