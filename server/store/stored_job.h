#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace armloom {

// The request by which a job came, so that one that is sent again is known. Digests are of JSON in
// one way of writing.
struct RequestOrigin {
  std::string digest;           // of the job's body; empty: not known, as of older versions' jobs
  std::string key = {};         // Idempotency-Key, or empty
  std::string key_digest = {};  // of the whole request's body
  std::size_t place = 0;        // in a batch
};

// A job as it is stored. Its texts are JSON, which the store does not read.
struct StoredJob {
  std::uint64_t number = 0;  // the order of acceptance, over all runs (JobId)
  std::string id;            // by which clients know it; an ended job's may be used again
  std::string state;
  bool has_ended = false;
  std::optional<std::int64_t> submitted_ms = {};  // of wall time, since 1970
  std::optional<std::int64_t> ended_ms = {};
  std::string arms;           // an array of names
  std::string view;           // the job as it was told last
  RequestOrigin origin = {};  // put down when it is accepted; later ones are not looked at
};

// That someone did, or was not let do, something.
struct AuditEntry {
  std::uint64_t number = 0;  // given when it is stored
  std::int64_t at_ms = 0;    // of wall time, since 1970
  std::string who;           // the token's name; empty: none was shown, or none is asked for
  std::string peer;          // the address that it came from
  std::string method;
  std::string path;
  int status = 0;  // of the answer
};
// It changed nothing: for want of a right, or of sense. Anybody may be refused, as often as they
// ask; so the two kinds are kept apart, and as many of each.
[[nodiscard]] inline bool was_refused(const AuditEntry& entry) {
  return entry.status >= 400 && entry.status < 500;
}

// One that had not ended when the folder was opened.
struct LeftJob {
  StoredJob job;
  bool may_have_moved = false;
  std::optional<std::string> body;  // as the client sent it; none: it never was acknowledged
  std::optional<std::string> amended = {};  // what was changed of it later; none: nothing
  bool is_damaged = false;                  // it is not as it was written: nothing of it is certain
};

}  // namespace armloom
