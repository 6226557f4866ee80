#include "server/recording/kept_recordings.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace armloom {
namespace {

namespace fs = std::filesystem;

// Files of a recording, without the copies.
constexpr std::array<std::string_view, 8> kFiles = {
    "events.jsonl",         "states.csv", "states_idle.csv", "true_states.csv",
    "true_states_idle.csv", "cell.json",  "jobs.json",       "inputs.jsonl"};

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

bool has_events(const fs::path& folder) {
  std::error_code ec;
  return fs::is_regular_file(fs::symlink_status(folder / "events.jsonl", ec));
}

KeptRecording look_at(std::string name, const fs::path& folder) {
  KeptRecording found{.name = std::move(name), .folder = folder, .files = {}};
  std::error_code ec;
  for (const fs::path& file : files_of_recording(folder)) {
    const std::uintmax_t bytes = fs::file_size(file, ec);
    if (ec) continue;
    found.bytes += bytes;
    if (file.parent_path() != folder) continue;  // copies are not listed
    found.files.push_back({file.filename().string(), bytes});
    const auto written = fs::last_write_time(file, ec);
    if (ec) continue;
    found.written = std::max(found.written, written);
    if (file.filename() == "cell.json") found.begun = written;
  }
  std::ranges::reverse(found.files);
  return found;
}

}  // namespace

fs::path copies_of_recording(const fs::path& folder) { return folder / "files"; }

bool is_file_of_recording(std::string_view name) {
  return std::ranges::find(kFiles, name) != kFiles.end();
}

// The events are last, so that recordings_in() still finds a recording whose removal failed
// halfway.
std::vector<fs::path> files_of_recording(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ec;
  const fs::path copies = copies_of_recording(folder);
  if (fs::symlink_status(copies, ec).type() == fs::file_type::directory) {
    for (const fs::directory_entry& entry : fs::directory_iterator(copies, ec)) {
      if (entry.symlink_status(ec).type() == fs::file_type::regular) files.push_back(entry.path());
    }
  }
  for (auto name = kFiles.rbegin(); name != kFiles.rend(); ++name) {
    const fs::path file = folder / *name;
    if (fs::is_regular_file(fs::symlink_status(file, ec))) files.push_back(file);
  }
  return files;
}

std::optional<fs::path> folder_of_recording(const fs::path& data, const std::string& name) {
  if (name == kInDataFolder) return data;
  return is_name_of_recording(name) ? std::optional(data / name) : std::nullopt;
}

std::vector<KeptRecording> recordings_in(const fs::path& data) {
  std::vector<KeptRecording> all;
  std::error_code ec;
  if (has_events(data)) all.push_back(look_at(std::string(kInDataFolder), data));
  for (const fs::directory_entry& entry : fs::directory_iterator(data, ec)) {
    const bool is_folder = entry.symlink_status(ec).type() == fs::file_type::directory;
    const std::string name = entry.path().filename().string();
    if (!is_folder || !is_name_of_recording(name)) continue;
    if (has_events(entry.path())) all.push_back(look_at(name, entry.path()));
  }
  std::ranges::sort(all, {}, [](const KeptRecording& found) {
    return std::pair(found.written, found.folder.string());
  });
  return all;
}

}  // namespace armloom
