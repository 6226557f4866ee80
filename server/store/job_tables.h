#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "server/store/database.h"
#include "server/store/job_store.h"
#include "server/store/pending.h"

namespace armloom {

// The statements by which a store writes. All throw SqlFault. One thread.
class JobTables {
 public:
  // It is not cut off below that many bytes.
  static constexpr std::uintmax_t kLogKept = std::uintmax_t{16} << 20U;

  // Opens the file, brings its tables up to date and looks whether it is whole.
  JobTables(const std::filesystem::path& file, const std::string& vfs);

  [[nodiscard]] Leftover leftover() const;  // but for what the mark beside it tells
  // Over all runs; none: not since an older version had it, which did not count.
  [[nodiscard]] std::optional<std::uint64_t> commits() const { return commits_; }
  // All of it, synced, or nothing.
  void write(const Pending& changes);
  // Its log is not what it wrote: that is not brought into the file at the end.
  void leave_log();
  // Deletes some of what is over the bounds, oldest first; whether there is more.
  bool clean_up(const Retention& retention, std::chrono::system_clock::time_point now);

 private:
  void write(std::uint64_t number, const JobChange& change);
  void write(const StoredAlert& alert);
  void write(const StoredObject& object);
  Database database_;
  Statement see_, expect_, move_, come_, seal_, put_body_, amend_, drop_body_, seal_body_, stop_,
      seal_stops_, forget_stops_, set_object_, seal_object_, forget_object_, note_, seal_note_,
      keep_alert_, seal_alert_, answer_, seal_answer_, count_;
  std::optional<std::uint64_t> commits_;
};

}  // namespace armloom
