#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "server/access/token_book.h"
#include "server/http/message.h"

namespace armloom {

// Header of every 401 answer (RFC 9110, 15.5.2).
inline const std::pair<std::string, std::string> kHowToShowAToken{"WWW-Authenticate",
                                                                  "Bearer realm=\"armloom\""};

// Decides who may do what. With a token file, each request needs a token and may do what the
// token's role allows. Without the file, every request is allowed. Used on the server's thread
// only.
class Guard {
 public:
  // `tokens`: the token file, or nullopt. `tls`: marks cookies Secure. `told`: see TokenBook.
  Guard(const std::optional<std::filesystem::path>& tokens, bool tls, TokenBook::Told told);

  [[nodiscard]] bool asks() const { return book_.has_value(); }
  [[nodiscard]] bool is_tls() const { return tls_; }
  // Returns the caller to whom the token belongs, or nullopt. Without a token file, returns an
  // unnamed admin for every token.
  [[nodiscard]] std::optional<Caller> caller(const std::optional<std::string>& token);
  // Returns the key for rate limits: the token's name, or the client's address.
  [[nodiscard]] std::string client(const Request& request);
  // Returns the fault of the token file, or nullopt.
  [[nodiscard]] std::optional<std::string> fault() { return book_ ? book_->fault() : std::nullopt; }
  // Returns why the request may not proceed, or nullopt if it may.
  [[nodiscard]] std::optional<Refusal> refusal(const Request& request, Role needed);

 private:
  std::optional<TokenBook> book_;
  bool tls_;
};

}  // namespace armloom
