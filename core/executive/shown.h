#pragma once

#include "core/executive/authority_gate.h"
#include "core/executive/job_register.h"
#include "core/executive/live_scene.h"
#include "core/executive/motions.h"
#include "core/executive/signals.h"
#include "core/executive/start_gate.h"
#include "core/executive/task.h"
#include "core/scheduler/scheduler.h"

namespace armloom {

// The objects whose state is published. All of them outlive the publisher.
struct Shown {
  const Cell& cell;
  const Scheduler& scheduler;
  const Motions& motions;
  const AuthorityGate& gate;
  const JobRegister& jobs;
  const StartGate& starts;
  const LiveScene& scene;
  const Signals& signals;
  const TaskBook& tasks;
};

}  // namespace armloom
