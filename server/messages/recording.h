#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "server/codec/format.h"

namespace armloom {

struct RecordingFileView {
  std::string name;
  std::uint64_t bytes = 0;
};

// One recording in the data folder.
struct RecordingView {
  std::string name;
  std::optional<std::string> begun_at;  // RFC 3339
  std::string written_at;               // RFC 3339
  bool is_running = false;
  bool has_states = false;
  std::vector<RecordingFileView> files;
};

// Answer to GET /recordings.
struct RecordingList {
  bool is_kept = false;  // this server writes recordings
  std::vector<RecordingView> recordings;
};
[[nodiscard]] FormatPtr<RecordingList> recording_list_format();

}  // namespace armloom
