#include "server/store/watched_files.h"

#include "server/store/data_lock.h"
#include "server/store/job_tables.h"
#include "server/store/store_mark.h"
#include "server/store/tables.h"

namespace armloom {
namespace {

std::string words_of(const PlacedFile& file, const char* how) {
  return file.path().string() + " was " + how +
         " while the server runs: restore it, or stop the server before another process uses the "
         "folder";
}

}  // namespace

std::filesystem::path log_of(const std::filesystem::path& folder) {
  return folder / (std::string(kStoreFile) + "-wal");
}

WatchedFiles::WatchedFiles(const std::filesystem::path& folder)
    : files_{PlacedFile(folder / DataLock::kFile), PlacedFile(folder / kStoreFile),
             PlacedFile(folder / StoreMark::kFile)},
      log_(log_of(folder)) {}

void WatchedFiles::log_has_grown() { log_.has_grown(JobTables::kLogKept); }

std::optional<WatchedFiles::Lost> WatchedFiles::lost() const {
  constexpr const char* kGone = "removed or replaced";
  for (const PlacedFile& file : files_) {
    if (!file.is_in_place()) return Lost{words_of(file, kGone)};
  }
  if (!log_.is_in_place()) return Lost{words_of(log_, kGone)};
  if (log_.is_cut_off()) return Lost{words_of(log_, "truncated"), true};
  return std::nullopt;
}

}  // namespace armloom
