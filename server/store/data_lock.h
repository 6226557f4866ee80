#pragma once

#include <filesystem>
#include <memory>

#include "core/base/problem.h"

namespace armloom {

// Exclusive use of a data folder by this process (a lock on kFile). Released on destruction, or
// when the process ends in any way.
class DataLock {
 public:
  static constexpr const char* kFile = "armloom.lock";
  // Creates the folder if needed, and locks it. Problem: another process uses the folder, or the
  // folder cannot be written.
  [[nodiscard]] static Result<std::unique_ptr<DataLock>> take(const std::filesystem::path& folder);
  ~DataLock();
  DataLock(const DataLock&) = delete;
  DataLock& operator=(const DataLock&) = delete;

 private:
  explicit DataLock(int file) : file_(file) {}
  int file_;
};

}  // namespace armloom
