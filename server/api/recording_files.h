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

// Gives HTTP clients access to the recordings in a data folder. A request contains the name of a
// recording and of one of its files, never a path. Thread-safe; call it on a worker thread, because
// disks are slow.
class RecordingFiles {
 public:
  // Number of files open at once; more are refused as busy, because each holds a file descriptor as
  // long as its client reads.
  inline static constexpr std::size_t kOpenMax = 32;

  // `data`: nullopt if there are no recordings. `running`: the recording being written, or null;
  // must outlive this object.
  RecordingFiles(std::optional<std::filesystem::path> data, const Recording* running)
      : data_(std::move(data)), running_(running) {}

  [[nodiscard]] RecordingList list() const;
  [[nodiscard]] bool is_running(const std::string& name) const;

  struct Opened {
    std::shared_ptr<const OpenFile> file;
    std::size_t size = 0;  // bytes to hand out
  };
  // Opens a file of a recording; symbolic links are refused. Of a recording in progress, only
  // complete lines are handed out.
  [[nodiscard]] tl::expected<Opened, NoFile> open(const std::string& name,
                                                  const std::string& file) const;

 private:
  std::optional<std::filesystem::path> data_;
  const Recording* running_;
  std::shared_ptr<std::atomic<std::size_t>> open_ = std::make_shared<std::atomic<std::size_t>>(0);
};

}  // namespace armloom
