#pragma once

#include "core/scheduler/yielding/yield_moves.h"

namespace armloom {

// Adds and announces a job of the server that helps `told.blocked_job` and has its priority. It
// comes before the job `before`, or last in the arm's queue. With `goes`, it returns the arm after
// that retreat, for the job `before`. Returns its id.
JobId add_own(Transitions& state, YieldMove told, Submit job, std::optional<JobId> before,
              std::optional<JobId> goes = {});

// Adds the retreat as a job. If the arm's next job is in the deadlock cycle and begins where the
// arm is now, also adds a job that brings the arm back. A next job with a goal begins where the
// retreat ends, and lets the blocked job pass first.
void send_aside(Transitions& state, const YieldTrial& move);
// Adds jobs that first return arms to where clients left them (WaysBack), before the new job of a
// client. `rest`: where the earlier jobs leave all joints.
void bring_back(Transitions& state, const Submit& job, Configuration rest);

// Handles the server's own waiting jobs (retreats, returns, moves-to-start) whose client job has
// ended. If the next client job of the arm relies on such a job, it now helps that job. Otherwise
// it is canceled, so that no job waits for it.
void pass_errands_on(Transitions& state);

}  // namespace armloom
