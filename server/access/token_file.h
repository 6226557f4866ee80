#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/base/problem.h"
#include "server/access/role.h"

namespace armloom {

// A stored token. Only its digest is kept, so the token itself cannot be recovered.
struct KeptToken {
  std::string name;  // of the client
  Role role = Role::viewer;
  std::string digest;   // SHA-256 of the token
  std::string made_at;  // RFC 3339
};

// The token file of a server: lines of "name role digest made_at". Each change replaces the whole
// file. Only one process at a time can change it.
class TokenFile {
 public:
  explicit TokenFile(std::filesystem::path file) : file_(std::move(file)) {}

  // Returns all tokens. Problems: the file is missing or unreadable (not_found), or a line is
  // invalid (invalid).
  [[nodiscard]] Result<std::vector<KeptToken>> read() const;
  // Returns a new token, which cannot be shown again. Creates a missing file, readable only by its
  // owner. Problems: the name is invalid or in use (conflict); the file cannot be written
  // (unavailable).
  [[nodiscard]] Result<std::string> add(const std::string& name, Role role);
  // Problem (not_found): no token has this name.
  [[nodiscard]] Result<void> revoke(const std::string& name);

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

 private:
  [[nodiscard]] Result<void> write(const std::vector<KeptToken>& tokens) const;
  std::filesystem::path file_;
};

}  // namespace armloom
