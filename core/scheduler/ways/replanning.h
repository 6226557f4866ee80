#pragma once

#include <optional>
#include <string>

#include "core/jobs/state.h"

namespace armloom {

// Another way for a job that waits, or stands on its way: from where its arm stands to where its
// own way ends, beside all other arms where they rest, or will when what is admitted has run. One
// on its path is brought to rest first. Until the answer is there it stays where it is (gate
// `plan`); where there is no other way it keeps its own, and nothing else has changed. With another
// way it waits like one that has just come, under its id.

// Such ways that are asked for without a client, for one job; each beside other surroundings.
inline constexpr int kReplansMax = 3;

// Why a job can be given no other way, as one sentence; nothing: it can.
[[nodiscard]] std::optional<std::string> why_not_replanned(const Job& job);

// Precondition: nothing of why_not_replanned(). No-op while one is asked for already, or the way to
// its goal is being planned anyway.
void ask_for_another_way(State& state, Record& record, AnotherWay::Cause cause);
// Asks for those whose arms have come to rest meanwhile (PlanMotion).
void plan_other_ways(State& state);
// The answer to that, if it is one. Whether the job has another way now.
[[nodiscard]] bool take_other_way(State& state, const PlanMade& answer);

// The cell wants it (on_idle_blocker "replan"), and where things stand it has not been tried.
[[nodiscard]] bool may_go_around(const State& state, const Record& record);
// For the first job that waits for an arm which no job will move, and may go around it. Whether
// there is one.
[[nodiscard]] bool goes_around_idle_arm(State& state);
// Its time in the backlog, or on its path for what no job moves, is over: whether it tries another
// way instead (OnTimeout::replan).
[[nodiscard]] bool goes_on_after_timeout(State& state, Record& record);

}  // namespace armloom
