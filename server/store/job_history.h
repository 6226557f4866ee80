#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "server/store/stored_job.h"

namespace armloom {

// Selects jobs. An empty member matches any.
struct HistoryFilter {
  std::string state = {};
  std::string arm = {};
  std::optional<std::uint64_t> before = {};   // job number: selects jobs accepted earlier
  std::optional<std::int64_t> since_ms = {};  // selects jobs submitted then or later
};

// Selects audit entries. An empty member matches any.
struct AuditFilter {
  std::optional<std::string> who = {};  // "" selects requests without a token
  std::string from = {};
  std::string method = {};
  std::string path = {};  // a prefix
  std::optional<int> status = {};
  std::optional<std::int64_t> since_ms = {};  // then or later
  std::optional<std::int64_t> before_ms = {};
  std::optional<std::uint64_t> below = {};  // entry number: selects entries recorded earlier
};

struct AuditEntries {
  std::vector<AuditEntry> entries = {};  // newest first
  std::size_t damaged = 0;               // damaged entries, which are skipped, whatever the filter
};

// Damaged contents of a data folder.
struct Damage {
  std::vector<std::string> jobs = {};  // their ids
  std::size_t lost_jobs = 0;           // damaged jobs whose ids are lost, too
  std::size_t alerts = 0;
  std::size_t audit = 0;     // entries
  bool stops = false;        // the list of stopped arms is damaged
  bool is_behind = false;    // some data is lost
  bool is_unmarked = false;  // the mark is missing: some data may be lost

  [[nodiscard]] bool is_none() const {
    return jobs.empty() && lost_jobs + alerts + audit == 0 && !stops && !is_behind && !is_unmarked;
  }
};

// Reads what a JobStore has written, even while the store is writing. Each call reads the state
// that is on disk when the call starts. Use on one thread at a time.
class JobHistory {
 public:
  // Problem: the folder has no store, or the store cannot be read.
  [[nodiscard]] static Result<std::unique_ptr<JobHistory>> open(
      const std::filesystem::path& folder);
  ~JobHistory();

  // Returns the last job accepted under this id. Problem: the job is damaged.
  [[nodiscard]] Result<std::optional<StoredJob>> find(const std::string& id) const;
  // Returns the jobs that a request with this Idempotency-Key created or was answered with. Their
  // `origin` is that request.
  [[nodiscard]] Result<std::vector<StoredJob>> of_request(const std::string& key) const;
  // Returns at most `most` audit entries.
  [[nodiscard]] Result<AuditEntries> audit(const AuditFilter& filter, std::size_t most) const;
  // Passes the jobs to `take`, newest first, until `take` returns false. Skips damaged jobs (see
  // damage()).
  [[nodiscard]] Result<void> newest_first(const HistoryFilter& filter,
                                          const std::function<bool(StoredJob)>& take) const;
  // Passes the jobs to `take`, oldest first. Skips damaged jobs, and returns a problem at the end
  // if there are any.
  [[nodiscard]] Result<void> oldest_first(const HistoryFilter& filter,
                                          const std::function<void(StoredJob)>& take) const;
  [[nodiscard]] Result<Damage> damage() const;

 private:
  class Impl;
  explicit JobHistory(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace armloom
