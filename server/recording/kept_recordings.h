#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace armloom {

// What lies in a data folder, found by looking each time; any thread. A recording stands in a
// folder that is named after its begin (Recording::unused_folder), or in the data folder itself,
// beside files that are not its own. Links are not followed: neither a folder nor a file is one.

// What the one in the data folder itself is called.
inline constexpr std::string_view kInDataFolder = "data";

struct KeptRecording {
  struct File {
    std::string name;
    std::uintmax_t bytes;
  };
  std::string name;
  std::filesystem::path folder;
  std::vector<File> files;   // its own, beside the copies
  std::uintmax_t bytes = 0;  // with the copies of what the cell names
  std::optional<std::filesystem::file_time_type> begun = {};  // as its cell.json is old
  std::filesystem::file_time_type written = std::filesystem::file_time_type::min();  // last
};

// Those that have events, by when they were written, oldest first.
[[nodiscard]] std::vector<KeptRecording> recordings_in(const std::filesystem::path& data);

// Where the recording of this name would stand; nothing: none is called so.
[[nodiscard]] std::optional<std::filesystem::path> folder_of_recording(
    const std::filesystem::path& data, const std::string& name);

// "events.jsonl", "states.csv", ...: whether a recording has a file of this name of its own.
[[nodiscard]] bool is_file_of_recording(std::string_view name);

// What a recording's folder has of it, the copies too; the events are the last.
[[nodiscard]] std::vector<std::filesystem::path> files_of_recording(
    const std::filesystem::path& folder);

// The folder in it for copies of what the cell names.
[[nodiscard]] std::filesystem::path copies_of_recording(const std::filesystem::path& folder);

}  // namespace armloom
