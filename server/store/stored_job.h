#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace armloom {

// The request that created a job. It serves to recognize a repetition of the request. Digests are
// of canonical JSON.
struct RequestOrigin {
  std::string digest;           // of the job's body; "" for jobs of the server
  std::string key = {};         // Idempotency-Key, or empty
  std::string key_digest = {};  // of the whole request's body
  std::size_t place = 0;        // index of the job in a batch
};

// A job as stored. The store does not read its JSON texts.
struct StoredJob {
  std::uint64_t number = 0;  // order of acceptance over all sessions (JobId)
  std::string id;            // for clients; reusable after the job's end
  std::string state;
  bool has_ended = false;
  std::optional<std::int64_t> submitted_ms = {};  // wall time since 1970
  std::optional<std::int64_t> ended_ms = {};
  std::string arms;           // a JSON array of names
  std::string view;           // the job as last published
  RequestOrigin origin = {};  // stored on acceptance only
};

// A request that changed something or was refused.
struct AuditEntry {
  std::uint64_t number = 0;  // set when stored
  std::int64_t at_ms = 0;    // wall time since 1970
  std::string who;           // token name; "" without a token
  std::string peer;          // client address
  std::string method;
  std::string path;
  int status = 0;  // of the response
};
// Returns true if the request was refused and changed nothing. The number of stored refusals has
// its own limit, because any client can cause any number of refusals.
[[nodiscard]] inline bool was_refused(const AuditEntry& entry) {
  return entry.status >= 400 && entry.status < 500;
}

// A job that had not ended when the folder was opened.
struct LeftJob {
  StoredJob job;
  bool may_have_moved = false;
  std::optional<std::string> body;          // as the client sent it; nullopt if never acknowledged
  std::optional<std::string> amended = {};  // later changes
  bool is_damaged = false;                  // its contents are unreliable
};

}  // namespace armloom
