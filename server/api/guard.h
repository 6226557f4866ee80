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

// Access control. With a token file, a request may do what its token's role allows. Without a token
// file, every request is allowed. Used on the server's thread.
class Guard {
 public:
  // `tls`: marks cookies Secure.
  Guard(const std::optional<std::filesystem::path>& tokens, bool tls, TokenBook::Told told);

  [[nodiscard]] bool asks() const { return book_.has_value(); }
  [[nodiscard]] bool is_tls() const { return tls_; }
  // Returns the token's caller, or nullopt. Without a token file, every caller is an unnamed admin.
  [[nodiscard]] std::optional<Caller> caller(const std::optional<std::string>& token);
  // Returns the name under which rate limits count the client: the token's name, or the client's
  // address if the request has no valid token.
  [[nodiscard]] std::string client(const Request& request);
  // Returns the fault of the token file, or nullopt.
  [[nodiscard]] std::optional<std::string> fault() { return book_ ? book_->fault() : std::nullopt; }
  // Returns why the request is forbidden, or nullopt.
  [[nodiscard]] std::optional<Refusal> refusal(const Request& request, Role needed);

 private:
  std::optional<TokenBook> book_;
  bool tls_;
};

}  // namespace armloom
