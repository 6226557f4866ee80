#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "server/access/token_book.h"
#include "server/http/message.h"

namespace armloom {

// Who may what: with a file of tokens whoever shows one of them may what its role says; without one
// everybody may everything. On the server's thread.
// With every 401 (RFC 9110, 15.5.2).
inline const std::pair<std::string, std::string> kHowToShowAToken{"WWW-Authenticate",
                                                                  "Bearer realm=\"armloom\""};

class Guard {
 public:
  // `tokens`: the file; nothing: there is none. `tls`: cookies go through TLS only. `told`: as
  // TokenBook has it.
  Guard(const std::optional<std::filesystem::path>& tokens, bool tls, TokenBook::Told told);

  [[nodiscard]] bool asks() const { return book_.has_value(); }
  [[nodiscard]] bool is_tls() const { return tls_; }
  // Whose token this is; nothing: nobody's. Where no tokens are asked for: everybody's.
  [[nodiscard]] std::optional<Caller> caller(const std::optional<std::string>& token);
  // By which limits know whoever asks: the token's name, or the address.
  [[nodiscard]] std::string client(const Request& request);
  // What is wrong with the file of tokens.
  [[nodiscard]] std::optional<std::string> fault() { return book_ ? book_->fault() : std::nullopt; }
  // Why this may not be done.
  [[nodiscard]] std::optional<Refusal> refusal(const Request& request, Role needed);

 private:
  std::optional<TokenBook> book_;
  bool tls_;
};

}  // namespace armloom
