#pragma once

#include <string>
#include <unordered_set>
#include <vector>

#include "core/executive/live_scene.h"
#include "core/model/cell.h"
#include "server/durable/job_keeper.h"
#include "server/store/job_history.h"

namespace armloom {

// Restores the jobs that the previous session left.
// - Jobs that had not begun are submitted again, with their ids, order and conditions.
// - Jobs that had or may have begun become `interrupted`; jobs that must run `after` them fail.
// - Jobs that no longer fit the cell become `interrupted`, too.
class Restart {
 public:
  // Ends the jobs that cannot be restored, and returns when this is on disk. Problem (unavailable):
  // the store cannot be written.
  [[nodiscard]] static Result<Restart> prepare(JobKeeper& keeper);

  // The executive's first task. Restores the speed overrides and the scene, then stops all arms in
  // four cases:
  // - The cell's `on_restart` is `ask`, and jobs were left.
  // - The scene could not be restored completely.
  // - A speed override could not be restored.
  // - It is unknown which arms were stopped when the previous session ended.
  // Otherwise stops only the arms that were stopped then. Then restores the jobs. `keeper` must
  // outlive the executive's tasks.
  void go_on(Executive& executive, const Cell& cell, JobKeeper& keeper);

 private:
  struct WrittenOff {
    StoredJob job;
    JobState state;
    Reason reason;
    std::string detail;
  };
  void sort_out(const LeftJob& left, const JobKeeper& keeper);
  [[nodiscard]] bool failed_before(const JobRequest& request) const;
  void write_off(const StoredJob& job, JobState state, Reason reason, std::string detail);
  // Writes off a job that cannot be read, and records the damage.
  void write_off_unreadable(const StoredJob& job, std::string detail);
  [[nodiscard]] std::string summary() const;

  std::vector<RestoredJob> waiting_;
  std::vector<StoredJob> stored_;  // parallel to waiting_
  std::vector<WrittenOff> written_off_;
  std::unordered_set<std::string> ids_waiting_;
  std::unordered_set<std::string> ids_written_off_;
  std::vector<LeftObject> objects_;
  SceneExpiry expiry_;
  std::vector<LeftSpeed> speeds_;
  std::vector<std::string> stopped_arms_;
  bool knows_stops_ = true;
  Damage damage_;
};

}  // namespace armloom
