#pragma once

#include <functional>
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

// The tokens of a server as their file has them now: what is added or revoked counts at once. A
// file with a mistake in it does not: those that were read before it stay, so that a slip of
// whoever edits it takes Stop from nobody. Without a file nobody has one. One thread.
class TokenBook {
 public:
  using Told = std::function<void(const std::string&)>;

  // `told`: what is wrong with the file, once for each time that it is; null: nobody listens.
  TokenBook(TokenFile file, Told told) : file_(std::move(file)), told_(std::move(told)) {}

  [[nodiscard]] std::optional<Caller> caller(std::string_view token);
  // What is wrong with the file now.
  [[nodiscard]] std::optional<std::string> fault();

 private:
  void look();
  void note(std::optional<std::string> fault);
  TokenFile file_;
  Told told_;
  std::optional<std::string> stamp_;  // of the file as it was looked at
  std::vector<KeptToken> tokens_;
  std::optional<std::string> fault_;
};

}  // namespace armloom
