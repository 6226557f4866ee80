#include "server/recording/old_recordings.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace armloom {
namespace {

namespace fs = std::filesystem;

// All that a recording consists of, beside the copies in kCopies.
constexpr const char* kCopies = "files";
constexpr std::array kFiles = {"events.jsonl", "states.csv", "states_idle.csv",
                               "cell.json",    "jobs.json",  "inputs.jsonl"};

// "2026-11-21T09-33-00Z", "2026-11-21T09-33-00Z.2"
bool is_name_of_recording(const std::string& name) {
  static constexpr std::string_view kPattern = "dddd-dd-ddTdd-dd-ddZ";
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (name.size() < kPattern.size()) return false;
  for (std::size_t i = 0; i < kPattern.size(); ++i) {
    if (kPattern[i] == 'd' ? !is_digit(name[i]) : name[i] != kPattern[i]) return false;
  }
  const std::string more = name.substr(kPattern.size());
  return more.empty() ||
         (more.size() > 1 && more[0] == '.' && std::all_of(more.begin() + 1, more.end(), is_digit));
}

struct Found {
  fs::path folder;
  bool is_data_folder;  // the recording's files stand in it beside others
  fs::file_time_type written = fs::file_time_type::min();
  std::uintmax_t bytes = 0;
};

// The events last: where the rest cannot be removed it still is a recording.
std::vector<fs::path> files_of(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ec;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / kCopies, ec)) {
    if (entry.symlink_status(ec).type() == fs::file_type::regular) files.push_back(entry.path());
  }
  for (auto name = kFiles.rbegin(); name != kFiles.rend(); ++name) {
    const fs::path file = folder / *name;
    if (fs::is_regular_file(fs::symlink_status(file, ec))) files.push_back(file);
  }
  return files;
}

Found look_at(const fs::path& folder, bool is_data_folder) {
  Found found{folder, is_data_folder};
  std::error_code ec;
  for (const fs::path& file : files_of(folder)) {
    const std::uintmax_t bytes = fs::file_size(file, ec);
    if (!ec) found.bytes += bytes;
    if (file.parent_path() != folder) continue;  // a copy is as old as what it was made of
    const auto written = fs::last_write_time(file, ec);
    if (!ec) found.written = std::max(found.written, written);
  }
  return found;
}

// Oldest first.
std::vector<Found> recordings_in(const fs::path& data) {
  std::vector<Found> all;
  std::error_code ec;
  if (fs::exists(data / "events.jsonl", ec)) all.push_back(look_at(data, true));
  for (const fs::directory_entry& entry : fs::directory_iterator(data, ec)) {
    const bool is_folder = entry.symlink_status(ec).type() == fs::file_type::directory;
    if (!is_folder || !is_name_of_recording(entry.path().filename().string())) continue;
    if (fs::exists(entry.path() / "events.jsonl", ec)) all.push_back(look_at(entry.path(), false));
  }
  std::ranges::sort(
      all, {}, [](const Found& found) { return std::pair(found.written, found.folder.string()); });
  return all;
}

std::string removed(const Found& found) {
  std::error_code ec;
  std::string fault;
  const auto remove = [&](const fs::path& file) {
    fs::remove(file, ec);
    if (ec && fault.empty()) fault = file.filename().string() + ": " + ec.message();
  };
  for (const fs::path& file : files_of(found.folder)) remove(file);
  if (!fault.empty()) return fault;
  const auto remove_empty = [&](const fs::path& folder) {
    if (fs::is_directory(folder, ec) && fs::is_empty(folder, ec)) remove(folder);
  };
  remove_empty(found.folder / kCopies);
  if (!found.is_data_folder) remove_empty(found.folder);
  return fault;
}

}  // namespace

std::vector<RemovedRecording> remove_old_recordings(const fs::path& data,
                                                    const RecordingBounds& bounds,
                                                    const std::vector<fs::path>& in_use,
                                                    fs::file_time_type now) {
  std::vector<RemovedRecording> gone;
  if (!bounds.is_any()) return gone;
  std::vector<Found> all = recordings_in(data);
  std::uintmax_t bytes = 0;
  for (const Found& found : all) bytes += found.bytes;
  const auto is_in_use = [&](const Found& found) {
    return std::ranges::any_of(in_use, [&](const fs::path& folder) {
      std::error_code ec;
      return found.folder == folder || fs::equivalent(found.folder, folder, ec);
    });
  };
  std::size_t count = all.size();
  for (const Found& found : all) {
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
