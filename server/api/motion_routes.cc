#include "server/api/route.h"
#include "server/messages/job_motion.h"

namespace armloom {
namespace {

void get_trajectory(Call call) {
  const ApiParts& parts = call.parts;
  const std::string& key = call.arguments.front();
  ask(
      parts, [key](Executive& executive) { return executive.inquiries().trajectory(key); },
      [&parts, respond = call.respond, key](const TrajectoryPtr& trajectory) {
        if (trajectory == nullptr) return respond(no_such_job(parts, key));
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
       .summary = "Get the trajectory of a job",
       .text = "Returns the motion that the job executes or will execute. With `retime`, this is "
               "the timed trajectory. For a goal, it is the planned trajectory; before planning, "
               "an estimate along a straight line. With `alternatives`, it is the selected or most "
               "likely trajectory. 404 if the job is unknown or forgotten: trajectories of earlier "
               "sessions are only in their recordings.",
       .outcomes = {outcome(200, "The trajectory", job_motion_format())},
       .refuses = {404},
       .run = get_trajectory},
  };
}

}  // namespace armloom
