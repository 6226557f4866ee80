#include "server/messages/session.h"

#include "server/codec/object_format.h"
#include "server/codec/output_part.h"
#include "server/codec/read_text.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"

namespace armloom {

using namespace formats;

FormatPtr<LogIn> log_in_format() {
  static const auto format = named(
      "LogIn", "",
      object<LogIn>(
          {required("token", &LogIn::token, text(), "Token printed by `armloom token add`")}));
  return format;
}

Result<LogIn> read_log_in_text(std::string_view text) { return read_text(*log_in_format(), text); }

FormatPtr<Session> session_format() {
  static const auto format = named(
      "Session", "The caller and its role.",
      object<Session>({
          output_only("auth_required", &Session::auth_required, flag(),
                      "true if the server requires a token; false if every request is allowed"),
          output_only("name", &Session::name, nullable(text()),
                      "Name of the token; null if there is none"),
          output_only("role", &Session::role, nullable(choice<Role>()),
                      "Role of the caller; null if it may only log in"),
      }));
  return format;
}

}  // namespace armloom
