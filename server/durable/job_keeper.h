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
#include "server/store/job_history.h"
#include "server/store/job_store.h"

namespace armloom {

// Makes jobs outlive the process: passes the executive's changes to the store. Call on the server's
// thread; StartLog's functions on the strand.
class JobKeeper final : public StartLog {
 public:
  // Problems: those of JobStore::open().
  [[nodiscard]] static Result<std::unique_ptr<JobKeeper>> open(const std::filesystem::path& folder,
                                                               StoreOptions options);
  // Call first. Both outlive the keeper's callers. `post` runs a task on the server's thread.
  void serve(const WallClock& clock, std::function<void(std::function<void()>)> post) {
    clock_ = &clock;
    post_ = std::move(post);
  }
  void runs_on(RealTimeLoop& loop) { loop_ = &loop; }

  // Checks a request before acceptance. Problem: its id is an ended job's. Adds to the request
  // which predecessors succeeded long ago or in an earlier session.
  [[nodiscard]] Result<void> look_up(JobRequest& job) const;
  // Records the job's state as published by the executive now.
  void see(const JobView& job);
  struct AcceptedJob {
    JobView job;
    std::string body;
    RequestOrigin origin;
    std::optional<StoredJob> row = {};  // row_of(job), if already made
  };
  // Persists accepted jobs. Calls `then` when they are on disk, or with the reason why not; then
  // they are rolled back.
  void accept(std::vector<AcceptedJob> jobs, std::function<void(std::optional<Refusal>)> then);
  // Persists a job's amendments. Calls `then` when they are on disk, or with the reason why not
  // yet.
  void amend(const JobView& job, std::function<void(std::optional<Refusal>)> then);
  // Persists a change of a scene object; `then` as in amend().
  void change(StoredObject object, std::function<void(std::optional<Refusal>)> then);
  // Calls `then` when all earlier changes are on disk, or with the reason why not yet.
  void when_written(std::function<void(std::optional<Refusal>)> then);
  // Returns why no job can be accepted and no arm may start at present, or nullopt.
  [[nodiscard]] std::optional<Refusal> refusal() const;
  void stopped(std::vector<std::string> arms) { store_->stopped(std::move(arms)); }

  void about_to_move(JobId job, std::function<void()> written) override;

  [[nodiscard]] JobStore& store() { return *store_; }
  [[nodiscard]] const JobHistory& history() const { return *history_; }
  [[nodiscard]] const JobHistory& lists() const { return *lists_; }  // for one other thread
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
