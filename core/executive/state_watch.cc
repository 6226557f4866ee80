#include "core/executive/state_watch.h"

#include <cstdio>
#include <utility>

namespace armloom {

std::string sentence(const MonitorFinding& finding) {
  char text[256];
  std::snprintf(text, sizeof text, "monitor: %s and %s at %.4f m, limit %.4f m",
                finding.proximity.body_a.c_str(), finding.proximity.body_b.c_str(),
                finding.proximity.clearance_m, finding.limit_m);
  return text;
}

ClearanceQuery StateWatch::query_of(const PlanningScenePtr& scene) {
  const Cell& cell = scene->cell();
  return ClearanceQuery(scene, PairLimits::scaled(cell, cell.monitor.stop_clearance_m));
}

StateWatch::StateWatch(const PlanningScenePtr& scene)
    : period_(from_seconds(1.0 / scene->cell().monitor.rate_hz)), query_(query_of(scene)) {}

void StateWatch::follow(ClearanceQuery& query) {
  std::swap(query_, query);
  seen_.resize(0);
}

bool StateWatch::is_due(TimePoint now) {
  if (now < due_) return false;
  due_ = now + period_;
  return true;
}

bool StateWatch::look(const Configuration& measured, const std::vector<bool>& moving,
                      TimePoint now) {
  if (seen_.size() == measured.size() && seen_ == measured) return false;
  seen_ = measured;
  near_ = query_.closest_apart(measured, kHorizon_m);
  const Configuration* state[] = {&measured};
  std::vector<Proximity> too_close;
  if (query_.too_close(state) != 0) too_close = query_.closest_too_close(measured);
  found_ = monitor_.observe(too_close, moving, now);
  return true;
}

}  // namespace armloom
