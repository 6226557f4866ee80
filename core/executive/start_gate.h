#pragma once

#include <functional>
#include <optional>
#include <unordered_map>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/jobs/inputs.h"

namespace armloom {

class StartLog;

// Withholds a client job's authority until the start log has recorded that the job is about to
// move. Without a log everything passes.
class StartGate {
 public:
  // `log` outlives this object; may be null.
  explicit StartGate(StartLog* log) : log_(log) {}

  // Returns the dispatch of a client job with the authority that the arms may get now. At the job's
  // first dispatch, asks the log to record the start; the log calls `written` when that is done.
  [[nodiscard]] Dispatch pass(Dispatch dispatch, std::function<void()> written);
  // Returns true if the start of the job is recorded. Asks for it the first time.
  [[nodiscard]] bool record(JobId job, std::function<void()> written);
  // Returns true if the grant must wait; the gate then keeps it.
  [[nodiscard]] bool keeps(const Grant& grant);
  // The start is recorded: returns the withheld authority, if any.
  [[nodiscard]] std::optional<Duration> open(JobId job);
  void forget(JobId job) { starts_.erase(job); }

  [[nodiscard]] bool has_log() const { return log_ != nullptr; }
  [[nodiscard]] StartLog* log() const { return log_; }
  // Returns true if the job is dispatched without authority, because its start is not recorded.
  [[nodiscard]] bool withholds(JobId job) const;
  // Returns true if the job's start is recorded or is being recorded.
  [[nodiscard]] bool knows(JobId job) const { return starts_.contains(job); }

 private:
  struct Start {
    bool is_written = false;
    std::optional<Duration> withheld = {};  // authority kept until the start is recorded
  };
  StartLog* log_;
  std::unordered_map<JobId, Start> starts_;  // dispatched jobs
};

}  // namespace armloom
