#pragma once

#include <functional>

#include "core/executive/execution.h"
#include "core/executive/job_register.h"
#include "core/executive/live_scene.h"
#include "core/executive/open_questions.h"
#include "core/executive/publishing.h"
#include "core/executive/session.h"
#include "core/executive/signals.h"
#include "core/executive/task.h"
#include "core/scheduler/scheduler.h"

namespace armloom {

// The modules that serve jobs and arms. All outlive their users, which derive from this privately.
struct Modules {
  CellPtr cell_;
  const Scheduler& scheduler_;
  TaskBook& tasks_;
  JobRegister& jobs_;
  LiveScene& scene_;
  Signals& signals_;
  Execution& execution_;
  OpenQuestions& questions_;
  Session& clock_;
  Publisher& publisher_;
  std::function<void(const Input&)> step_;
  // Gives the scheduler an input, and carries out its effects.
  void step(const Input& input) const { step_(input); }
};

}  // namespace armloom
