#pragma once

#include <filesystem>
#include <memory>

#include "core/base/problem.h"

namespace armloom {

// That a data folder is this process's, as long as kFile stands in it. Given back when it is
// destroyed, or with the process, however that ends.
class DataLock {
 public:
  static constexpr const char* kFile = "armloom.lock";
  // Makes the folder. Problem: another process has it, or it cannot be written.
  [[nodiscard]] static Result<std::unique_ptr<DataLock>> take(const std::filesystem::path& folder);
  ~DataLock();
  DataLock(const DataLock&) = delete;
  DataLock& operator=(const DataLock&) = delete;

 private:
  explicit DataLock(int file) : file_(file) {}
  int file_;
};

}  // namespace armloom
