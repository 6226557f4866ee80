#pragma once

#include <functional>

#include "core/scheduler/scheduler.h"

namespace armloom {

// What carries a YieldMove out, in the step that asked for it: `submit` is called with the way and,
// where the arm has a job, then with the way back; it gives each an id, which it returns. Not where
// a job that the way is about has ended meanwhile.
void make_way(const Scheduler& scheduler, const YieldMove& aside, Duration backlog_timeout,
              const std::function<JobId(Submit)>& submit);

}  // namespace armloom
