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

// How much of what is over is kept.
struct Retention {
  std::size_t jobs_max = 100'000;
  std::optional<std::chrono::hours> age_max = {};
  std::size_t audit_max = 100'000;  // of what was done, and as many of what was refused
};

struct StoreOptions {
  Retention retention = {};
  std::chrono::milliseconds retry{1000};  // when it could not be written
  std::string vfs = {};                   // SQLite's file system; empty: the system's
  // Is told, on the store's thread, that it cannot be written, and (null) that it can again.
  std::function<void(const StoreFault*)> on_fault = {};
  // Is told, on the store's thread, how long each transaction took until it was synced.
  std::function<void(std::chrono::nanoseconds)> on_written = {};
};

// What a data folder held when it was opened.
struct Leftover {
  std::uint64_t last_number = 0;  // of any job ever
  std::vector<LeftJob> jobs;      // in order of their numbers
  std::size_t lost_jobs = 0;      // of which nothing else is there than what their clients sent
  std::vector<std::string> stopped_arms;
  bool stops_are_damaged = false;    // there were more: which ones is not known
  bool stops_are_unwritten = false;  // some came, or went, that were not on disk
  bool is_behind = false;            // there was more: some of what was on disk is gone
  bool is_unmarked = false;          // there may have been: what would tell is gone (StoreMark)
  std::vector<LeftObject> objects;   // in the order in which they came
  std::vector<StoredAlert> alerts;   // oldest first
};

// The jobs of a data folder, on disk (SQLite, write-ahead log, synced). One thread writes: whatever
// has come since it wrote last goes into one transaction and costs one sync, so that many waiting
// callers share it; changes of one job that come meanwhile are joined. Nobody else ever waits for
// the disk. What cannot be written is kept, at most one entry for each job, and tried again until
// it can. All calls are thread-safe.
class JobStore {
 public:
  // Whether what was asked for is on disk. Called on the store's thread; not after close().
  using Done = std::function<void(bool is_written)>;

  // Problems, all of them naming the file and what to do: it is in use by another process, is
  // corrupt, cannot be read or written, or is a newer program's. Nothing is changed then.
  [[nodiscard]] static Result<std::unique_ptr<JobStore>> open(const std::filesystem::path& folder,
                                                              StoreOptions options);
  ~JobStore();

  [[nodiscard]] const Leftover& leftover() const;

  struct Accepted {
    StoredJob job;
    std::string body;
  };
  // Jobs to be acknowledged, all of them or none. False: they are not stored, and never will be,
  // whatever is said of them later.
  void accept(std::vector<Accepted> jobs, Done done);
  // A job as it is now.
  void see(StoredJob job);
  // What was changed of an acknowledged job that has not ended, in all; `done`: as of accept().
  // What cannot be written at present is kept all the same.
  void amend(std::uint64_t number, std::string amended, Done done);
  // It is about to move: from now on it is no longer one that can be run by the next run. Only ever
  // called back with true.
  void about_to_move(std::uint64_t number, Done done);
  // All that are stopped. That there is something to write is known to the next run from when this
  // returns, whatever becomes of the process, and of the disk.
  void stopped(std::vector<std::string> arms);
  // `done`: as of amend().
  void change(StoredObject object, Done done);

  // Soon on disk.
  // A request, with a key, that it did not come by was answered with it.
  void answered_with(std::uint64_t job, RequestOrigin request);
  void note(AuditEntry entry);
  void keep(StoredAlert alert);  // as it is now

  // Waits until what has come before is on disk; false: it could not be written.
  [[nodiscard]] bool flush();

  // Nothing: all is well, as of the last time that it was written.
  [[nodiscard]] std::optional<StoreFault> fault() const;

  // Writes what there is; what comes later is dropped. What could not be written, if anything.
  std::optional<StoreFault> close();

 private:
  class Impl;
  explicit JobStore(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace armloom
