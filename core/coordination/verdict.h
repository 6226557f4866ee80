#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/coordination/certificate.h"
#include "core/coordination/conflict_region.h"
#include "core/coordination/proximity.h"

namespace armloom {

// Evidence of a conflict: the bodies that come too close, with the place and times.
struct Conflict {
  enum class With {
    motion,  // another step's motion, or its arms at rest after its end
    rest,    // an arm at rest that no job will move
    scene,   // an object, or a stationary link
    self,    // the candidate's own links (Cell::is_own)
  };
  With with;
  StepId candidate;                  // the step whose motion comes too close
  std::optional<StepId> other_step;  // With::motion
  Proximity proximity;               // body_a belongs to the candidate
  Duration own_time;                 // trajectory time of the candidate
  Duration other_time;               // trajectory time of the other step, or zero
};

// Answer to a PassageQuestion. A passage that cannot be decided within the budget is `blocked`.
enum class PassageAnswer {
  free,
  blocked,
  apart,  // free in all positions of both arms
};

// Evidence that a passage is blocked: the pair that comes too close. body_a belongs to the passing
// motion, body_b to the arm at rest.
struct PassageBlock {
  Proximity proximity;
  Duration time;  // in the passing motion
};

// Proven clearance (m): for each kind of pair, the smallest clearance that the check required.
struct ClearanceBound {
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  // Between arms, and from arms to everything stationary, including their mounts.
  double apart_m = kNone;
  double self_m = kNone;  // between links of one arm (Cell::is_own)

  void lower(const ClearanceBound& other) {
    apart_m = std::min(apart_m, other.apart_m);
    self_m = std::min(self_m, other.self_m);
  }

  friend bool operator==(const ClearanceBound&, const ClearanceBound&) = default;
};

struct Verdict {
  enum class Kind { free, conflict, undecided };
  Kind kind;
  Version version;                  // of the question
  std::vector<Conflict> conflicts;  // the first conflict with each counterpart; empty when free
  std::optional<ClearanceBound> clearance_bound;  // nullopt if nothing is proven
  std::uint64_t evaluations = 0;                  // combined states checked
  // If a policy was asked too (executive/dry_run.h): delay until the candidates would start.
  std::optional<Duration> earliest_start = {};
  // Filled by Coordinated if there is no conflict: every pair of a candidate and another motion or
  // resting arm that is not free in all states, with its conflict regions.
  std::vector<PairRegions> regions = {};
  std::vector<PassageAnswer> passages = {};  // answers to Question::passages; empty if all are free
  // One for each of `passages`, with the evidence if it is blocked; or empty.
  std::vector<std::optional<PassageBlock>> passage_blocks = {};
  // The budget of evaluations ran out. A larger Question::effort may find more states free.
  bool exhausted = false;
  // The check was aborted: all other members are void.
  bool interrupted = false;
  // If the candidates are free by a certified method: all that is proven about them.
  std::vector<Certificate> certificates = {};
};
[[nodiscard]] constexpr const char* to_string(Verdict::Kind kind) {
  switch (kind) {
    case Verdict::Kind::free:
      return "free";
    case Verdict::Kind::conflict:
      return "conflict";
    case Verdict::Kind::undecided:
      return "undecided";
  }
  return nullptr;
}

}  // namespace armloom
