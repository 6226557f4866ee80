#pragma once

#include "core/executive/events.h"
#include "core/executive/task.h"
#include "core/executive/views.h"
#include "core/scheduler/scheduler.h"

namespace armloom {

// Returns the view of a task as one job.
[[nodiscard]] JobView view_of(const Task& task, const Scheduler& scheduler, const Cell& cell,
                              const JobNames& names);

// Returns what a step does: "part to left_hand".
[[nodiscard]] std::string text_of(const StepRequest& step);

}  // namespace armloom
