#pragma once

#include <string>

#include "core/jobs/state.h"

namespace armloom {

// Phase transitions of jobs, with all their consequences in the state.

// Returns the job's step, to be passed to add(). `errand`: of a job of the server.
[[nodiscard]] Step step_of(State& state, const Submit& job,
                           const std::optional<Errand>& errand = {});
// Adds the job at the end of its arm queues, or before the job Errand::before.
void add(State& state, Step step);

void enter(State& state, Step& step, StepPhase phase);
// Ends the job. Jobs that name it in `after` no longer wait for it, or fail if it did not succeed.
void end(State& state, Step& step, JobState how, Reason reason, std::string detail);
// The server ends: interrupts all jobs, or with `keeps_waiting` only those that have begun.
void interrupt(State& state, bool keeps_waiting);

// Brakes the job's arms; at rest the job is held, canceled or failed (`after`). If the job is not
// dispatched yet, withdraws it. A later stop does not undo a cancel or a failure.
void brake(State& state, Step& step, AfterStop after);
// Cancels or fails the job (`then` is not `hold`), at once or after braking.
void give_up(State& state, Step& step, const AfterStop& after);
// Takes back the admission of a job that is not dispatched: the job waits again, or ends.
void withdraw(State& state, Step& step, const AfterStop& after);
// Handles a report that the motion has stopped, finished or faulted.
void come_to_rest(State& state, Step& step, const MotionReport& report);

// Gives a waiting job a new path from its arm's position and makes it Queued again.
void set_out_anew(State& state, Step& step, TrajectoryPtr way);
// Replaces a queued job's path by one from the same position.
void go_by(State& state, Step& step, TrajectoryPtr way);

// Stops the arms and brakes their jobs. Jobs that are not dispatched keep their place in the queue.
void stop_arms(State& state, const Stop& stop);

}  // namespace armloom
