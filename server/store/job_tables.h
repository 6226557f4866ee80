#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "server/store/database.h"
#include "server/store/job_store.h"
#include "server/store/pending.h"

namespace armloom {

// The SQL statements of a store. All functions throw SqlFault. Use on one thread.
class JobTables {
 public:
  // The write-ahead log is never truncated below this size, in bytes.
  static constexpr std::uintmax_t kLogKept = std::uintmax_t{16} << 20U;

  // Opens the file, and checks its version and integrity.
  JobTables(const std::filesystem::path& file, const std::string& vfs);

  [[nodiscard]] Leftover leftover() const;  // without the members known to StoreMark
  // Returns the number of commits over all sessions.
  [[nodiscard]] std::uint64_t commits() const { return commits_; }
  // Writes and syncs all changes, or none.
  // `now`: time since the session began.
  void write(const Pending& changes, std::chrono::milliseconds now);
  // Call if the log was cut off. Its contents are then not copied into the database file at the
  // end.
  void leave_log();
  // Deletes some of the oldest rows beyond the limits. Returns true if there may be more.
  // `began`: wall time at which the session began; `now`: time since then. The ages of jobs that
  // ended in this session count from their end by `now`; other jobs count by the wall time of
  // their end.
  bool clean_up(const Retention& retention, std::chrono::system_clock::time_point began,
                std::chrono::milliseconds now);

 private:
  void write(std::uint64_t number, const JobChange& change, std::chrono::milliseconds now);
  void write(const StoredAlert& alert);
  void write(const StoredObject& object);
  void write(const StoredSpeed& speed);
  Database database_;
  Statement see_, end_, expect_, move_, come_, seal_, put_body_, amend_, drop_body_, seal_body_,
      stop_, seal_stops_, forget_stops_, set_object_, seal_object_, forget_object_, set_speed_,
      seal_speed_, forget_speed_, note_, seal_note_, keep_alert_, seal_alert_, answer_,
      seal_answer_, count_;
  std::uint64_t commits_;
};

}  // namespace armloom
