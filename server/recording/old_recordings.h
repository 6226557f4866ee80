#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace armloom {

// Limits for the recordings in a data folder, including the current recording, which is always
// kept.
struct RecordingBounds {
  std::optional<std::size_t> count = {};
  std::optional<std::chrono::days> age = {};  // since the last write
  std::optional<std::uintmax_t> bytes = {};   // in total

  [[nodiscard]] bool is_any() const { return count || age || bytes; }
};

// Removes recordings, least recently written first, until the limits hold. Keeps recordings in the
// folders `in_use`. Removes only files that Recording creates, in the data folder and in subfolders
// named by Recording.
struct RemovedRecording {
  std::filesystem::path folder;
  std::uintmax_t bytes;
  std::string fault;  // why it was not removed completely, or empty
};
[[nodiscard]] std::vector<RemovedRecording> remove_old_recordings(
    const std::filesystem::path& data, const RecordingBounds& bounds,
    const std::vector<std::filesystem::path>& in_use, std::filesystem::file_time_type now);

// Removes old recordings periodically. Has its own thread, which starts on construction.
class OldRecordings {
 public:
  struct Place {
    std::filesystem::path data;
    // folders of the current recording and of its cell file
    std::vector<std::filesystem::path> in_use;
  };
  OldRecordings(Place place, RecordingBounds bounds, std::chrono::milliseconds period,
                std::function<void(const RemovedRecording&)> tell);  // called on that thread

 private:
  std::mutex mutex_;
  std::condition_variable_any end_;
  std::jthread thread_;  // last member: ends first
};

}  // namespace armloom
