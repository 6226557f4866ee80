#pragma once

#include <chrono>
#include <filesystem>

#include "server/store/database.h"
#include "server/store/job_store.h"
#include "server/store/pending.h"

namespace armloom {

// The statements by which a store writes. All throw SqlFault. One thread.
class JobTables {
 public:
  // Opens the file, made if there is none, brings its tables up to date and looks whether it is
  // whole.
  JobTables(const std::filesystem::path& file, const std::string& vfs);

  [[nodiscard]] Leftover leftover() const;  // but for what the mark beside it tells
  [[nodiscard]] std::uint64_t commits() const { return commits_; }  // over all runs
  // All of it, synced, or nothing.
  void write(const Pending& changes);
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
  std::uint64_t commits_;
};

}  // namespace armloom
