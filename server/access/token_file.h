#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/base/problem.h"
#include "server/access/role.h"

namespace armloom {

// A token as it is kept: what it is itself is known only to whom it was given.
struct KeptToken {
  std::string name;  // of whom it was given to
  Role role = Role::viewer;
  std::string digest;   // SHA-256 of the token
  std::string made_at;  // RFC 3339
};

// The file of a server's tokens: a line each, "name role digest made_at". Changed whole or not at
// all, and by one process at a time; who reads it sees the change at once.
class TokenFile {
 public:
  explicit TokenFile(std::filesystem::path file) : file_(std::move(file)) {}

  // Problems: it is not there or cannot be read (not_found), a line is no token (invalid).
  [[nodiscard]] Result<std::vector<KeptToken>> read() const;
  // A new token, which is said this once. The file is made if there is none, readable by its owner
  // alone. Problems: the name is none, or is taken (conflict); it cannot be written (unavailable).
  [[nodiscard]] Result<std::string> add(const std::string& name, Role role);
  // Problem (not_found): there is none of that name.
  [[nodiscard]] Result<void> revoke(const std::string& name);

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

 private:
  [[nodiscard]] Result<void> write(const std::vector<KeptToken>& tokens) const;
  std::filesystem::path file_;
};

}  // namespace armloom
