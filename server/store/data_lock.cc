#include "server/store/data_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

namespace armloom {
namespace {

tl::unexpected<Problems> cannot_write(const std::filesystem::path& folder, const std::string& why) {
  return failure(Problem{ProblemKind::unavailable, "cannot-write", "--data",
                         "the folder " + folder.string() + " cannot be written: " + why,
                         folder.string()});
}

std::string holder(int file) {
  char text[32];
  const ssize_t size = pread(file, text, sizeof text, 0);
  if (size <= 0) return "another process";
  return "process " + std::string(text, static_cast<std::size_t>(size));
}

}  // namespace

Result<std::unique_ptr<DataLock>> DataLock::take(const std::filesystem::path& folder) {
  std::error_code ec;
  std::filesystem::create_directories(folder, ec);
  if (ec) return cannot_write(folder, ec.message());
  const int file = open((folder / kFile).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file < 0) return cannot_write(folder, std::generic_category().message(errno));
  std::unique_ptr<DataLock> lock(new DataLock(file));
  if (flock(file, LOCK_EX | LOCK_NB) != 0) {
    return failure(Problem{ProblemKind::unavailable, "data-in-use", "--data",
                           folder.string() + " is in use by " + holder(file) +
                               "; give each server its own data folder",
                           folder.string()});
  }
  const std::string pid = std::to_string(getpid());
  if (ftruncate(file, 0) != 0 || pwrite(file, pid.data(), pid.size(), 0) < 0) {
    return cannot_write(folder, std::generic_category().message(errno));
  }
  return lock;
}

DataLock::~DataLock() { close(file_); }

}  // namespace armloom
