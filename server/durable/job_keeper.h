#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/executive/real_time_loop.h"
#include "server/codec/wall_clock.h"
#include "server/http/message.h"
#include "server/messages/arm.h"
#include "server/store/job_history.h"
#include "server/store/job_store.h"

namespace armloom {

// Passes the executive's changes to the store, so that jobs outlive the process. Call on the
// server's thread, but StartLog's functions on the strand.
class JobKeeper final : public StartLog {
 public:
  // Problems: those of JobStore::open().
  [[nodiscard]] static Result<std::unique_ptr<JobKeeper>> open(const std::filesystem::path& folder,
                                                               StoreOptions options);
  // Call first. `clock` must outlive all calls of the keeper. `post` runs a task on the server's
  // thread.
  void serve(const WallClock& clock, std::function<void(std::function<void()>)> post) {
    clock_ = &clock;
    post_ = std::move(post);
  }
  void runs_on(RealTimeLoop& loop) { loop_ = &loop; }

  // Checks a request before acceptance. Problem: its id belongs to a job that has ended. Adds to
  // the request the predecessors that have succeeded according to the store.
  [[nodiscard]] Result<void> look_up(JobRequest& job) const;
  // Stores the job's state as the executive has just published it.
  void see(const JobView& job);
  struct AcceptedJob {
    JobView job;
    std::string body;
    RequestOrigin origin;
    std::optional<StoredJob> row = {};  // row_of(job), if already made
  };
  // Persists accepted jobs. Calls `then` with nullopt when they are on disk. If they cannot be
  // stored, rolls them back and calls `then` with the reason.
  void accept(std::vector<AcceptedJob> jobs, std::function<void(std::optional<Refusal>)> then);
  // Persists a job's amendments. Calls `then` with nullopt when they are on disk, or with the
  // reason why they are not on disk yet.
  void amend(const JobView& job, std::function<void(std::optional<Refusal>)> then);
  // Persists changes of scene objects, all or none. Calls `then` in the same way as amend().
  void change(std::vector<StoredObject> objects, std::function<void(std::optional<Refusal>)> then);
  // Deletes objects that have expired. If this fails, they expire again after the next start.
  void forget(const std::vector<std::string>& expired);
  // Persists the speed override of an arm, or of the cell if `arm` is "". Calls `then` in the same
  // way as amend().
  void set_speed(std::string arm, SpeedShare speed,
                 std::function<void(std::optional<Refusal>)> then);
  // Calls `then` with nullopt when all earlier changes are on disk, or with the reason why they are
  // not on disk yet.
  void when_written(std::function<void(std::optional<Refusal>)> then);
  // Returns a refusal while no job can be stored, so that none is accepted and no arm may start.
  // Returns nullopt otherwise.
  [[nodiscard]] std::optional<Refusal> refusal() const;
  void stopped(std::vector<std::string> arms) { store_->stopped(std::move(arms)); }

  void about_to_move(JobId job, std::function<void()> written) override;
  void has_moved(JobId job, const HeldView& object, std::function<void()> written) override;

  [[nodiscard]] JobStore& store() { return *store_; }
  [[nodiscard]] const JobHistory& history() const { return *history_; }
  // a second reader, for one other thread
  [[nodiscard]] const JobHistory& lists() const { return *lists_; }
  [[nodiscard]] const WallClock& clock() const { return *clock_; }
  void post(std::function<void()> task) const { post_(std::move(task)); }

 private:
  JobKeeper() = default;
  // Calls `then` on the server's thread, with the reason if nothing was written.
  void tell(bool is_written, const std::function<void(std::optional<Refusal>)>& then) const;

  const WallClock* clock_ = nullptr;
  std::function<void(std::function<void()>)> post_;
  RealTimeLoop* loop_ = nullptr;
  std::unique_ptr<JobStore> store_;
  std::unique_ptr<JobHistory> history_;
  std::unique_ptr<JobHistory> lists_;
};

// Returns the job's row, without its origin.
[[nodiscard]] StoredJob row_of(const JobView& job, const WallClock& clock);

}  // namespace armloom
