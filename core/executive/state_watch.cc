#include "core/executive/state_watch.h"

#include <cstdio>
#include <utility>

namespace armloom {

std::string sentence(const MonitorFinding& finding) {
  const Proximity& pair = finding.proximity;
  char figures[96];
  std::snprintf(figures, sizeof figures, " at %.4f m", pair.clearance_m);
  std::string text = "monitor: " + pair.body_a + " and " + pair.body_b;
  text += pair.clearance_m < 0.0 ? " overlap by " + in_mm(pair.clearance_m) : figures;
  std::snprintf(figures, sizeof figures, ", limit %.4f m", finding.limit_m);
  return text + figures;
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
