#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "core/base/problem.h"
#include "server/http/open_file.h"
#include "server/messages/recording.h"
#include "server/recording/recording.h"

namespace armloom {

// Serves recordings to HTTP clients. A request names a recording and one of its files, never a
// path. Thread-safe. Call it on a worker thread, because it reads from disk.
class RecordingFiles {
 public:
  // Maximum number of open files. Each file takes a descriptor while its client reads.
  inline static constexpr std::size_t kOpenMax = 32;

  // `running`: the recording being written, or null; must outlive this object.
  RecordingFiles(std::optional<std::filesystem::path> data, const Recording* running)
      : data_(std::move(data)), running_(running) {}

  [[nodiscard]] RecordingList list() const;
  [[nodiscard]] bool is_running(const std::string& name) const;

  struct Opened {
    std::shared_ptr<const OpenFile> file;
    std::size_t size = 0;  // bytes that the client gets
  };
  // Opens a file of a recording; refuses symbolic links. If the recording is in progress, `size`
  // ends at the last complete line.
  [[nodiscard]] tl::expected<Opened, NoFile> open(const std::string& name,
                                                  const std::string& file) const;

 private:
  std::optional<std::filesystem::path> data_;
  const Recording* running_;
  std::shared_ptr<std::atomic<std::size_t>> open_ = std::make_shared<std::atomic<std::size_t>>(0);
};

}  // namespace armloom
