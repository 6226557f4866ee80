#pragma once

#include "server/api/parts.h"
#include "server/http/router.h"

namespace armloom {

// The verbs under /api/v1 by resource. `parts` outlives the router.

void add_submission_routes(Router& router, const ApiParts& parts);  // POST /jobs, /batches, /check
void add_job_routes(Router& router, const ApiParts& parts);         // GET, DELETE /jobs, /queue
void add_arm_routes(Router& router, const ApiParts& parts);         // /arms, /stop, /resume
void add_scene_routes(Router& router, const ApiParts& parts);       // /scene
void add_simulation_routes(Router& router, const ApiParts& parts);  // /sim

inline constexpr const char* kApi = "/api/v1";

}  // namespace armloom
