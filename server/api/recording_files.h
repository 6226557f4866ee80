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

// Recordings for HTTP clients. A request contains the names of a recording and of its file, never a
// path. Thread-safe; call it on a worker thread.
class RecordingFiles {
 public:
  // Files open at once; each holds a descriptor while its client reads.
  inline static constexpr std::size_t kOpenMax = 32;

  // `running`: the recording being written, or null; must outlive this object.
  RecordingFiles(std::optional<std::filesystem::path> data, const Recording* running)
      : data_(std::move(data)), running_(running) {}

  [[nodiscard]] RecordingList list() const;
  [[nodiscard]] bool is_running(const std::string& name) const;

  struct Opened {
    std::shared_ptr<const OpenFile> file;
    std::size_t size = 0;  // bytes to hand out
  };
  // Refuses symbolic links. Of a recording in progress only complete lines are available.
  [[nodiscard]] tl::expected<Opened, NoFile> open(const std::string& name,
                                                  const std::string& file) const;

 private:
  std::optional<std::filesystem::path> data_;
  const Recording* running_;
  std::shared_ptr<std::atomic<std::size_t>> open_ = std::make_shared<std::atomic<std::size_t>>(0);
};

}  // namespace armloom
