#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/problem.h"
#include "server/access/role.h"
#include "server/codec/format.h"

namespace armloom {

// The body of POST /session.
struct LogIn {
  std::string token;
};
[[nodiscard]] FormatPtr<LogIn> log_in_format();
[[nodiscard]] Result<LogIn> read_log_in_text(std::string_view text);

// Who asks.
struct Session {
  bool auth_required = false;       // of this server
  std::optional<std::string> name;  // of the token; nothing: none was shown, or none is asked for
  std::optional<Role> role;         // nothing: may nothing
};
[[nodiscard]] FormatPtr<Session> session_format();

}  // namespace armloom
