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

// Sees to it that jobs outlive the process: between what the executive tells and the store. Calls
// come from the server's thread but for those of StartLog, which come from the strand.
class JobKeeper final : public StartLog {
 public:
  // Problems: those of JobStore::open().
  [[nodiscard]] static Result<std::unique_ptr<JobKeeper>> open(const std::filesystem::path& folder,
                                                               StoreOptions options);
  // Before anything else is called. Both outlive the keeper's callers; `post`: to the server's
  // thread.
  void serve(const WallClock& clock, std::function<void(std::function<void()>)> post) {
    clock_ = &clock;
    post_ = std::move(post);
  }
  void runs_on(RealTimeLoop& loop) { loop_ = &loop; }

  // What a client may not be told to be accepted. Problems: the id is an ended job's.
  // Predecessors that have succeeded long ago, or in a former run, are noted in the request.
  [[nodiscard]] Result<void> look_up(JobRequest& job) const;
  // As told by the executive now.
  void see(const JobView& job);
  struct AcceptedJob {
    JobView job;
    std::string body;
    RequestOrigin origin;
    std::optional<StoredJob> row = {};  // row_of() it, where that was made aside
  };
  // Jobs that it has accepted: `then` is called when they are on disk, or with the reason why not;
  // they are withdrawn then.
  void accept(std::vector<AcceptedJob> jobs, std::function<void(std::optional<Refusal>)> then);
  // It was changed: `then` is called when that is on disk, or with the reason why not yet.
  void amend(const JobView& job, std::function<void(std::optional<Refusal>)> then);
  // An object of the scene was changed: `then` as of amend().
  void change(StoredObject object, std::function<void(std::optional<Refusal>)> then);
  // When all that was told before is on disk, or with the reason why not yet.
  void when_written(std::function<void(std::optional<Refusal>)> then);
  // Why nothing can be accepted, nor any arm be let go, at present.
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
  // Calls `then`, on the server's thread, with the reason why it is not written, if it is not.
  void tell(bool is_written, const std::function<void(std::optional<Refusal>)>& then) const;

  const WallClock* clock_ = nullptr;
  std::function<void(std::function<void()>)> post_;
  RealTimeLoop* loop_ = nullptr;
  std::unique_ptr<JobStore> store_;
  std::unique_ptr<JobHistory> history_;
  std::unique_ptr<JobHistory> lists_;
};

// Without its origin.
[[nodiscard]] StoredJob row_of(const JobView& job, const WallClock& clock);

}  // namespace armloom
