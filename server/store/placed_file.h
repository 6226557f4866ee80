#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <utility>

namespace armloom {

// A file as it stood at its path when this was made (precondition: it did): whoever has it open
// goes on to write where nobody will look when it was removed or replaced since.
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

 private:
  std::filesystem::path path_;
  struct stat was_ {};
};

}  // namespace armloom
