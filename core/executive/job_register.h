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
#include "core/executive/task.h"
#include "core/executive/views.h"
#include "core/scheduler/scheduler.h"

namespace armloom {

// Kinds of server-initiated jobs. The kind is part of the job's key.
enum class OwnJob { retreat, move_to_start };

struct JobLabel {
  std::string key;
  std::string name;
  std::optional<TimePoint> submitted_at = {};  // in an earlier session
  std::size_t bytes = 0;                       // of its trajectories
  bool has_ended = false;                      // JobRegister::end()
};

class JobRegister final : public JobNames {
 public:
  // Limits for ended jobs. If a limit is exceeded, the oldest ended jobs are forgotten.
  struct EndedMax {
    std::size_t jobs;
    std::size_t bytes;  // of trajectories; the job that ended last always stays
  };
  // `scheduler` and `tasks` outlive this object. `first_job`: of this session.
  JobRegister(const Scheduler& scheduler, const TaskBook& tasks, EndedMax ended_max,
              JobId first_job = JobId{1})
      : scheduler_(scheduler), tasks_(tasks), ended_max_(ended_max) {
    next_own_.fill(first_job.value());
  }

  // Precondition: the key is not taken.
  void add(JobId id, JobLabel label);
  void rename(JobId id, std::string name);  // precondition: the job is known
  // The job has ended. Removes the oldest ended jobs beyond the limits, and returns them so that
  // the caller can forget them too.
  struct Forgotten {
    JobId id;
    std::string key;
  };
  std::vector<Forgotten> end(JobId id);
  void forget(JobId id);

  [[nodiscard]] std::optional<JobId> find(const std::string& key) const;
  // Problems: not_found; conflict if it has ended.
  [[nodiscard]] Result<JobId> not_ended(const std::string& key) const;
  [[nodiscard]] bool is_taken(const std::string& key) const { return ids_.contains(key); }
  // Returns the state of a job or task. Precondition: it is known.
  [[nodiscard]] JobState state(JobId id) const;
  // The label of a task is also that of its motions.
  [[nodiscard]] const JobLabel* label(JobId id) const;
  // Returns true if end() has been called.
  [[nodiscard]] bool has_ended(JobId id) const;
  [[nodiscard]] std::size_t active() const { return labels_.size() - ended_.size(); }
  [[nodiscard]] std::size_t active_bytes() const { return active_bytes_; }
  [[nodiscard]] const std::deque<JobId>& ended() const { return ended_; }  // oldest first

  // Returns a key for a job without one: "job-17", or "job-17.2" if that is taken.
  [[nodiscard]] std::string free_key(JobId id) const;
  // Returns the next key for a server-initiated job. Its number is at most that of the job. So no
  // later session that uses the same store returns it again.
  [[nodiscard]] std::string own_key(OwnJob kind);

  // Return an empty string for a forgotten job.
  [[nodiscard]] std::string key(JobId job) const override;
  [[nodiscard]] std::string name(JobId job) const override;
  [[nodiscard]] bool has_job(ArmId arm) const override;
  [[nodiscard]] bool is_stopped(ArmId arm) const override { return scheduler_.stopped(arm); }

 private:
  void take_out(JobId id);
  const Scheduler& scheduler_;
  const TaskBook& tasks_;
  EndedMax ended_max_;
  std::size_t active_bytes_ = 0;
  std::size_t ended_bytes_ = 0;
  std::unordered_map<std::string, JobId> ids_;
  std::unordered_map<JobId, JobLabel> labels_;
  std::deque<JobId> ended_;
  std::array<std::uint64_t, 2> next_own_;  // by OwnJob
};

}  // namespace armloom
