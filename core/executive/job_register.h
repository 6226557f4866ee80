#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/executive/views.h"
#include "core/scheduler/scheduler.h"

namespace armloom {

// Jobs of the server's own, as their keys begin.
enum class OwnJob { retreat, move_to_start };

// What clients know a job by.
struct JobLabel {
  std::string key;
  std::string name;
  std::optional<TimePoint> submitted_at = {};  // in a former run
  std::size_t bytes = 0;                       // of its trajectories
};

// The jobs under the names that clients have for them, and which of them have ended.
class JobRegister final : public JobNames {
 public:
  // What jobs that have ended may take; beyond it those that ended longest ago are forgotten.
  struct EndedMax {
    std::size_t jobs;
    std::size_t bytes;  // of trajectories; the job that ended last stays all the same
  };
  // `scheduler` outlives it.
  JobRegister(const Scheduler& scheduler, EndedMax ended_max)
      : scheduler_(scheduler), ended_max_(ended_max) {}

  // Precondition: the key is not taken.
  void add(JobId id, JobLabel label);
  void rename(JobId id, std::string name);  // precondition: it is known
  // The job has ended. Those that ended longest ago, as far as they are too many, are taken out:
  // returned with their keys, for whoever else knows them.
  struct Forgotten {
    JobId id;
    std::string key;
  };
  std::vector<Forgotten> end(JobId id);
  // One that has ended, if it is known still.
  void forget(JobId id);

  [[nodiscard]] std::optional<JobId> find(const std::string& key) const;
  // Problems: not_found; conflict when it has ended.
  [[nodiscard]] Result<JobId> not_ended(const std::string& key) const;
  [[nodiscard]] bool is_taken(const std::string& key) const { return ids_.contains(key); }
  // Null for what was forgotten.
  [[nodiscard]] const JobLabel* label(JobId id) const;
  [[nodiscard]] std::size_t active() const { return labels_.size() - ended_.size(); }
  // Memory that trajectories of active jobs hold.
  [[nodiscard]] std::size_t active_bytes() const { return active_bytes_; }
  [[nodiscard]] const std::deque<JobId>& ended() const { return ended_; }  // oldest first

  // A key for a job whose client gave none: "job-17", or "job-17.2" where that is taken.
  [[nodiscard]] std::string free_key(JobId id) const;
  // The next one for a job of the server's own.
  [[nodiscard]] std::string own_key(OwnJob kind);

  // Empty for a job that has been forgotten since.
  [[nodiscard]] std::string key(JobId job) const override;
  [[nodiscard]] std::string name(JobId job) const override;
  [[nodiscard]] bool has_job(ArmId arm) const override;
  [[nodiscard]] bool is_stopped(ArmId arm) const override { return scheduler_.stopped(arm); }

 private:
  void take_out(JobId id);
  const Scheduler& scheduler_;
  EndedMax ended_max_;
  std::size_t active_bytes_ = 0;
  std::size_t ended_bytes_ = 0;
  std::unordered_map<std::string, JobId> ids_;
  std::unordered_map<JobId, JobLabel> labels_;
  std::deque<JobId> ended_;
  std::array<std::uint64_t, 2> next_own_ = {1, 1};  // by OwnJob
};

}  // namespace armloom
