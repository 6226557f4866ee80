#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
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

// The answer to a Question, with its evidence.
struct Verdict {
  enum class Kind { free, conflict, undecided };
  Kind kind;
  Version version;                  // of the question
  std::vector<Conflict> conflicts;  // the first one found with each counterpart; empty when free
  // What is proven to be kept between arms, and by arms from the scene, their mounts among it: no
  // more than was asked of any such pair (of what is an arm's own, Cell::is_own, it says nothing).
  // Absent: nothing is proven.
  std::optional<double> clearance_bound_m;
  std::uint64_t evaluations = 0;  // combined states looked at
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
};

}  // namespace armloom
