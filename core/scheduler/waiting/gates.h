#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/deadlock/waits_for.h"
#include "core/scheduler/waiting/turns.h"

namespace armloom {

// The blocking conditions, in the order in which they are checked. The choice of the next job,
// published waits, aging and the waits-for graph all use the one list in gates.cc. A new condition
// is a new entry of that list.
enum class GateKind {
  behind,     // another job of its arm precedes it
  open_arm,   // a job with an undecided arm could bring this job's arm to its start
  after,      // a job in `after` has not ended
  plan,       // a path of the job is being planned, or its move-to-start is being checked
  lets_pass,  // its arm has retreated and first lets another job pass
  stop,       // one of its arms is stopped
  place,      // the policy allows no further job at the same time
  conflict,   // checked and not admitted
  aging,      // an aged job goes first
};

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

struct ClosedGate {
  GateKind kind;
  FoundWaits waits;  // never empty, except for a conflict without evidence
};
// Returns the first blocking condition of the job; nullopt if it may be checked.
[[nodiscard]] std::optional<ClosedGate> closed_gate(const Turns& turns, const Step& step);

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
