#pragma once

#include <string>

#include "core/jobs/state.h"

namespace armloom {

// How jobs pass from phase to phase, with all that follows for lanes, orders and versions.

// A job comes: a record of it, to be added as it is or with a place of its own.
[[nodiscard]] Record record_of(State& state, const Submit& job);
// At the end of its lanes, or before Record::before.
void add(State& state, Record record);

// The table in job.h; anything else throws std::logic_error.
void enter(State& state, Record& record, JobPhase phase);
// Nobody waits for a job that has ended: those that named it in `after` go on, or fail with it.
void end(State& state, Record& record, JobState how, Reason reason, std::string detail);
// The server ends: all are interrupted, or all that have begun.
void interrupt(State& state, bool keeps_waiting);

// Its arms are to come to rest on their path, and it is then held, canceled or failed. One whose
// arms know nothing of it yet is withdrawn. A cancel or a failure outlives a later stop; a stop
// never turns one into a mere hold.
void brake(State& state, Record& record, AfterStop after);
// It is canceled or fails (`after` does not hold it): at once where it stands, else when its arms
// have come to rest.
void give_up(State& state, Record& record, const AfterStop& after);
// An admitted job whose arms know nothing of it yet: it waits again, or ends.
void withdraw(State& state, Record& record, const AfterStop& after);
// At its end, or where it was to stop, or did by itself. Report: not `progressed`.
void come_to_rest(State& state, Record& record, const MotionReport& report);

// It stands, and forgets the way that it had: it waits in the queue again, to go this way from
// there. Precondition: it waits.
void set_out_anew(State& state, Record& record, TrajectoryPtr way);
// This way instead of its own, from the same place. Precondition: it waits in the queue.
void go_by(State& state, Record& record, TrajectoryPtr way);

// Arms shall not move until they are resumed; what was not told to them keeps its place.
void stop_arms(State& state, const Stop& stop);

}  // namespace armloom
