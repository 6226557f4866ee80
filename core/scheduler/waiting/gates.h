#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/deadlock/waits_for.h"
#include "core/scheduler/waiting/turns.h"

namespace armloom {

// The reasons for which a job waits, in the order in which they are looked at. Selection, what
// clients are told, aging and the waits-for graph read this one list (gates.cc): a new reason to
// wait is one entry of it.
enum class GateKind {
  behind,     // another job of its arm comes before it
  open_arm,   // one that any of several arms may do could leave it where this begins
  after,      // a job that it comes after has not ended
  plan,       // its way, or that to its start, is not planned yet, or another one is looked for
  lets_pass,  // an arm that is aside lets another one pass
  stop,       // an arm of it is stopped
  place,      // the policy has no place for it
  conflict,   // judged, and not let go, as things stand
  aging,      // an older one comes first
};

// What a job waits for: one thing, or what was found when it was judged, which stays where it is.
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
  FoundWaits waits;  // never empty, but of a conflict that named nothing
};
// The first that is closed for this job; nothing: it may be judged.
[[nodiscard]] std::optional<ClosedGate> closed_gate(const Turns& turns, const Record& record);

// Who cannot move before whom, of all that stands.
[[nodiscard]] WaitsFor waits_for(const State& state);
// The part of that graph which these jobs wait for, directly or through others. Costs what it
// reaches, not what waits.
[[nodiscard]] WaitsFor waits_for(const State& state, std::vector<JobId> jobs);

// What was found when it was judged last, if that still counts; of what is admitted, what holds it.
[[nodiscard]] FoundWaits found_in_the_way(const State& state, const Record& record);
// Returns true if the job was found in conflict with what only `first` will move.
[[nodiscard]] bool is_found_in_the_way(const State& state, const Record& record, JobId first);
// The job that has to move before what is waited for changes; nothing: it moves, or never will.
[[nodiscard]] std::optional<JobId> has_to_move_first(const State& state, const Wait& wait);

}  // namespace armloom
