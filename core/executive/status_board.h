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

struct ArmStatus {
  ArmState state = ArmState::idle;
  bool stopped = false;           // until it is resumed
  std::string stop_cause = {};    // ArmView
  std::optional<JobId> job = {};  // in motion or paused
  double progress = 0.0;          // of this job
  double deviation_rad = 0.0;     // ArmView
  double deviation_max_rad = 0.0;
  ArmLink::State link = ArmLink::State::up;
  std::string link_detail = {};
  bool drives_on = true;
  double speed_override = 1.0;            // ArmView
  double effective_speed_override = 1.0;  // ArmView
};

// Everything that clients see, at one instant. Copies share the jobs and the scene.
struct Status {
  std::uint64_t seq = 0;  // of the last event that is certainly included; the next may be, too
  TimePoint time{};
  std::string policy;
  bool stopped = false;         // every arm is stopped
  double speed_override = 1.0;  // of the cell
  JobSheet jobs;                // active and recently ended
  std::shared_ptr<const SceneView> scene;
  std::shared_ptr<const std::vector<SignalView>> signals;  // by SignalId
  Configuration q;                                         // measured, all joints of the cell
  std::vector<ArmStatus> arms;                             // by ArmId

  // Returns the job with its progress at this instant. Copies the job's view only if the progress
  // has changed.
  [[nodiscard]] JobSheet::JobPtr with_progress(const JobSheet::JobPtr& job) const;
  // In order of ids.
  [[nodiscard]] std::vector<JobSheet::JobPtr> jobs_with_ended(std::size_t ended_max) const;
};
[[nodiscard]] ArmView view_of(const ArmStatus& status, ArmId arm, const Cell& cell,
                              const Configuration& q, std::string job_key);
[[nodiscard]] std::vector<ArmView> arms_of(const Status& status, const Cell& cell);
[[nodiscard]] QueueView queue_of(const Status& status);
// Returns the snapshot without its jobs.
[[nodiscard]] Snapshot snapshot_of(const Status& status, const Cell& cell);

// Publishes the status from the strand to any thread. A reader copies the status under a short lock
// and works on the copy, so reader and strand hardly wait for each other. The status is updated
// before an event is published and before a command is answered.
class StatusBoard {
 public:
  [[nodiscard]] Status read() const;
  // Null if no job has this key.
  [[nodiscard]] JobSheet::JobPtr job(const std::string& key) const;
  [[nodiscard]] std::vector<JobSheet::JobPtr> jobs(const std::vector<std::string>& keys) const;

  // A status as the strand publishes it. Positions and arms are copied into existing memory.
  struct Now {
    std::uint64_t seq;
    TimePoint time;
    std::string_view policy;
    bool stopped;
    double speed_override;
    const JobSheet& jobs;
    const Configuration& q;
    const std::vector<ArmStatus>& arms;
  };
  // Replaces the status. `gone`: the jobs that are no longer in `now.jobs`; their keys are no
  // longer found.
  using KeyOfJob = std::pair<std::string, JobId>;
  void publish(const Now& now, const std::vector<KeyOfJob>& gone);
  void publish_scene(std::shared_ptr<const SceneView> scene);
  void publish_signals(std::shared_ptr<const std::vector<SignalView>> signals);
  void add_key(const std::string& key, JobId job);

 private:
  mutable std::mutex mutex_;
  Status status_;
  std::unordered_map<std::string, JobId> keys_;
};

}  // namespace armloom
