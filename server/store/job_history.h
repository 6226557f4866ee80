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

// Which jobs are asked for; empty: any.
struct HistoryFilter {
  std::string state = {};
  std::string arm = {};
  std::optional<std::uint64_t> before = {};   // number: only those that were accepted earlier
  std::optional<std::int64_t> since_ms = {};  // submitted then or later
};

// Which entries of the audit trail are asked for; what is empty: any.
struct AuditFilter {
  std::optional<std::string> who = {};  // empty text: those that showed no name
  std::string from = {};
  std::string method = {};
  std::string path = {};  // begins so
  std::optional<int> status = {};
  std::optional<std::int64_t> since_ms = {};  // then or later
  std::optional<std::int64_t> before_ms = {};
  std::optional<std::uint64_t> below = {};  // number: only those that were put down earlier
};

struct AuditEntries {
  std::vector<AuditEntry> entries = {};  // newest first
  std::size_t damaged = 0;  // between these: not as they were written, whatever was asked for
};

// What is not as it was written.
struct Damage {
  std::vector<std::string> jobs = {};  // their ids
  std::size_t lost_jobs = 0;           // whose ids are lost, too
  std::size_t alerts = 0;
  std::size_t audit = 0;     // entries
  bool stops = false;        // which arms were stopped
  bool is_behind = false;    // some of what was on disk is gone
  bool is_unmarked = false;  // some may be

  [[nodiscard]] bool is_none() const {
    return jobs.empty() && lost_jobs + alerts + audit == 0 && !stops && !is_behind && !is_unmarked;
  }
};

// Reads what a JobStore has written, while it is written or not. Sees what was on disk when each
// call began. One thread at a time.
class JobHistory {
 public:
  // Problem: there is no store, or it cannot be read.
  [[nodiscard]] static Result<std::unique_ptr<JobHistory>> open(
      const std::filesystem::path& folder);
  ~JobHistory();

  // The last one that was accepted under this id. Problem: it is damaged.
  [[nodiscard]] Result<std::optional<StoredJob>> find(const std::string& id) const;
  // Those that came by a request with this Idempotency-Key, or that one was answered with; their
  // origin is that request.
  [[nodiscard]] Result<std::vector<StoredJob>> of_request(const std::string& key) const;
  // Who did what, at most so many.
  [[nodiscard]] Result<AuditEntries> audit(const AuditFilter& filter, std::size_t most) const;
  // Newest first, until `take` says enough (false). Those that are damaged are passed over:
  // damage() tells of them.
  [[nodiscard]] Result<void> newest_first(const HistoryFilter& filter,
                                          const std::function<bool(StoredJob)>& take) const;
  // Oldest first. Problem, when all others were taken: some are damaged.
  [[nodiscard]] Result<void> oldest_first(const HistoryFilter& filter,
                                          const std::function<void(StoredJob)>& take) const;
  [[nodiscard]] Result<Damage> damage() const;

 private:
  class Impl;
  explicit JobHistory(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace armloom
