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

namespace armloom {

// Why the store cannot be written at present.
struct StoreFault {
  bool is_full = false;  // there is no space left
  std::string text;
};

// How much history is kept.
struct Retention {
  std::size_t jobs_max = 100'000;
  std::optional<std::chrono::hours> age_max = {};
  std::size_t audit_max = 100'000;  // of changes, and as many of refusals
};

struct StoreOptions {
  Retention retention = {};
  std::chrono::milliseconds retry{1000};  // after a failed write
  std::string vfs = {};                   // SQLite's file system; "": the system's
  // Called on the store's thread when writing fails, and with null when it works again.
  std::function<void(const StoreFault*)> on_fault = {};
  // Called on the store's thread with the duration of each synced transaction.
  std::function<void(std::chrono::nanoseconds)> on_written = {};
};

// Contents of a data folder when it was opened.
struct Leftover {
  std::uint64_t last_number = 0;  // of any job ever
  std::vector<LeftJob> jobs;      // by number
  std::size_t lost_jobs = 0;      // only their requests are left
  std::vector<std::string> stopped_arms;
  bool stops_are_damaged = false;    // unknown further arms
  bool stops_are_unwritten = false;  // later changes may be lost
  bool is_behind = false;            // some data is lost
  bool is_unmarked = false;          // some may be lost: no mark (StoreMark)
  std::vector<LeftObject> objects;   // in order of arrival
  std::vector<StoredAlert> alerts;   // oldest first
};

// The jobs of a data folder on disk (SQLite, write-ahead log, synced). One thread writes: all
// changes since its last write share one transaction and one sync (group commit); changes of one
// job are merged. Only flush() and close() wait for the disk. Changes that cannot be written are
// kept, at most one entry for each job, and retried. Thread-safe.
class JobStore {
 public:
  // Called with true once the change is durable. On the store's thread; not after close().
  using Done = std::function<void(bool is_written)>;

  // Problems name the file and the remedy: it is in use by another process, corrupt, unreadable,
  // not writable, or of a newer version. Then nothing is changed.
  [[nodiscard]] static Result<std::unique_ptr<JobStore>> open(const std::filesystem::path& folder,
                                                              StoreOptions options);
  ~JobStore();

  [[nodiscard]] const Leftover& leftover() const;

  struct Accepted {
    StoredJob job;
    std::string body;
  };
  // Stores jobs to be acknowledged, all or none. `done` gets false if they are not stored; then
  // they never will be, and later changes of them are ignored.
  void accept(std::vector<Accepted> jobs, Done done);
  // Stores a job's present state.
  void see(StoredJob job);
  // Stores all amendments of an acknowledged job that has not ended. If they cannot be written,
  // `done` gets false, but they are kept and retried.
  void amend(std::uint64_t number, std::string amended, Done done);
  // Stores that a job is about to move, so that the next session does not run it. `done` is only
  // called with true.
  void about_to_move(std::uint64_t number, Done done);
  // Stores all stopped arms. Once this returns, the next session knows that the set changed, even
  // if the process or the disk fails.
  void stopped(std::vector<std::string> arms);
  // `done` as in amend().
  void change(StoredObject object, Done done);

  // Stored soon, without a callback. answered_with(): another request, with a key, was answered
  // with the job.
  void answered_with(std::uint64_t job, RequestOrigin request);
  void note(AuditEntry entry);
  void keep(StoredAlert alert);  // its present state

  // Waits until earlier changes are on disk. Returns false if they could not be written.
  [[nodiscard]] bool flush();

  // Returns the fault of the last write, or nullopt.
  [[nodiscard]] std::optional<StoreFault> fault() const;

  // Writes pending changes and drops later ones. Returns the fault if writing failed.
  std::optional<StoreFault> close();

 private:
  class Impl;
  explicit JobStore(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace armloom
