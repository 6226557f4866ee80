#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/access/token_file.h"

namespace armloom {

// Who has shown a token.
struct Caller {
  std::string name;
  Role role = Role::viewer;
};

// The tokens of a server as their file has them now: what is added or withdrawn counts at once.
// Nobody has one while the file cannot be read. One thread.
class TokenBook {
 public:
  explicit TokenBook(TokenFile file) : file_(std::move(file)) {}

  [[nodiscard]] std::optional<Caller> caller(std::string_view token);

 private:
  void look();
  TokenFile file_;
  std::string stamp_;  // of the file as it was read
  std::vector<KeptToken> tokens_;
};

}  // namespace armloom
