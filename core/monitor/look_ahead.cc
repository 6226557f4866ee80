#include "core/monitor/look_ahead.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/model/promises.h"

namespace armloom {
namespace {

// An arm that goes on keeps its rate to within this share of it.
constexpr double kRateChange = 0.1;
// An arm with a lower rate is about to stop or has just set out: it may take any rate.
constexpr double kStands = 0.01;

}  // namespace

LookAhead::LookAhead(CellPtr cell, Duration period)
    : cell_(std::move(cell)),
      period_(period),
      off_path_(cell_->arms.size()),
      paces_(cell_->arms.size()) {}

// ---- Where arms can get ----

// Returns the commanded rate of progress: trajectory time per time, one as planned. A motion that
// has just begun is assumed to go as planned until the next report. An arm whose report is overdue
// may have any rate.
std::optional<double> LookAhead::rate_of(const ArmObservation& now, std::optional<Duration> elapsed,
                                         Duration overdue, Pace& pace) const {
  if (pace.motion != now.motion) {
    pace.rate.reset();
    if (now.commanded <= period_) pace.rate = now.speed;
  } else if (elapsed) {
    const double rate = to_seconds(now.commanded - pace.commanded) / to_seconds(*elapsed);
    pace.rate = std::clamp(rate, 0.0, 1.0);
  } else if (now.feedback_age > overdue) {
    pace.rate.reset();
  }
  pace.motion = now.motion;
  pace.commanded = now.commanded;
  return pace.rate;
}

LookAhead::ArmReach LookAhead::reach_of(ArmId arm, const Observation& seen,
                                        const PremiseCheck& premises, bool is_stopping) {
  const ArmObservation& now = seen.arms[arm.index()];
  const ControllerDescription& controller = cell_->robots[cell_->arm(arm).robot.index()].controller;
  const Configuration zero = Configuration::Zero(seen.measured.size());
  Reach reach{.arm = arm, .rest = seen.measured, .shift = zero, .error = zero};
  ArmReach result{.braking = reach, .going = reach, .is_still = false};

  Pace& pace = paces_[arm.index()];
  const std::optional<Duration> elapsed =
      since(std::exchange(pace.reported, now.reported), now.reported);
  const std::optional<double> rate =
      rate_of(now, elapsed, promises_of(controller).until_told(), pace);
  const bool keeps_rate = rate && *rate >= kStands;
  // Reports that are later than promised show an earlier state, and commands may be as late.
  const Duration late =
      std::max(Duration{}, now.feedback_age - promises_of(controller).until_told());
  const Duration reaction = controller.reaction + 2 * late;
  const double highest = keeps_rate ? std::min(1.0, *rate * (1.0 + kRateChange)) : 1.0;
  Duration brakes_to{}, goes_to{};
  if (now.motion) {
    reach.motion = now.motion;
    reach.from = std::min(now.measured, now.motion->duration());
    const Duration limit = premises.keeps_authority(arm) ? now.authority : now.motion->duration();
    const Duration end = std::max(reach.from, std::min(limit, now.motion->duration()));
    // Progress at the highest rate until the brake takes effect. The way of a brake grows with the
    // square of the rate.
    const Duration commanded = std::max(now.commanded, now.measured);
    const double brakes = std::min(1.0, highest * highest / now.brake);
    const Duration way = from_seconds(highest * to_seconds(reaction) +
                                      brakes * to_seconds(premises.stopping_reach(arm)));
    brakes_to = now.rests ? reach.from : std::min(end, commanded + way);
    if (now.brakes && now.rests_at) {
      brakes_to = std::clamp(*now.rests_at, reach.from, now.motion->duration());
    }
    const Duration more = from_seconds(highest * to_seconds(period_));
    goes_to = now.rests ? reach.from : std::min(end, brakes_to + more);
    if (now.feedback_age > controller.feedback_timeout) brakes_to = goes_to = end;
    if (now.brakes || is_stopping) goes_to = brakes_to;
  }
  result.is_still = !now.motion || now.rests;

  // An arm that is not where its certificates assume: each joint goes on at its measured speed away
  // from the path until the brake has stopped it.
  if (premises.is_as_certified(arm)) {
    off_path_[arm.index()].reset();
  } else {
    OffPath off{zero, premises.velocity()};
    if (now.motion) {
      const PathDistance near = premises.nearest(arm, seen);
      reach.from = std::min(near.progress, brakes_to);
      Eigen::VectorXd path;
      now.motion->sample_positions(near.progress, path);
      off.velocity.setZero();
      const auto& before = off_path_[arm.index()];
      for (std::size_t row = 0; row < now.motion->joints().size(); ++row) {
        const JointId joint = now.motion->joints()[row];
        if (cell_->joint(joint).arm != arm) continue;
        const auto j = static_cast<Eigen::Index>(joint.index());
        off.shift[j] = seen.measured[j] - path[static_cast<Eigen::Index>(row)];
        const double then = before ? before->shift[j] : 0.0;
        const double since_s = to_seconds(elapsed.value_or(period_));
        off.velocity[j] =
            before && !elapsed ? before->velocity[j] : (off.shift[j] - then) / since_s;
      }
    }
    for (const JointId joint : premises.joints(arm)) {
      const auto j = static_cast<Eigen::Index>(joint.index());
      const double speed =
          std::min(std::abs(off.velocity[j]), PremiseCheck::velocity_limit(*cell_, joint));
      const double more = speed * to_seconds(reaction) +
                          speed * speed / (2.0 * now.brake * cell_->joint(joint).brake);
      reach.shift[j] = off.shift[j] + std::copysign(0.5 * more, off.velocity[j]);
      reach.error[j] = 0.5 * more;
      if (more > 0.0) result.is_still = false;
    }
    off_path_[arm.index()] = std::move(off);
  }
  reach.slack = period_;
  result.braking = reach;
  result.braking.to = std::max(reach.from, brakes_to);
  result.going = std::move(reach);
  result.going.to = std::max(result.going.from, goes_to);
  // An arm that stands on its path may set out at any time.
  if (keeps_rate) {
    result.going.rate_low = *rate * (1.0 - kRateChange);
    result.going.rate_high = highest;
    // An arm follows its commands with a first-order lag. It falls behind further until it is
    // behind by lag * rate.
    const Duration behind = now.commanded - now.measured;
    const Duration lag = from_seconds(*rate * to_seconds(controller.lag));
    result.going.late = std::max(Duration{}, lag - behind);
  }
  result.may_go_on = result.going.to > result.braking.to;
  if (!result.may_go_on) result.going = result.braking;
  return result;
}

// ---- Conflicts ----

void LookAhead::compare(ArmId a, ArmId b, const std::vector<ArmReach>& reaches,
                        ReachGeometry& geometry, std::vector<Predicted>& predicted) const {
  const ArmReach& of_a = reaches[a.index()];
  const ArmReach& of_b = reaches[b.index()];
  const auto evidence = geometry.may_meet(of_a.going, of_b.going);
  if (!evidence) return;
  Predicted made{.conflict = {.a = a}, .evidence = *evidence, .other = b};
  if (of_a.may_go_on && of_b.may_go_on) {
    made.conflict.b = b;
    made.conflict.a_suffices = !geometry.may_meet(of_a.braking, of_b.going);
    made.conflict.b_suffices = !geometry.may_meet(of_a.going, of_b.braking);
    made.can_be_resolved = true;
  } else if (of_a.may_go_on || of_b.may_go_on) {
    made.conflict.a = of_a.may_go_on ? a : b;
    made.can_be_resolved = true;
  }
  predicted.push_back(std::move(made));
}

std::vector<MonitorFinding> LookAhead::check(const Observation& seen, const PremiseCheck& premises,
                                             const std::vector<bool>& stopping,
                                             const CertifiedPairs& certified,
                                             ReachGeometry& geometry) {
  const std::size_t count = seen.arms.size();
  std::vector<ArmReach> reaches;
  for (std::uint32_t a = 0; a < count; ++a) {
    reaches.push_back(reach_of(ArmId{a}, seen, premises, stopping[a]));
  }
  std::vector<Predicted> predicted;
  for (std::uint32_t a = 0; a < count; ++a) {
    const ArmId arm{a};
    for (std::uint32_t b = a + 1; b < count; ++b) {
      const ArmId other{b};
      if (reaches[a].is_still && reaches[b].is_still) continue;
      // Certificates end at the authority.
      const bool keep = premises.keeps_authority(arm) && premises.keeps_authority(other);
      if (keep && certified.certifies(arm, other)) continue;
      compare(arm, other, reaches, geometry, predicted);
    }
    if (reaches[a].is_still || certified.certifies_scene(arm)) continue;
    if (auto evidence = geometry.may_meet_scene(reaches[a].going)) {
      predicted.push_back({.conflict = {.a = arm},
                           .evidence = std::move(*evidence),
                           .other = {},
                           .can_be_resolved = reaches[a].may_go_on});
    }
  }

  std::vector<StopConflict> conflicts;
  for (const Predicted& one : predicted) {
    if (one.can_be_resolved) conflicts.push_back(one.conflict);
  }
  const std::vector<ArmId> stops = smallest_stop_set(conflicts);

  std::erase_if(known_,
                [&seen](const auto& known) { return seen.time - known.second >= kSameCondition; });
  std::vector<MonitorFinding> found;
  for (Predicted& one : predicted) {
    const Conflicting pair{
        std::min(one.conflict.a, one.other.value_or(one.conflict.a)),
        one.other ? std::optional(std::max(one.conflict.a, *one.other)) : std::nullopt};
    const bool is_new = known_.insert_or_assign(pair, seen.time).second;
    MonitorFinding finding{.kind = MonitorFinding::Kind::approach,
                           .time = seen.time,
                           .proximity = std::move(one.evidence)};
    finding.limit_m = finding.proximity.limit_m;
    for (const ArmId arm : stops) {
      const bool concerns = one.can_be_resolved && (arm == one.conflict.a || arm == one.conflict.b);
      if (concerns) finding.stops.push_back(arm);
    }
    if (is_new || !finding.stops.empty()) found.push_back(std::move(finding));
  }
  return found;
}

}  // namespace armloom
