#include "core/executive/watching.h"

#include <algorithm>
#include <utility>

#include "core/executive/arms_of.h"
#include "core/executive/observe.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

MonitorEvent event_of(const MonitorFinding& finding, const Cell& cell) {
  MonitorEvent event{.finding = finding, .text = sentence(finding, cell)};
  if (finding.joint) event.joint = cell.joint(*finding.joint).name;
  for (const auto& arm : {finding.arm, finding.proximity.arm_a, finding.proximity.arm_b}) {
    if (arm && (event.arms.empty() || event.arms.front() != cell.arm(*arm).name)) {
      event.arms.push_back(cell.arm(*arm).name);
    }
  }
  event.stopped = each_name(cell, finding.stops);
  return event;
}

}  // namespace

ArmWatch::ArmWatch(const Modules& modules, Calls calls)
    : Modules(modules),
      calls_(std::move(calls)),
      watch_(cell_, scene_.scene()),
      links_(cell_->arms.size()) {}

void ArmWatch::tick() {
  watch_links();
  if (clock_.monitored && watch_.is_due(clock_.now)) watch();
}

void ArmWatch::take(const MotionReport& report) {
  const Step* moved = scheduler_.find(report.step.job);
  const bool is_watched = clock_.monitored && moved != nullptr;
  if (report.kind != MotionReport::Kind::finished || !is_watched) return step(report);
  const Motions& motions = execution_.motions();
  std::vector<MonitorFinding> found;
  for (const ArmId arm : moved->trajectory->arms()) {
    auto early =
        watch_.premises().finished(arm, *moved->trajectory, motions.measured(), clock_.now);
    if (early) found.push_back(std::move(*early));
  }
  if (found.empty()) return step(report);
  MotionReport failed = report;
  failed.kind = MotionReport::Kind::faulted;
  failed.detail = sentence(found.front(), *cell_);
  step(failed);
  act_on(found);
}

void ArmWatch::watch() {
  publisher_.tell_watch();
  const Motions& motions = execution_.motions();
  Observation seen = observed(motions, execution_.gate(), cell_->arms.size(), clock_.now);
  for (ArmId arm : all_arms(*cell_)) {
    seen.arms[arm.index()].is_stopped = scheduler_.state().arms.stop_of(arm).has_value();
  }
  std::vector<MonitorFinding> found = watch_.check_premises(seen);
  std::vector<bool> moving;
  for (ArmId arm : all_arms(*cell_)) {
    moving.push_back(motions.moving(arm));
    execution_.gate().leaves_path(arm, watch_.premises().deviation(arm));
  }
  if (watch_.look(seen.measured, moving, clock_.now)) {
    clock_.count.look(watch_.near().apart);
    clock_.count.look(watch_.near().at_mount);
    found.insert(found.end(), watch_.found().begin(), watch_.found().end());
  }
  std::vector<bool> stopping(cell_->arms.size(), false);
  for (const MonitorFinding& finding : found) {
    for (const ArmId arm : finding.stops) stopping[arm.index()] = true;
  }
  for (MonitorFinding& ahead : watch_.look_ahead(seen, stopping, execution_.gate())) {
    found.push_back(std::move(ahead));
  }
  act_on(found);
  for (const ArmId arm : all_arms(*cell_)) {
    if (watch_.premises().rests_elsewhere(arm) || scheduler_.state().arms.is_unlocated(arm))
      locate(arm);
  }
  publisher_.tell_state(watch_.near().apart, clock_.now);
}

// An arm whose link is lost comes to rest by itself, within its authority. It stays stopped until
// it is resumed, also when the link is back. The first connection ends only the stop that waited
// for it: an arm that was stopped, or that moved for another server, does not move before a resume.
void ArmWatch::watch_links() {
  for (const LinkWatch::Change& change : links_.look(execution_.motions())) {
    using Kind = LinkWatch::Change::Kind;
    const std::string& arm = cell_->arm(change.arm).name;
    switch (change.kind) {
      case Kind::waits:
        tell_unlocated(change.arm);
        step(Stop({{change.arm, "its controller has not connected: " + change.detail, true}}));
        publisher_.tell(
            Alert{Alert::Level::info, arm + " waits for its controller: " + change.detail},
            clock_.now);
        break;
      case Kind::in_use:
        tell_unlocated(change.arm);
        calls_.stop(change.arm, "its controller served another server: " + change.detail);
        break;
      case Kind::lost:
        calls_.stop(change.arm, "link lost: " + change.detail);
        break;
      case Kind::stopped:
        calls_.stop(change.arm, "its controller stopped the arm by itself");
        break;
      case Kind::connected:
      case Kind::back:
        if (change.kind == Kind::connected) locate(change.arm);
        if (const auto& stop = scheduler_.state().arms.stop_of(change.arm);
            stop && stop->until_connected) {
          calls_.resume(change.arm);
          break;
        }
        publisher_.tell(Alert{Alert::Level::info, "arm " + arm +
                                                      ": its controller reports again; the arm "
                                                      "stays stopped until it is resumed"},
                        clock_.now);
        break;
    }
  }
}

// Tells the scheduler that the arm may be anywhere.
void ArmWatch::tell_unlocated(ArmId arm) {
  std::vector<ArmId> may_meet;
  for (const ArmId other : all_arms(*cell_)) {
    if (other != arm && !scene_.scene()->out_of_reach(arm, other)) may_meet.push_back(other);
  }
  step(Unlocated{arm, std::move(may_meet)});
}

void ArmWatch::locate(ArmId arm) {
  const ArmLink& link = execution_.motions().link(arm);
  if (link.state() != ArmLink::State::up || !link.feedback().at_rest) return;
  const Eigen::VectorXd off =
      link.feedback().measured -
      joints_of(scheduler_.state().arms.rest(), execution_.motions().joints(arm));
  const bool is_there = off.cwiseAbs().maxCoeff() <= cell_->tracking_error(cell_->arm(arm).robot);
  if (is_there && !scheduler_.state().arms.is_unlocated(arm)) return;
  step(Located{arm, link.feedback().measured});
}

// Publishes the findings and stops their arms, each with the first finding that names it as cause.
void ArmWatch::act_on(const std::vector<MonitorFinding>& found) {
  std::vector<Stop::StoppedArm> stopped;
  for (const MonitorFinding& finding : found) {
    if (!finding.stops.empty()) clock_.count.monitor_stop();
    MonitorEvent event = event_of(finding, *cell_);
    for (const ArmId arm : finding.stops) {
      if (std::ranges::find(stopped, arm, &Stop::StoppedArm::arm) != stopped.end()) continue;
      stopped.push_back({arm, "monitor: " + event.text});
      // The scheduler brakes motions only.
      const bool is_ignored = finding.kind == MonitorFinding::Kind::stop_ignored;
      if (is_ignored) execution_.brake(arm, StopCategory::switch_off);
      if (!is_ignored && !execution_.motions().trajectory(arm)) execution_.brake(arm);
    }
    publisher_.tell(std::move(event), clock_.now);
  }
  if (stopped.empty()) return;
  const std::size_t count = stopped.size();
  step(Stop(std::move(stopped)));
  publisher_.tell_monitor_stop(count);
}

}  // namespace armloom
