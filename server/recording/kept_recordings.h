#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace armloom {

// Finds the recordings in a data folder; each call searches the folder again. Thread-safe. A
// recording is in a folder named after its start (Recording::unused_folder), or in the data folder
// itself, among other files. Links are not followed.

// Name of the recording in the data folder itself.
inline constexpr std::string_view kInDataFolder = "data";

struct KeptRecording {
  struct File {
    std::string name;
    std::uintmax_t bytes;
  };
  std::string name;
  std::filesystem::path folder;
  std::vector<File> files;   // the recording's own files, without copies
  std::uintmax_t bytes = 0;  // with copies
  std::optional<std::filesystem::file_time_type> begun = {};  // modification time of cell.json
  std::filesystem::file_time_type written = std::filesystem::file_time_type::min();  // last write
};

// Returns the recordings that have events, least recently written first.
[[nodiscard]] std::vector<KeptRecording> recordings_in(const std::filesystem::path& data);

// Returns the folder for a recording of this name; nullopt if no recording has such a name.
[[nodiscard]] std::optional<std::filesystem::path> folder_of_recording(
    const std::filesystem::path& data, const std::string& name);

// Returns true for the name of a recording's own file: "events.jsonl", "states.csv", ...
[[nodiscard]] bool is_file_of_recording(std::string_view name);

// Returns the paths of a recording's files, including copies. The file of events is last.
[[nodiscard]] std::vector<std::filesystem::path> files_of_recording(
    const std::filesystem::path& folder);

// Returns the subfolder for copies of the cell's files.
[[nodiscard]] std::filesystem::path copies_of_recording(const std::filesystem::path& folder);

}  // namespace armloom
