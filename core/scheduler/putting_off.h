#pragma once

#include <vector>

#include "core/jobs/state.h"

namespace armloom {

// Handling of a job that was checked and is not admitted.

// Precondition of all functions but hold_back(): the job is waiting.
void note_found(Record& record, std::vector<Wait> waits);
// Moves the job to the backlog until the next version. A job that is not the first of its arms
// stays queued.
void put_off(State& state, Record& record, std::vector<Wait> waits);
// Defers a job whose arm is too close to an object to be planned (Job::stands_in), without a
// question. Returns false if it is not such a job.
[[nodiscard]] bool put_off_where_it_stands(State& state, Record& record);
// Keeps the job queued, not backlogged: it is blocked only by jobs that must go first.
void wait_behind(State& state, Record& record, JobId first);
// Keeps the job queued behind `first`, which precedes it in the safe sequence. It is checked again
// when that changes.
void wait_in_turn(State& state, Record& record, JobId first);
// Returns true if the verdict has a self-collision and the job has not begun; it has then failed.
[[nodiscard]] bool fails_by_itself(State& state, Record& record, const Verdict& verdict);
// Defers the job with the conflicts of the verdict, or fails it for a self-collision.
void refuse(State& state, Record& record, const Verdict& verdict);
// Brakes an admitted job whose motion is in conflict in the changed scene.
void hold_back(State& state, Record& record, const Verdict& verdict);

// Returns true if the evaluation budget was exhausted and the job will be checked again at its turn
// with a larger budget, after jobs with smaller budgets. The number of raises is limited so that an
// undecidable job does not take time from other jobs after every change.
[[nodiscard]] bool is_asked_again(Record& record, const Verdict& verdict);

}  // namespace armloom
