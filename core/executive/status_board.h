#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/executive/events.h"
#include "core/executive/job_sheet.h"

namespace armloom {

// What changes of an arm, as it was at one instant.
struct ArmStatus {
  ArmState state = ArmState::idle;
  bool stopped = false;           // until it is resumed
  std::optional<JobId> job = {};  // in motion or paused
  double progress = 0.0;          // of this job
  double deviation_rad = 0.0;     // ArmView
};

// Everything that clients see, at one instant. A copy shares the jobs and the scene.
struct Status {
  std::uint64_t seq = 0;  // of the last event that is contained; the next one may be, too
  TimePoint time{};
  std::string policy;
  bool stopped = false;  // every arm is stopped
  JobSheet jobs;         // all that have not ended, and those that ended last
  std::shared_ptr<const SceneView> scene;
  Configuration q;              // measured, all joints of the cell
  std::vector<ArmStatus> arms;  // ArmId

  // The job with its progress of this instant: a view is made only when the job changed.
  [[nodiscard]] JobSheet::JobPtr with_progress(const JobSheet::JobPtr& job) const;
  // All jobs that have not ended and the `ended_max` ones that ended last, in order of ids.
  [[nodiscard]] std::vector<JobSheet::JobPtr> jobs_with_ended(std::size_t ended_max) const;
};
[[nodiscard]] ArmView view_of(const ArmStatus& status, ArmId arm, const Cell& cell,
                              const Configuration& q, std::string job_key);
[[nodiscard]] std::vector<ArmView> arms_of(const Status& status, const Cell& cell);
[[nodiscard]] QueueView queue_of(const Status& status);
[[nodiscard]] Snapshot snapshot_of(const Status& status, const Cell& cell, std::size_t ended_max);

// Where the strand publishes the status and any thread reads it, without a word to the strand.
// Neither waits for the other: a copy is taken under the lock, all else is made from the copy.
// Published before an event is told, and before a command is answered.
class StatusBoard {
 public:
  [[nodiscard]] Status read() const;
  // Null if no job has this key.
  [[nodiscard]] JobSheet::JobPtr job(const std::string& key) const;
  // For several keys, of one instant.
  [[nodiscard]] std::vector<JobSheet::JobPtr> jobs(const std::vector<std::string>& keys) const;

  // The strand's. Arms and poses are copied, so that their memory is used again.
  struct Now {
    std::uint64_t seq;
    TimePoint time;
    std::string_view policy;
    bool stopped;
    const JobSheet& jobs;
    const Configuration& q;
    const std::vector<ArmStatus>& arms;
  };
  // `gone` are the keys of jobs that `now.jobs` has no longer: whoever looks one up finds it as
  // long as a list does.
  using KeyOfJob = std::pair<std::string, JobId>;
  void publish(const Now& now, const std::vector<KeyOfJob>& gone);
  void publish_scene(std::shared_ptr<const SceneView> scene);
  void add_key(const std::string& key, JobId job);

 private:
  mutable std::mutex mutex_;
  Status status_;
  std::unordered_map<std::string, JobId> keys_;
};

}  // namespace armloom
