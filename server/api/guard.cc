#include "server/api/guard.h"

#include <string>
#include <utility>

namespace armloom {

Guard::Guard(const std::optional<std::filesystem::path>& tokens, bool tls, TokenBook::Told told)
    : tls_(tls) {
  if (tokens) book_.emplace(TokenFile(*tokens), std::move(told));
}

std::optional<Caller> Guard::caller(const std::optional<std::string>& token) {
  if (!book_) return Caller{"", Role::admin};
  return token ? book_->caller(*token) : std::nullopt;
}

std::string Guard::client(const Request& request) {
  const auto who = book_ ? caller(request.token) : std::nullopt;
  return who ? "token " + who->name : "address " + request.peer;
}

std::optional<Refusal> Guard::refusal(const Request& request, Role needed) {
  const auto who = caller(request.token);
  if (!who) {
    return Refusal{
        401,
        "not-authenticated",
        request.token
            ? "the token is unknown or was revoked: get a new one from `armloom token add`"
            : "a token is required: send Authorization: Bearer <token>, or log in at /login; "
              "`armloom token add` makes one",
        "Authorization",
        std::nullopt,
        {kHowToShowAToken}};
  }
  if (who->role >= needed) return std::nullopt;
  return Refusal{403, "not-permitted",
                 std::string("this request requires the role ") + to_string(needed) +
                     "; the token \"" + who->name + "\" has the role " + to_string(who->role),
                 "Authorization", to_string(who->role)};
}

}  // namespace armloom
