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

// How much of the recordings in a data folder is kept, the one that is being written included; that
// one stays whatever it takes.
struct RecordingBounds {
  std::optional<std::size_t> count = {};
  std::optional<std::chrono::days> age = {};  // since it was written last
  std::optional<std::uintmax_t> bytes = {};   // of all together

  [[nodiscard]] bool is_any() const { return count || age || bytes; }
};

// Removes recordings of a data folder until its bounds hold, those first that were written longest
// ago, and never one in a folder that is in use: of the data folder itself and of folders in it
// that bear Recording's kind of name the files that Recording makes. Everything else is left alone.
struct RemovedRecording {
  std::filesystem::path folder;
  std::uintmax_t bytes;
  std::string fault;  // why it could not be removed whole; empty: it was
};
[[nodiscard]] std::vector<RemovedRecording> remove_old_recordings(
    const std::filesystem::path& data, const RecordingBounds& bounds,
    const std::vector<std::filesystem::path>& in_use, std::filesystem::file_time_type now);

// Does that again and again, on a thread of its own, from its making on.
class OldRecordings {
 public:
  struct Place {
    std::filesystem::path data;
    std::vector<std::filesystem::path> in_use;  // folders: of the running one, of its cell file
  };
  OldRecordings(Place place, RecordingBounds bounds, std::chrono::milliseconds period,
                std::function<void(const RemovedRecording&)> tell);  // on that thread

 private:
  std::mutex mutex_;
  std::condition_variable_any end_;
  std::jthread thread_;  // the last: it ends first
};

}  // namespace armloom
