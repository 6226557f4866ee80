#include "core/executive/state_watch.h"

#include <cstdio>
#include <utility>

namespace armloom {

namespace {

using Kind = MonitorFinding::Kind;

std::string figure(const char* format, double value) {
  char text[48];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string about_pair(const MonitorFinding& finding) {
  const Proximity& pair = finding.proximity;
  std::string text = pair.body_a + " and " + pair.body_b;
  if (finding.kind == Kind::approach) {
    text += " may come closer than " + figure("%.4f m", finding.limit_m) + " unless an arm stops";
    return text;
  }
  text += pair.clearance_m < 0.0 ? " overlap by " + in_mm(pair.clearance_m)
                                 : figure(" at %.4f m", pair.clearance_m);
  return text + figure(", limit %.4f m", finding.limit_m);
}

std::string about_joint(const MonitorFinding& finding, const Cell& cell) {
  if (!finding.joint) return {};
  const Joint& joint = cell.joint(*finding.joint);
  return joint.name + figure(" by %.6g ", finding.value) + joint.unit() +
         figure(", limit %.6g ", finding.limit) + joint.unit();
}

}  // namespace

std::string sentence(const MonitorFinding& finding, const Cell& cell) {
  if (is_about_pair(finding.kind)) return about_pair(finding);
  const std::string arm = "arm " + (finding.arm ? cell.arm(*finding.arm).name : std::string());
  const std::string limit = figure("%.3f s", finding.limit);
  switch (finding.kind) {
    case Kind::deviation:
      return arm + " is off its path: " + about_joint(finding, cell);
    case Kind::unplanned_motion:
      return arm + " moved without a motion: " + about_joint(finding, cell);
    case Kind::early_finish:
      return arm + " finished away from its goal: " + about_joint(finding, cell);
    case Kind::beyond_authority:
      return arm + " passes its authority: it can rest at " + figure("%.3f s", finding.value) +
             " of its motion at the earliest, permitted " + limit;
    case Kind::stop_ignored:
      return arm + " still moves " + figure("%.3f s", finding.value) +
             " after it was told to brake, limit " + limit + ": its drives are switched off";
    case Kind::late_feedback:
      return arm + ": last report " + figure("%.3f s", finding.value) + " old, limit " + limit;
    case Kind::frozen_feedback:
      return arm + ": measured positions unchanged for " + figure("%.3f s", finding.value) +
             " in motion, limit " + limit;
    case Kind::implausible_feedback:
      return arm +
             ": positions changed faster than the joint can move: " + about_joint(finding, cell);
    default:
      return {};
  }
}

ClearanceQuery StateWatch::query_of(const PlanningScenePtr& scene) {
  const Cell& cell = scene->cell();
  return ClearanceQuery(scene, PairLimits::scaled(cell, cell.monitor.stop_clearance_m));
}

StateWatch::StateWatch(CellPtr cell, const PlanningScenePtr& scene)
    : period_(from_seconds(1.0 / cell->monitor.rate_hz)),
      query_(query_of(scene)),
      premises_(cell),
      look_ahead_(cell, period_),
      scene_(scene) {}

void StateWatch::follow(ClearanceQuery& query, PlanningScenePtr scene) {
  std::swap(query_, query);
  scene_ = std::move(scene);
  reaches_.reset();
  seen_.resize(0);
}

bool StateWatch::is_due(TimePoint now) {
  if (now < due_) return false;
  due_ = now + period_;
  return true;
}

bool StateWatch::look(const Configuration& measured, const std::vector<bool>& moving,
                      TimePoint now) {
  const bool is_seen = seen_.size() == measured.size() && seen_ == measured;
  if (is_seen && near_.is_current) return false;
  seen_ = measured;
  near_.is_current = period_ >= kShortPeriod || now >= near_.due;
  if (near_.is_current) {
    near_.pairs = query_.closest_apart(measured, kHorizon_m);
    near_.due = now + kNearPeriod;
  }
  const Configuration* state[] = {&measured};
  std::vector<Proximity> too_close;
  if (query_.too_close(state) != 0) too_close = query_.closest_too_close(measured);
  found_ = present_.observe(too_close, moving, now);
  return true;
}

std::vector<MonitorFinding> StateWatch::look_ahead(const Observation& seen,
                                                   const std::vector<bool>& stopping,
                                                   const AuthorityGate& gate) {
  struct Geometry final : ReachGeometry {
    explicit Geometry(StateWatch& w) : watch(w) {}
    ReachCheck& check() {
      if (watch.reaches_ == nullptr) {
        watch.reaches_ = std::make_unique<ReachCheck>(
            watch.scene_, watch.scene_->cell().monitor.stop_clearance_m);
      }
      return *watch.reaches_;
    }
    std::optional<Proximity> may_meet(const Reach& a, const Reach& b) override {
      return check().may_meet(a, b);
    }
    std::optional<Proximity> may_meet_scene(const Reach& reach) override {
      return check().may_meet_scene(reach);
    }
    StateWatch& watch;
  } geometry(*this);
  // While both arms are where their certificates assume, the guard's invariant proves the pair.
  struct Certified final : CertifiedPairs {
    Certified(const PremiseCheck& p, const AuthorityGate& g) : premises(p), gate(g) {}
    bool certifies(ArmId a, ArmId b) const override {
      if (!gate.is_certified()) return false;
      const bool holds = premises.is_as_certified(a) && premises.is_as_certified(b);
      return holds || gate.guard().certifies(a, b);
    }
    bool certifies_scene(ArmId arm) const override {
      if (!gate.is_certified()) return false;
      return premises.is_as_certified(arm) || gate.guard().certifies_scene(arm);
    }
    const PremiseCheck& premises;
    const AuthorityGate& gate;
  } certified(premises_, gate);
  return look_ahead_.check(seen, premises_, stopping, certified, geometry);
}

}  // namespace armloom
