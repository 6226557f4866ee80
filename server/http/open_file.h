#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

#include "core/base/problem.h"
#include "server/http/message.h"

namespace armloom {

// Why a file is not read: there is none to be read (any more), or just now there are too few file
// descriptors, which says nothing of the file.
enum class NoFile { absent, busy };
// How the latter is told.
[[nodiscard]] Refusal too_many_files();

// A file that is open for reading, and where it truly is: what a name leads to may change at any
// time, what is open does not.
class OpenFile {
 public:
  // A regular file of at most `size_max` bytes; links are followed.
  [[nodiscard]] static tl::expected<OpenFile, NoFile> open(const std::filesystem::path& path,
                                                           std::size_t size_max);
  ~OpenFile();
  OpenFile(OpenFile&& other) noexcept;
  OpenFile& operator=(OpenFile&&) = delete;

  [[nodiscard]] const std::filesystem::path& place() const { return place_; }  // without links
  [[nodiscard]] bool is_inside(const std::filesystem::path& canonical_folder) const;
  // Changes when the file is another one, or written to.
  [[nodiscard]] const std::string& stamp() const { return stamp_; }
  [[nodiscard]] std::size_t size() const { return size_; }  // as it was opened
  [[nodiscard]] tl::expected<std::string, NoFile> read() const { return read(0, size_); }
  // Exactly `size` bytes from `from` on, however it grows; absent: it has shrunk since.
  [[nodiscard]] tl::expected<std::string, NoFile> read(std::size_t from, std::size_t size) const;

 private:
  explicit OpenFile(int fd) : fd_(fd) {}
  int fd_;
  std::size_t size_ = 0;
  std::filesystem::path place_;
  std::string stamp_;
};

}  // namespace armloom
