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

// The evidence of a conflict: what a candidate would come too close to, where and when.
struct Conflict {
  enum class With {
    motion,  // another job's motion, or its rest after its end
    rest,    // an arm at rest that no job will move
    scene,   // an object, or a link that stands still
    self,    // the candidate's own links (Cell::is_own)
  };
  With with;
  JobId candidate;                 // whose motion
  std::optional<JobId> other_job;  // With::motion
  Proximity proximity;             // body_a belongs to the candidate
  Duration own_time;               // trajectory time of the candidate
  Duration other_time;             // trajectory time of the other job; zero where there is none
};

// To a PassageQuestion. What is not decided within the budget is blocked.
enum class PassageAnswer {
  free,
  blocked,
  apart,  // and so it is wherever both arms are
};

// What is proven to be kept, in m: no more than was asked of any pair of that kind.
struct ClearanceBound {
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  double apart_m =
      kNone;  // between arms, and by arms from all that stands still, their mounts among it
  double self_m = kNone;  // by links of one arm from each other (Cell::is_own)

  void lower(const ClearanceBound& other) {
    apart_m = std::min(apart_m, other.apart_m);
    self_m = std::min(self_m, other.self_m);
  }

  friend bool operator==(const ClearanceBound&, const ClearanceBound&) = default;
};

// The answer to a Question, with its evidence.
struct Verdict {
  enum class Kind { free, conflict, undecided };
  Kind kind;
  Version version;                  // of the question
  std::vector<Conflict> conflicts;  // the first one found with each counterpart; empty when free
  std::optional<ClearanceBound> clearance_bound;  // absent: nothing is proven
  std::uint64_t evaluations = 0;                  // combined states looked at
  // Where a policy has been asked too (executive/dry_run.h): the candidates would start this much
  // after the question's instant.
  std::optional<Duration> earliest_start = {};
  // Coordinated, and no conflict: every pair of a candidate and another motion or an arm at rest
  // that is not free everywhere.
  std::vector<PairRegions> regions = {};
  std::vector<PassageAnswer> passages = {};  // as in Question::passages; empty: all are free
  // Not all was decided, as the budget of evaluations ended: a larger Question::effort may find
  // more free.
  bool exhausted = false;
  // The check was ended early: everything else here is void.
  bool interrupted = false;
  // Free, and by a certified method: everything about the candidates that the answer proves.
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
