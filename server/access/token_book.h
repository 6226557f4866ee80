#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/access/token_file.h"

namespace armloom {

// The client to whom a token was given.
struct Caller {
  std::string name;
  Role role = Role::viewer;
};

// The tokens of a server. Changes of the token file apply at once. An invalid file is ignored and
// the previous tokens stay valid, so that an editing mistake locks no operator out of Stop. If the
// file is missing, no token is valid. Use on one thread.
class TokenBook {
 public:
  using Told = std::function<void(const std::string&)>;

  // `told` is called with each new fault of the token file. `told` may be null.
  TokenBook(TokenFile file, Told told) : file_(std::move(file)), told_(std::move(told)) {}

  [[nodiscard]] std::optional<Caller> caller(std::string_view token);
  // Returns the present fault of the file, or nullopt.
  [[nodiscard]] std::optional<std::string> fault();

 private:
  void look();
  void note(std::optional<std::string> fault);
  TokenFile file_;
  Told told_;
  std::optional<std::string> stamp_;  // of the file when last read
  std::vector<KeptToken> tokens_;
  std::optional<std::string> fault_;
};

}  // namespace armloom
