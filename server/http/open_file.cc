#include "server/http/open_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace armloom {
namespace fs = std::filesystem;

Refusal too_many_files() {
  return {503,          "server-busy", "too many files and connections are open; retry later",
          std::nullopt, std::nullopt,  {{"Retry-After", "1"}}};
}

tl::expected<OpenFile, NoFile> OpenFile::open(const fs::path& path, std::size_t size_max) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (fd < 0) {
    const bool busy = errno == EMFILE || errno == ENFILE || errno == ENOMEM;
    return tl::unexpected(busy ? NoFile::busy : NoFile::absent);
  }
  OpenFile file(fd);
  struct stat status {};
  if (fstat(fd, &status) != 0 || !S_ISREG(status.st_mode)) return tl::unexpected(NoFile::absent);
  file.size_ = static_cast<std::size_t>(status.st_size);
  if (file.size_ > size_max) return tl::unexpected(NoFile::absent);
  // Asks the kernel for the path of the open file. `path` may lead to another file by now.
  std::error_code ec;
  file.place_ = fs::read_symlink("/proc/self/fd/" + std::to_string(fd), ec);
  if (ec) return tl::unexpected(NoFile::absent);
  for (const long long part :
       {static_cast<long long>(status.st_dev), static_cast<long long>(status.st_ino),
        static_cast<long long>(status.st_size), static_cast<long long>(status.st_mtim.tv_sec),
        static_cast<long long>(status.st_mtim.tv_nsec)}) {
    file.stamp_ += std::to_string(part) + " ";
  }
  return file;
}

OpenFile::OpenFile(OpenFile&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)),
      size_(other.size_),
      place_(std::move(other.place_)),
      stamp_(std::move(other.stamp_)) {}

OpenFile::~OpenFile() {
  if (fd_ >= 0) close(fd_);
}

bool OpenFile::is_inside(const fs::path& canonical_folder) const {
  const auto [end, unused] =
      std::mismatch(canonical_folder.begin(), canonical_folder.end(), place_.begin(), place_.end());
  return end == canonical_folder.end();
}

tl::expected<std::string, NoFile> OpenFile::read(std::size_t from, std::size_t size) const {
  std::string bytes(size, '\0');
  std::size_t done = 0;
  while (done < size) {
    const auto at = static_cast<off_t>(from + done);
    const ssize_t got = pread(fd_, bytes.data() + done, size - done, at);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return tl::unexpected(NoFile::absent);  // the file has shrunk
    done += static_cast<std::size_t>(got);
  }
  return bytes;
}

}  // namespace armloom
