#pragma once

#include <string>

#include "core/jobs/state.h"

namespace armloom {

// Phase transitions of jobs, with all consequences.

// Returns a record for add().
[[nodiscard]] Record record_of(State& state, const Submit& job);
// At the end of its arm queues, or before Errand::before.
void add(State& state, Record record);

void enter(State& state, Record& record, JobPhase phase);
// Ends the job; jobs with it in `after` no longer wait, or fail.
void end(State& state, Record& record, JobState how, Reason reason, std::string detail);
// The server ends: interrupts all jobs, or those that have begun.
void interrupt(State& state, bool keeps_waiting);

// Brakes the job's arms; then it is held, canceled or failed. Withdraws an undispatched job. A
// cancel or failure persists through a later stop.
void brake(State& state, Record& record, AfterStop after);
// Cancels or fails the job (`then` is not `hold`), at once or after braking.
void give_up(State& state, Record& record, const AfterStop& after);
// Withdraws an admitted, undispatched job: it waits again, or ends.
void withdraw(State& state, Record& record, const AfterStop& after);
// Handles a report that the motion has stopped, finished or faulted.
void come_to_rest(State& state, Record& record, const MotionReport& report);

// Gives a waiting job a new path from its position and puts it back into the queue.
void set_out_anew(State& state, Record& record, TrajectoryPtr way);
// Replaces a queued job's path by one from the same position.
void go_by(State& state, Record& record, TrajectoryPtr way);

// Undispatched jobs keep their place in the queue.
void stop_arms(State& state, const Stop& stop);

}  // namespace armloom
