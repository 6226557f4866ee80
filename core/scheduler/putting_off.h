#pragma once

#include <vector>

#include "core/jobs/state.h"

namespace armloom {

// Defers or fails a job that was checked and not admitted.

// Precondition of all functions but hold_back(): the job waits.
void note_found(Record& record, std::vector<Wait> waits);
// Moves the job to the backlog if it is the first of its arms.
void put_off(State& state, Record& record, std::vector<Wait> waits);
// Defers a job that cannot be planned because of an object (Job::stands_in). Returns false for
// other jobs.
[[nodiscard]] bool put_off_where_it_stands(State& state, Record& record);
// Keeps the job queued: it is blocked only by jobs that must go first.
void wait_behind(State& state, Record& record, JobId first);
// The same, until `first` no longer precedes it in the safe sequence.
void wait_in_turn(State& state, Record& record, JobId first);
// Fails a job that has not begun if the verdict has a self-collision. Returns true if so.
[[nodiscard]] bool fails_by_itself(State& state, Record& record, const Verdict& verdict);
// Defers the job with the verdict's conflicts, or fails it.
void refuse(State& state, Record& record, const Verdict& verdict);
// Brakes an admitted job that the changed scene blocks.
void hold_back(State& state, Record& record, const Verdict& verdict);

// Returns true if the evaluation budget was exhausted and the job will be checked again with a
// larger one, after jobs with smaller budgets. Limited, so that an undecidable job does not take
// time from others after every change.
[[nodiscard]] bool is_asked_again(Record& record, const Verdict& verdict);

}  // namespace armloom
