#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "server/store/placed_file.h"

namespace armloom {

// SQLite's log beside the store of a data folder.
[[nodiscard]] std::filesystem::path log_of(const std::filesystem::path& folder);

// The files by which a running server holds its data folder: whoever starts on the folder when one
// of them has gone would not find what is written, nor that it is in use. One thread.
class WatchedFiles {
 public:
  // Precondition: all of them are there.
  explicit WatchedFiles(const std::filesystem::path& folder);

  void log_has_grown();

  struct Lost {
    std::string text;
    bool is_log_cut_off = false;
  };
  // What of them is no longer as it was; the first one.
  [[nodiscard]] std::optional<Lost> lost() const;

 private:
  std::array<PlacedFile, 3> files_;
  PlacedFile log_;
};

}  // namespace armloom
