#pragma once

#include <vector>

#include "core/jobs/state.h"

namespace armloom {

// What becomes of a job that was judged and does not go.

// Precondition of all but hold_back(): it waits.
void note_found(Record& record, std::vector<Wait> waits);
// Into the backlog, until what holds it back is another.
void put_off(State& state, Record& record, std::vector<Wait> waits);
// Where its way begins in something that no job moves (Job::stands_in): nothing is asked about it.
[[nodiscard]] bool put_off_where_it_stands(State& state, Record& record);
// Not the backlog: it could go, or soon could, but for those that have to come before it.
void wait_behind(State& state, Record& record, JobId first);
// So it is in the sequence; when that is another one, it is judged again.
void wait_in_turn(State& state, Record& record, JobId first);
// Whether its arms would hit themselves or each other: then it has failed, unless it has begun.
[[nodiscard]] bool fails_by_itself(State& state, Record& record, const Verdict& verdict);
// For what the verdict found; or it fails by itself.
void refuse(State& state, Record& record, const Verdict& verdict);
// An admitted one, that another scene endangers: it is stopped.
void hold_back(State& state, Record& record, const Verdict& verdict);

// Where the budget of evaluations has ended it is not put off yet, but judged again with a larger
// one when its turn comes, behind those that are judged with less. So often at most that a job that
// cannot be decided takes no time from others each time that something changes.
[[nodiscard]] bool is_asked_again(Record& record, const Verdict& verdict);

}  // namespace armloom
