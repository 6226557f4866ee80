#pragma once

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace armloom {

// Detects that a file was removed, replaced or truncated since construction. If it was, this
// process still has the old file open, and writes to a file that no other process can find.
// Precondition: the file exists.
class PlacedFile {
 public:
  explicit PlacedFile(std::filesystem::path path) : path_(std::move(path)) {
    (void)stat(path_.c_str(), &was_);
  }

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] bool is_in_place() const {
    struct stat now {};
    return stat(path_.c_str(), &now) == 0 && now.st_dev == was_.st_dev && now.st_ino == was_.st_ino;
  }

  // Sets the length below which the file is cut off: its present length, but at most `most` bytes.
  void has_grown(std::uintmax_t most) {
    struct stat now {};
    if (stat(path_.c_str(), &now) == 0)
      least_ = std::min(most, static_cast<std::uintmax_t>(now.st_size));
  }
  [[nodiscard]] bool is_cut_off() const {
    struct stat now {};
    return stat(path_.c_str(), &now) == 0 && static_cast<std::uintmax_t>(now.st_size) < least_;
  }

 private:
  std::filesystem::path path_;
  struct stat was_ {};
  std::uintmax_t least_ = 0;
};

// Returns the path of SQLite's log of a store.
[[nodiscard]] std::filesystem::path log_of(const std::filesystem::path& folder);

// Watches the files by which a running server holds its data folder. If a file is gone, a second
// server does not find the data, or not that the folder is in use. Use on one thread.
class WatchedFiles {
 public:
  // Precondition: all files exist.
  explicit WatchedFiles(const std::filesystem::path& folder);

  void log_has_grown();

  struct Lost {
    std::string text;
    bool is_log_cut_off = false;
  };
  // Returns a description of the first file that is not as it was, or nullopt.
  [[nodiscard]] std::optional<Lost> lost() const;

 private:
  std::array<PlacedFile, 3> files_;
  PlacedFile log_;
};

}  // namespace armloom
