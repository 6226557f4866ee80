#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

#include "core/base/problem.h"
#include "server/http/message.h"

namespace armloom {

// Why a file cannot be read. absent: it is missing, not a regular file, too large or has shrunk.
// busy: the system lacks file descriptors or memory at present; the file itself may be readable.
enum class NoFile { absent, busy };
// Returns the refusal for NoFile::busy.
[[nodiscard]] Refusal too_many_files();

// An open file with its real path. Checks and reads refer to this file, even if its path leads to
// another file later.
class OpenFile {
 public:
  // Opens a regular file of at most `size_max` bytes. Follows links.
  [[nodiscard]] static tl::expected<OpenFile, NoFile> open(const std::filesystem::path& path,
                                                           std::size_t size_max);
  ~OpenFile();
  OpenFile(OpenFile&& other) noexcept;
  OpenFile& operator=(OpenFile&&) = delete;

  [[nodiscard]] const std::filesystem::path& place() const { return place_; }  // links resolved
  [[nodiscard]] bool is_inside(const std::filesystem::path& canonical_folder) const;
  // Returns a text that changes if the file is replaced or written to.
  [[nodiscard]] const std::string& stamp() const { return stamp_; }
  [[nodiscard]] std::size_t size() const { return size_; }  // when opened
  [[nodiscard]] tl::expected<std::string, NoFile> read() const { return read(0, size_); }
  // Returns exactly `size` bytes starting at `from`, even if the file has grown. Returns
  // NoFile::absent if the file has shrunk.
  [[nodiscard]] tl::expected<std::string, NoFile> read(std::size_t from, std::size_t size) const;

 private:
  explicit OpenFile(int fd) : fd_(fd) {}
  int fd_;
  std::size_t size_ = 0;
  std::filesystem::path place_;
  std::string stamp_;
};

}  // namespace armloom
