#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace armloom {

// A job as it is stored. Its texts are JSON, which the store does not read.
struct StoredJob {
  std::uint64_t number = 0;  // the order of acceptance, over all runs (JobId)
  std::string id;            // by which clients know it; an ended job's may be used again
  std::string state;
  bool has_ended = false;
  std::optional<std::int64_t> submitted_ms = {};  // of wall time, since 1970
  std::optional<std::int64_t> ended_ms = {};
  std::string arms;  // an array of names
  std::string view;  // the job as it was told last
};

// One that had not ended when the folder was opened.
struct LeftJob {
  StoredJob job;
  bool may_have_moved = false;
  std::optional<std::string> body;  // as the client sent it; none: it never was acknowledged
};

}  // namespace armloom
