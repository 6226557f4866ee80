#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "server/store/stored_alert.h"
#include "server/store/stored_job.h"
#include "server/store/stored_object.h"
#include "server/store/stored_speed.h"

namespace armloom {

// Why the store cannot be written at present.
struct StoreFault {
  bool is_full = false;  // there is no space left
  std::string text;
};

// How much history is kept.
struct Retention {
  std::size_t jobs_max = 100'000;
  // Since the job ended, by a clock that only goes forward within a session. Wall time may jump,
  // for example when a machine without a battery gets the time from the network.
  std::optional<std::chrono::hours> age_max = {};
  std::size_t audit_max = 100'000;  // entries of changes, and as many of refusals
};

struct StoreOptions {
  Retention retention = {};
  std::chrono::milliseconds retry{1000};  // pause after a failed write, before the next try
  std::string vfs = {};                   // name of an SQLite VFS; "": the default
  // The clock by which jobs age. Replaced by tests.
  std::function<std::chrono::steady_clock::time_point()> now = std::chrono::steady_clock::now;
  // Called on the store's thread when writing fails, and with null when it works again.
  std::function<void(const StoreFault*)> on_fault = {};
  // Called on the store's thread with the duration of each synced transaction.
  std::function<void(std::chrono::nanoseconds)> on_written = {};
};

// Contents of a data folder when it was opened.
struct Leftover {
  std::uint64_t last_number = 0;  // highest number of all jobs ever stored
  std::vector<LeftJob> jobs;      // ordered by number
  std::size_t lost_jobs = 0;      // only their requests are left
  std::vector<std::string> stopped_arms;
  bool stops_are_damaged = false;    // further arms may have been stopped
  bool stops_are_unwritten = false;  // the last changes of the set may be lost
  bool is_behind = false;            // some data is lost
  bool is_unmarked = false;          // some data may be lost: the mark is missing (StoreMark)
  std::vector<LeftObject> objects;   // in order of arrival
  std::vector<LeftSpeed> speeds;     // speed overrides
  std::vector<StoredAlert> alerts;   // oldest first
};

// Stores the jobs of a data folder on disk (SQLite with a write-ahead log, synced). One thread
// writes. All changes since its last write share one transaction and one sync (group commit).
// Changes of the same job are merged. Only flush() and close() wait for the disk. If changes cannot
// be written, the store keeps them, merged for each job, and tries again. Thread-safe.
class JobStore {
 public:
  // Called on the store's thread, with true once the change is durable. Never called for changes
  // that come after close().
  using Done = std::function<void(bool is_written)>;

  // Problem: the store is in use by another process, corrupt, unreadable, not writable, or of
  // another version. The problem names the file and the remedy, and nothing is changed.
  [[nodiscard]] static Result<std::unique_ptr<JobStore>> open(const std::filesystem::path& folder,
                                                              StoreOptions options);
  ~JobStore();

  [[nodiscard]] const Leftover& leftover() const;

  struct Accepted {
    StoredJob job;
    std::string body;
  };
  // Stores jobs to be acknowledged, all or none. `done` gets false if they could not be stored.
  // They are then never stored, and later changes of these jobs are ignored.
  void accept(std::vector<Accepted> jobs, Done done);
  // Stores a job's present state.
  void see(StoredJob job);
  // Stores the amendments of an acknowledged job that has not ended. `amended` holds all of them.
  // If they cannot be written, `done` gets false, but the store keeps them and tries again.
  void amend(std::uint64_t number, std::string amended, Done done);
  // Stores that a job is about to move, so that the next session does not run the job again. `done`
  // is only called with true.
  void about_to_move(std::uint64_t number, Done done);
  // Stores the set of all stopped arms. Once this returns, the next session knows that the set
  // changed, even if the process or the disk fails.
  void stopped(std::vector<std::string> arms);
  // Stores a change of a scene object. If it cannot be written, `done` gets false, but the store
  // keeps it and tries again.
  void change(std::vector<StoredObject> objects, Done done);

  // Stores a change of a speed override. `done` is called in the same way as by change().
  void set_speed(StoredSpeed speed, Done done);

  // The next three functions store soon, and report nothing. answered_with() stores that another
  // request, with an Idempotency-Key, was answered with the job.
  void answered_with(std::uint64_t job, RequestOrigin request);
  void note(AuditEntry entry);
  void keep(StoredAlert alert);  // the alert's present state

  // Waits until earlier changes are on disk. Returns false if they could not be written.
  [[nodiscard]] bool flush();

  // Returns the fault of the last write, or nullopt if the write succeeded.
  [[nodiscard]] std::optional<StoreFault> fault() const;

  // Writes the pending changes. Later changes are dropped. Returns the fault if writing failed.
  std::optional<StoreFault> close();

 private:
  class Impl;
  explicit JobStore(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace armloom
