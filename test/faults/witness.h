#pragma once

#include <algorithm>
#include <bit>
#include <cstdio>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/audit/audit.h"
#include "core/collision/state/clearance_query.h"
#include "core/executive/live_scene.h"
#include "core/executive/simulation.h"
#include "test/faults/fault_run.h"
#include "test/scenarios/random_tasks.h"

namespace armloom {

// Collects what an audit needs, and what the monitor does.
class Witness final : public Observer {
 public:
  static constexpr Duration kSample = std::chrono::milliseconds(5);  // between audited states
  static constexpr std::size_t kStatesMax = 20'000;                  // that are audited at once

  Witness(CellPtr cell, bool verbose) : cell_(std::move(cell)), verbose_(verbose) {}

  void on_event(const Event& event) override {
    mix(event.seq);
    mix(static_cast<std::uint64_t>(event.time.time_since_epoch().count()));
    mix(event.body.index());
    if (verbose_) print(event);
    if (const auto* job = std::get_if<JobView>(&event.body)) {
      if (is_terminal(job->state)) {
        open.erase(job->key);
      } else {
        open.insert(job->key);
      }
    }
    if (const auto* arm = std::get_if<ArmView>(&event.body)) jobs_[arm->name] = arm->job;
    if (std::holds_alternative<GuardEvent>(event.body)) ++refusals;
    if (const auto* found = std::get_if<MonitorEvent>(&event.body)) see(event.time, *found);
    if (const auto* scene = std::get_if<SceneView>(&event.body)) see(event.time, *scene);
  }
  void on_tick(TimePoint, const Configuration&) override {}
  void on_state(const StateFrame&) override {}

  void on_truth(TimePoint now, const Configuration& q) override {
    if (now < next_) return;
    next_ = now + kSample;
    for (const double position : q) mix(std::bit_cast<std::uint64_t>(position));
    if (watch_ && now >= watch_->from) look(q);
    if (!states_.empty() && states_.back().q == q) {
      rests_until_ = now;
      return;
    }
    if (rests_until_ && *rests_until_ > states_.back().time) {
      states_.push_back({*rests_until_, states_.back().q, true});
    }
    rests_until_.reset();
    states_.push_back({now, q});
    if (states_.size() >= kStatesMax) audit_states();
  }

  void audit_states() {
    if (states_.empty()) return;
    const auto report = audit(*cell_, states_, kSample, scenes_);
    if (!report) throw std::runtime_error(report.error().front().detail);
    if (!contact) contact = report->first_contact;
    if (report->smallest_clearance) {
      closest_m = std::min(closest_m, report->smallest_clearance->distance_m);
    }
    states_.erase(states_.begin(), std::prev(states_.end()));
    while (scenes_.size() > 1 && scenes_[1].time <= states_.front().time) {
      scenes_.erase(scenes_.begin());
    }
  }

  // From now on, keeps the scenes that are published for the audit, and counts the parts in them.
  void watch(RandomTasks& tasks, Executive& executive) {
    tasks_ = &tasks;
    executive_ = &executive;
  }
  // From now on, measures the distances of one arm.
  struct Watched {
    ArmId arm;
    TimePoint from;
    ClearanceQuery query;
  };
  void watch(Watched watched) { watch_.emplace(std::move(watched)); }

  std::set<std::string> faulty;  // names
  std::set<std::string> open;    // keys of jobs that have not ended
  std::set<std::string> lost;    // parts that were not at exactly one place
  std::vector<FaultRunResult::MonitorStop> stops;
  std::size_t stops_of_faulty = 0;
  std::uint64_t refusals = 0, fingerprint = 14695981039346656037U;
  std::optional<AuditFinding> contact;
  double closest_m = 1e9;
  double watched_m = 2.0;

 private:
  void mix(std::uint64_t word) { fingerprint = (fingerprint ^ word) * 1099511628211U; }

  static void print(const Event& event) {
    std::string text;
    if (const auto* alert = std::get_if<Alert>(&event.body)) text = alert->text;
    if (const auto* job = std::get_if<JobView>(&event.body)) text = told(*job);
    if (!text.empty()) std::fprintf(stderr, "%9.3f s  %s\n", to_seconds(event.time), text.c_str());
  }

  void see(TimePoint time, const MonitorEvent& event) {
    const auto is_excused = [&](const std::string& arm) {
      return std::ranges::any_of(faulty, [&](const std::string& other) {
        return other == arm || (!jobs_[arm].empty() && jobs_[arm] == jobs_[other]);
      });
    };
    for (const std::string& arm : event.stopped) {
      if (is_excused(arm)) {
        ++stops_of_faulty;
      } else {
        stops.push_back({time, *cell_->find_arm(arm), arm});
      }
    }
  }

  void see(TimePoint time, const SceneView& view) {
    if (tasks_ == nullptr) return;
    const PlanningScene& scene = *executive_->scene().scene();
    scenes_.push_back({time, scene.objects(), scene.attachments(), scene.touch()});
    for (const std::string& part : tasks_->see(view)) lost.insert(part);
  }

  void look(const Configuration& q) {
    for (const Proximity& pair : watch_->query.closest_apart(q, watched_m).apart) {
      if (pair.arm_a == watch_->arm || pair.arm_b == watch_->arm) {
        watched_m = std::min(watched_m, pair.clearance_m);
      }
    }
  }

  CellPtr cell_;
  bool verbose_;
  std::map<std::string, std::string> jobs_;  // by arm
  std::vector<RecordedState> states_;
  std::vector<RecordedScene> scenes_;
  RandomTasks* tasks_ = nullptr;
  Executive* executive_ = nullptr;
  std::optional<TimePoint> rests_until_;
  TimePoint next_{};
  std::optional<Watched> watch_;
};

}  // namespace armloom
