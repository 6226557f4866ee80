#include "server/store/sync_folder.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

namespace armloom {

void sync_folder(const std::filesystem::path& folder) {
  const int opened = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool is_synced = opened >= 0 && fsync(opened) == 0;
  const int why = errno;
  if (opened >= 0) close(opened);
  if (!is_synced) throw std::system_error(why, std::generic_category(), folder.string());
}

}  // namespace armloom
