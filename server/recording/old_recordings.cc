#include "server/recording/old_recordings.h"

#include <algorithm>

#include "server/recording/kept_recordings.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;

std::string removed(const KeptRecording& found) {
  std::error_code ec;
  std::string fault;
  const auto remove = [&](const fs::path& file) {
    fs::remove(file, ec);
    if (ec && fault.empty()) fault = file.filename().string() + ": " + ec.message();
  };
  for (const fs::path& file : files_of_recording(found.folder)) remove(file);
  if (!fault.empty()) return fault;
  const auto remove_empty = [&](const fs::path& folder) {
    if (fs::is_directory(folder, ec) && fs::is_empty(folder, ec)) remove(folder);
  };
  remove_empty(copies_of_recording(found.folder));
  if (found.name != kInDataFolder) remove_empty(found.folder);
  return fault;
}

}  // namespace

std::vector<RemovedRecording> remove_old_recordings(const fs::path& data,
                                                    const RecordingBounds& bounds,
                                                    const std::vector<fs::path>& in_use,
                                                    fs::file_time_type now) {
  std::vector<RemovedRecording> gone;
  if (!bounds.is_any()) return gone;
  std::vector<KeptRecording> all = recordings_in(data);
  std::uintmax_t bytes = 0;
  for (const KeptRecording& found : all) bytes += found.bytes;
  const auto is_in_use = [&](const KeptRecording& found) {
    return std::ranges::any_of(in_use, [&](const fs::path& folder) {
      std::error_code ec;
      return found.folder == folder || fs::equivalent(found.folder, folder, ec);
    });
  };
  std::size_t count = all.size();
  for (const KeptRecording& found : all) {
    const bool too_many = bounds.count && count > *bounds.count;
    const bool too_old = bounds.age && now - found.written > *bounds.age;
    const bool too_large = bounds.bytes && bytes > *bounds.bytes;
    if (is_in_use(found) || !(too_many || too_old || too_large)) continue;
    gone.push_back({found.folder, found.bytes, removed(found)});
    if (!gone.back().fault.empty()) continue;
    --count;
    bytes -= found.bytes;
  }
  return gone;
}

OldRecordings::OldRecordings(Place place, RecordingBounds bounds, std::chrono::milliseconds period,
                             std::function<void(const RemovedRecording&)> tell)
    : thread_([this, place = std::move(place), bounds, period,
               tell = std::move(tell)](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
          const auto now = fs::file_time_type::clock::now();
          for (const auto& one : remove_old_recordings(place.data, bounds, place.in_use, now)) {
            tell(one);
          }
          std::unique_lock lock(mutex_);
          end_.wait_for(lock, stop, period, [] { return false; });
        }
      }) {}

}  // namespace armloom
