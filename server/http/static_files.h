#pragma once

#include <filesystem>
#include <utility>

#include "server/http/message.h"

namespace armloom {

// The files of a folder, as the dashboard needs them: GET only, "/" is index.html, MIME types by
// extension. Files under /assets carry a hash in their names and may be cached for ever, the rest
// is asked for again. Nothing outside the folder is served, not by "..", not through a link, and no
// file whose name begins with a dot.
class StaticFiles {
 public:
  // A folder that does not exist (yet) is looked for again at each request.
  StaticFiles(std::filesystem::path folder, WriteRefusal refuse)
      : folder_(std::move(folder)), refuse_(std::move(refuse)) {}
  [[nodiscard]] Response answer(const Request& request) const;

 private:
  std::filesystem::path folder_;
  WriteRefusal refuse_;
};

}  // namespace armloom
