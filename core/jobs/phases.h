#pragma once

#include <string>

#include "core/jobs/state.h"

namespace armloom {

// Phase transitions of jobs, with their consequences for the sequence, orders and versions.

// Returns a record of a new job, to be passed to add().
[[nodiscard]] Record record_of(State& state, const Submit& job);
// Adds the job at the end of its arm queues, or before Errand::before.
void add(State& state, Record record);

// Throws std::logic_error if the table in job.h does not allow the transition.
void enter(State& state, Record& record, JobPhase phase);
// Ends the job. Jobs that named it in `after` no longer wait, or fail with predecessor_failed.
void end(State& state, Record& record, JobState how, Reason reason, std::string detail);
// The server ends: interrupts all jobs, or with `keeps_waiting` those that have begun.
void interrupt(State& state, bool keeps_waiting);

// Brakes the job's arms to rest on their path; then the job is held, canceled or failed. An
// undispatched job is withdrawn. A cancel or failure persists through a later stop.
void brake(State& state, Record& record, AfterStop after);
// Cancels or fails the job (`after.then` is not `hold`): at once if it is at rest, otherwise when
// its arms have come to rest.
void give_up(State& state, Record& record, const AfterStop& after);
// Withdraws an admitted, undispatched job: it waits again, or ends.
void withdraw(State& state, Record& record, const AfterStop& after);
// Handles a report that the motion has stopped, finished or faulted.
void come_to_rest(State& state, Record& record, const MotionReport& report);

// Gives a job at rest a new path from its position; it waits in the queue again. Precondition: it
// is waiting.
void set_out_anew(State& state, Record& record, TrajectoryPtr way);
// Replaces the job's path by one from the same position. Precondition: it waits in the queue.
void go_by(State& state, Record& record, TrajectoryPtr way);

// Stops the arms until they are resumed. Undispatched jobs keep their place in the queue.
void stop_arms(State& state, const Stop& stop);

}  // namespace armloom
