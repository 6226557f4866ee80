#pragma once

#include <functional>

#include "server/http/message.h"

namespace armloom {

// The query parameter that all operations with a JSON answer accept.
inline constexpr const char* kPretty = "pretty";

// Returns a 400 if `pretty` has a value other than 1, 0 or none.
[[nodiscard]] std::optional<Problem> bad_pretty(const Target& target);

// Returns a function that brings JSON answers into the form that the request asks for, and then
// passes them to `respond`:
// - with `?pretty`: indented
// - if `Accept` prefers text/plain: as text, if the answer has one (Response::as_text)
// - if the client accepts gzip: compressed, above 1 kB
// Each form has an ETag of its own. Answers above 1 kB are changed by `aside`, which runs a task on
// a worker thread; `post` runs a task on the server's thread.
using RunTask = std::function<void(std::function<void()>)>;
[[nodiscard]] Respond in_asked_form(const Request& request, Respond respond, RunTask aside,
                                    RunTask post);

}  // namespace armloom
