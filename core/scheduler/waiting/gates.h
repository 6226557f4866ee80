#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/deadlock/waits_for.h"
#include "core/scheduler/waiting/turns.h"

namespace armloom {

// The blocking conditions, in the order of checks. Selection, published waits, aging and the
// waits-for graph all read the list in gates.cc: a new condition is one entry of it.
enum class GateKind {
  behind,     // another job of its arm precedes it
  open_arm,   // a job with an undecided arm could bring this job's arm to its start
  after,      // a job in `after` has not ended
  plan,       // its path, its move-to-start or another path is being planned or checked
  lets_pass,  // an arm that has retreated lets another job pass
  stop,       // one of its arms is stopped
  place,      // the policy has no place for it
  conflict,   // checked and not admitted
  aging,      // an aged job goes first
};

// A wait of its own, or a view of the waits found by the last check.
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
[[nodiscard]] std::optional<ClosedGate> closed_gate(const Turns& turns, const Record& record);

// Returns the waits-for graph of all jobs and arms at rest.
[[nodiscard]] WaitsFor waits_for(const State& state);
// The same for these jobs and all that they wait for; costs only that part.
[[nodiscard]] WaitsFor waits_for(const State& state, std::vector<JobId> jobs);

// Returns the waits of the last check, if it still applies; for an admitted job, what holds it
// back.
[[nodiscard]] FoundWaits found_in_the_way(const State& state, const Record& record);
// Returns true if the job was found in conflict with what only `first` will move.
[[nodiscard]] bool is_found_in_the_way(const State& state, const Record& record, JobId first);
// Returns the job that must move before the wait can change; nullopt if it is moving, or never
// will.
[[nodiscard]] std::optional<JobId> has_to_move_first(const State& state, const Wait& wait);

}  // namespace armloom
