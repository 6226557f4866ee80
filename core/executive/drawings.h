#pragma once

#include <deque>
#include <functional>
#include <string>

#include "core/executive/executive.h"
#include "core/executive/job_register.h"
#include "core/executive/live_scene.h"
#include "core/executive/task.h"

namespace armloom {

// Draws coordination diagrams of two jobs, for users who want to see why one job waits. Caches the
// last diagrams, because a client that shows a diagram requests it again and again with the present
// progress.
class Drawings {
 public:
  // All arguments outlive this object.
  Drawings(const Scheduler& scheduler, const TaskBook& tasks, const JobRegister& jobs,
           JudgementService& judges)
      : scheduler_(scheduler), tasks_(tasks), jobs_(jobs), judges_(judges) {}

  // Two jobs by key, and the scene and time of the request (Inquiries::diagram()).
  struct Asked {
    std::string key_a, key_b;
    VersionedScene in;
    TimePoint now;
  };
  void draw(const Asked& asked, std::function<void(Result<DiagramView>)> done);

 private:
  struct Drawn {
    TrajectoryPtr a, b;
    Configuration rest;
    std::uint64_t scene_version;
    Diagram diagram;
  };
  [[nodiscard]] Result<const Step*> known(const std::string& key, const std::string& pointer) const;
  [[nodiscard]] DiagramView::Side side_of(const Step& step) const;

  const Scheduler& scheduler_;
  const TaskBook& tasks_;
  const JobRegister& jobs_;
  JudgementService& judges_;
  std::deque<Drawn> drawn_;  // newest first
};

}  // namespace armloom
