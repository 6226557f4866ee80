#pragma once

#include <functional>
#include <optional>
#include <unordered_map>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/jobs/inputs.h"

namespace armloom {

class StartLog;

// What has not been put down as about to move has no authority until it is. Without a log
// everything passes.
class StartGate {
 public:
  // `log` outlives it; null: nobody asks.
  explicit StartGate(StartLog* log) : log_(log) {}

  // What the arms may be told of a dispatch of a client's job. `written` is handed to the log, once
  // for each job.
  [[nodiscard]] Dispatch pass(Dispatch dispatch, std::function<void()> written);
  // Whether a grant has to wait: then it is kept.
  [[nodiscard]] bool keeps(const Grant& grant);
  // It is put down: what was withheld, if anything.
  [[nodiscard]] std::optional<Duration> open(JobId job);
  void forget(JobId job) { starts_.erase(job); }

  // Its arms are told of it and may not leave where they stand: it has not begun.
  [[nodiscard]] bool withholds(JobId job) const;
  // It has been put down as about to move, or is to be.
  [[nodiscard]] bool knows(JobId job) const { return starts_.contains(job); }

 private:
  struct Start {
    bool is_written = false;
    std::optional<Duration> withheld = {};  // authority, until then
  };
  StartLog* log_;
  std::unordered_map<JobId, Start> starts_;  // of jobs that have been dispatched
};

}  // namespace armloom
