#pragma once

#include <string>
#include <unordered_set>
#include <vector>

#include "core/model/cell.h"
#include "server/durable/job_keeper.h"
#include "server/store/job_history.h"

namespace armloom {

// What becomes of the jobs that had not ended when a former run did: those that had not begun are
// submitted again, with the ids, the order and the conditions that they had. Those that had, or may
// have, are `interrupted`, what came `after` one of them fails, and what the cell no longer fits is
// interrupted, too.
class Restart {
 public:
  // Writes off what has to be, on disk when this returns. Problem (unavailable): it cannot be
  // written.
  [[nodiscard]] static Result<Restart> prepare(JobKeeper& keeper);

  // The first thing that the executive does. Makes the scene what clients had made of it, then
  // stops arms: all of them where the cell says `ask` and something was left, where the scene could
  // not be made what it was, or where it is not known which arms were stopped when the former run
  // ended, else those that were. `keeper` outlives it.
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
  // What of the jobs is lost for that they cannot be read.
  void write_off_unreadable(const StoredJob& job, std::string detail);
  [[nodiscard]] std::string summary() const;

  std::vector<RestoredJob> waiting_;
  std::vector<StoredJob> stored_;  // as waiting_
  std::vector<WrittenOff> written_off_;
  std::unordered_set<std::string> ids_waiting_;
  std::unordered_set<std::string> ids_written_off_;
  std::vector<LeftObject> objects_;
  std::vector<std::string> stopped_arms_;
  bool knows_stops_ = true;
  Damage damage_;
};

}  // namespace armloom
