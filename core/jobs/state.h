#pragma once

#include <memory>
#include <set>
#include <vector>

#include "core/jobs/arm_rests.h"
#include "core/jobs/expectation.h"
#include "core/jobs/inputs.h"
#include "core/jobs/job_book.h"
#include "core/jobs/lanes.h"
#include "core/model/cell.h"
#include "core/precedence/precedence_graph.h"

namespace armloom {

class Policy;

// The jobs that have a place now, under policies with rounds; else empty.
struct Round {
  std::set<JobId> jobs = {};
  bool has_begun = false;  // one of them has moved
};

struct Decided {
  std::vector<YieldMove> sent_aside = {};
  std::vector<Effect> effects = {};
};

// What the rooms of the scheduler share: who is there, where everything stands, what is admitted;
// and what the present step has decided so far. A copy is independent of it (Trial).
struct State {
  CellPtr cell;
  std::shared_ptr<const Policy> policy;
  JobBook jobs;
  ArmRests arms;
  Lanes lanes;
  PrecedenceGraph graph;      // all that is admitted
  Expectation expected = {};  // of what is admitted
  Round round = {};
  Version version = 1;      // of what is admitted, and of where arms rest
  Version scene_epoch = 0;  // the last version that began with another scene
  TimePoint now{};          // of the present step
  Decided decided = {};     // in the present step

  State(CellPtr description, std::shared_ptr<const Policy> chosen, Configuration rest, JobId first)
      : cell(std::move(description)),
        policy(std::move(chosen)),
        jobs(cell->arms.size(), first),
        arms(*cell, std::move(rest)),
        lanes(cell->execution.start_tolerance_rad),
        graph(cell->arms.size()) {}

  // What was found of a job that waits still holds. Precondition: it waits.
  [[nodiscard]] bool is_judged(const Job& job) const {
    const Judgement& found = job.judgement();
    if (found.at != version) return false;
    return !found.in_turn_after || lanes.goes_before(*found.in_turn_after, job.id);
  }
};

}  // namespace armloom
