#pragma once

#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"

namespace armloom {

// What a job's turn goes by: as it was submitted, and kept with the job.
struct JobTerms {
  int priority = 0;  // larger goes first
  Duration backlog_timeout{};
  std::vector<JobId> after =
      {};                   // active jobs that have to succeed first; smaller ids than its own
  bool system_job = false;  // the server's own: in a ring it gives way to jobs of clients
  // Jobs of one arm that say so, and begin and end at one place, may be taken in another order.
  bool any_order = false;
  // It waited when a former run ended: whether it can begin where its arms stand is not looked at
  // while one of them is stopped, but when they are resumed. (As of those that Interrupt keeps.)
  bool is_held_over = false;
  // When its time in the backlog is over it is planned anew, before it expires (replanning.h).
  bool replans_on_timeout = false;
  // Arms that at its turn stand elsewhere than where it begins are brought there first
  // (approach.h).
  bool approaches = false;
};

}  // namespace armloom
