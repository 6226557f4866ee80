#pragma once

#include <filesystem>
#include <memory>

#include "core/base/problem.h"

namespace armloom {

// Exclusive use of a data folder by this process (a lock on kFile). Released on destruction, or
// with the process, however it ends.
class DataLock {
 public:
  static constexpr const char* kFile = "armloom.lock";
  // Creates the folder. Problem: another process uses it, or it cannot be written.
  [[nodiscard]] static Result<std::unique_ptr<DataLock>> take(const std::filesystem::path& folder);
  ~DataLock();
  DataLock(const DataLock&) = delete;
  DataLock& operator=(const DataLock&) = delete;

 private:
  explicit DataLock(int file) : file_(file) {}
  int file_;
};

}  // namespace armloom
