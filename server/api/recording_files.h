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

// The recordings in a data folder, for who reads them over HTTP. A request holds the name of a
// recording and of one of its files, never a path. Thread-safe: asked aside, as disks are slow.
class RecordingFiles {
 public:
  // At once; one more is busy: each holds a file descriptor for as long as its reader takes.
  inline static constexpr std::size_t kOpenMax = 32;

  // `data`: absent: there are none. `running`: the one that is being written, if any; outlives
  // this.
  RecordingFiles(std::optional<std::filesystem::path> data, const Recording* running)
      : data_(std::move(data)), running_(running) {}

  [[nodiscard]] RecordingList list() const;
  [[nodiscard]] bool is_running(const std::string& name) const;

  struct Opened {
    std::shared_ptr<const OpenFile> file;
    std::size_t size = 0;  // so much of it is handed out
  };
  // A file that is no link, in a folder of the data folder that is none. Of one that is being
  // written so much as is there, in whole lines.
  [[nodiscard]] tl::expected<Opened, NoFile> open(const std::string& name,
                                                  const std::string& file) const;

 private:
  std::optional<std::filesystem::path> data_;
  const Recording* running_;
  std::shared_ptr<std::atomic<std::size_t>> open_ = std::make_shared<std::atomic<std::size_t>>(0);
};

}  // namespace armloom
