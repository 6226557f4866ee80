#pragma once

#include <vector>

#include "core/jobs/transitions.h"

namespace armloom {

// Defers or fails a job that was checked and not admitted.

// Precondition of all functions except waits_for_rest() and holds_back(): the job waits.
// Stores what the job was found to wait for, but does not publish it.
void note_found(Transitions& state, const Step& step, std::vector<Wait> waits);
// Defers the job because of these waits. Moves it to the backlog if it is the first of its arms.
void put_off(Transitions& state, const Step& step, std::vector<Wait> waits);
// Defers the job if its path cannot be planned because of an object (Step::stands_in). Otherwise
// returns false.
[[nodiscard]] bool put_off_where_it_stands(Transitions& state, const Step& step);
// Keeps the job out of the backlog: it waits only for `first`, which must go before it.
void wait_behind(Transitions& state, const Step& step, JobId first);
// Does the same for `outlook.first`, until the safe sequence no longer requires it (InTurn).
void wait_in_turn(Transitions& state, const Step& step, const SafeSequence::Outlook& outlook);
// If the verdict has a self-collision and the job has not begun, fails the job and returns true.
[[nodiscard]] bool fails_by_itself(Transitions& state, const Step& step, const Verdict& verdict);
// Defers the job because of the verdict's conflicts, or fails it (fails_by_itself()).
void refuse(Transitions& state, const Step& step, const Verdict& verdict);
// Returns waits for the arms that rest in the path of the admitted job. No passing order holds it
// for them.
[[nodiscard]] std::vector<Wait> waits_for_rest(const Step& step, const Verdict& verdict);
// Brakes an admitted job that is in conflict after a change of the scene, also with what an arm at
// rest holds now. Returns false if the job is free.
[[nodiscard]] bool holds_back(Transitions& state, const Step& step, const Verdict& verdict);

// Returns true if the check exceeded its budget of evaluations and will be repeated with a larger
// budget, after the jobs with smaller budgets. The number of repetitions is limited, so that an
// undecidable job does not delay others after every change.
[[nodiscard]] bool is_asked_again(Transitions& state, const Step& step, const Verdict& verdict);

}  // namespace armloom
