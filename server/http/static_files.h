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

// The files of a folder, as the dashboard needs them: GET only, "/" is index.html, MIME types by
// extension. Files under /assets carry a hash in their names and may be cached for ever, the rest
// is asked for again, by its ETag. Nothing outside the folder is served, not by "..", not through a
// link, and no file whose name begins with a dot. Each file is held once, packed where that pays,
// for as long as it is as it was read; all of them have at most 64 MiB.
class StaticFiles {
 public:
  // Reads the folder. One that does not exist (yet) is looked for again at each request.
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
  std::map<std::filesystem::path, Held> held_;  // by place
  std::size_t held_bytes_ = 0;
};

}  // namespace armloom
