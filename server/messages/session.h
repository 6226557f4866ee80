#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/problem.h"
#include "server/access/role.h"
#include "server/codec/format.h"

namespace armloom {

// Body of POST /session.
struct LogIn {
  std::string token;
};
[[nodiscard]] FormatPtr<LogIn> log_in_format();
[[nodiscard]] Result<LogIn> read_log_in_text(std::string_view text);

// Answer to GET and POST /session.
struct Session {
  bool auth_required = false;
  std::optional<std::string> name;  // nullopt without a token
  std::optional<Role> role;         // nullopt if the caller may only log in
};
[[nodiscard]] FormatPtr<Session> session_format();

}  // namespace armloom
