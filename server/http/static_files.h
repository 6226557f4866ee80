#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "server/http/message.h"
#include "server/http/open_file.h"
#include "server/http/served_bytes.h"

namespace armloom {

// Serves the files of the dashboard's folder, by GET only; "/" is index.html. Files under /assets
// have hashed names and are cached forever; others are revalidated by ETag. Hidden files, and files
// outside the folder (by ".." or a link), are not served. Files stay in memory until they change,
// also compressed if that is smaller, 64 MiB at most.
class StaticFiles {
 public:
  // Reads the folder. If the folder is missing, each request looks for it again.
  StaticFiles(std::filesystem::path folder, WriteRefusal refuse);
  [[nodiscard]] Response answer(const Request& request);

 private:
  struct Held {
    std::string stamp;
    ServedBytes bytes;
  };
  [[nodiscard]] tl::expected<ServedBytes, NoFile> look_up(const std::filesystem::path& relative);
  [[nodiscard]] Response not_served(const std::string& path, NoFile why) const;

  std::filesystem::path folder_;
  WriteRefusal refuse_;
  std::map<std::filesystem::path, Held> held_;  // by real path
  std::size_t held_bytes_ = 0;
};

}  // namespace armloom
