#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/deadlock/waits_for.h"
#include "core/scheduler/waiting/turns.h"

namespace armloom {

// Either one wait, stored here, or a view of the waits that the last check found.
class FoundWaits {
 public:
  FoundWaits() = default;
  explicit FoundWaits(Wait wait) : own_(std::move(wait)) {}
  explicit FoundWaits(std::span<const Wait> found) : found_(found) {}

  [[nodiscard]] std::span<const Wait> all() const { return own_ ? std::span(&*own_, 1) : found_; }

 private:
  std::optional<Wait> own_;
  std::span<const Wait> found_;
};

// Tells what a condition is checked for. Without turns: the start of an admitted job, or admission
// in a group. With turns: the next check of a waiting job, within the policy's horizon.
struct Look {
  const State& state;
  const Turns* turns = nullptr;
  bool tells = true;  // false: the waits may be left out
};
// The part of a job's way that a closed condition blocks.
enum class Blocks {
  check,  // the check of a waiting job
  place,  // also its place in a round (capacity.h)
  start,  // also its admission in a group, its start once admitted, and the effect of its age
  plan,   // also the planning of its goal, and of goals behind it on its arm
};
enum class EndedBy {
  queue,   // the jobs before it on its arms
  job,     // another job, by moving or ending
  choice,  // the choice of another job's arm, for which no job needs to move
  planner,
  client,  // an operator or a signal
  task,    // its own actions
};
// A blocking condition: a row of the table in gates.cc. All who ask for conditions read this table.
struct Gate {
  // Returns what the job waits for; nullopt if the condition is open. The list is empty only for a
  // conflict without evidence.
  std::optional<FoundWaits> (*closed)(const Look& look, const Step& step);
  // Adds the edges from a job that stands to the jobs that it waits for. Null if it needs none.
  void (*edges)(const State& state, const Step& step, std::vector<WaitsForEdge>&);
  EndedBy ended_by;
  Blocks blocks;
  bool of_its_arm = false;    // is open for a job that has its turn on another arm
  bool starts_age = false;    // the job's age starts when it first waits for this
  bool defers_start = false;  // until then, the start is not compared with the arm's position
};
[[nodiscard]] inline bool blocks_start(const Gate& gate) { return gate.blocks >= Blocks::start; }
[[nodiscard]] inline bool blocks_plan(const Gate& gate) { return gate.blocks >= Blocks::plan; }
[[nodiscard]] inline bool is_ended_by_task(const Gate& gate) {
  return gate.ended_by == EndedBy::task;
}
[[nodiscard]] inline bool is_ended_by_client(const Gate& gate) {
  return gate.ended_by == EndedBy::client || is_ended_by_task(gate);
}
[[nodiscard]] inline bool defers_start(const Gate& gate) { return gate.defers_start; }

struct ClosedGate {
  const Gate& gate;
  FoundWaits waits;
};
// Returns the first blocking condition of the job; nullopt if it may be checked.
[[nodiscard]] std::optional<ClosedGate> closed_gate(const Turns& turns, const Step& step);
// Returns the first closed condition of those that `counts` selects, without turns (Look).
[[nodiscard]] std::optional<ClosedGate> first_closed(const State& state, const Step& step,
                                                     bool (*counts)(const Gate&));

// Returns true if such a condition is closed. Faster than first_closed().
[[nodiscard]] bool any_closed(const State& state, const Step& step, bool (*counts)(const Gate&));

// Returns true if the job waits for the actions of its task, and could start if they were done.
[[nodiscard]] bool lacks_only_actions(const State& state, const Step& step);
// Returns true if the job waits for no other job before its start.
[[nodiscard]] bool is_at_head(const State& state, const Step& step);
// Returns true if the job cannot move before other jobs have moved.
[[nodiscard]] bool stands(const State& state, const Step& step);

// Returns the waits-for graph of all jobs and arms at rest.
[[nodiscard]] WaitsFor waits_for(const State& state);
// Returns the part of the graph with these jobs and all that they wait for. Takes time only for
// that part.
[[nodiscard]] WaitsFor waits_for(const State& state, std::vector<JobId> jobs);

// Returns what the job's last check found, if it still applies; for an admitted job, what holds it
// back.
[[nodiscard]] FoundWaits found_in_the_way(const State& state, const Step& step);
// Returns true if the job is in conflict with a job or arm that moves only when `first` moves.
[[nodiscard]] bool is_found_in_the_way(const State& state, const Step& step, JobId first);
// Returns the waiting job that must move before the wait can end. nullopt if that job is already
// moving, or if there is no such job.
[[nodiscard]] std::optional<JobId> has_to_move_first(const State& state, const Wait& wait);

}  // namespace armloom
