#pragma once

#include <functional>
#include <optional>
#include <string>

#include "core/base/problem.h"
#include "server/codec/read_text.h"
#include "server/http/message.h"

namespace armloom {

[[nodiscard]] Response json_response(int status, std::string body);
[[nodiscard]] Response problem_response(const Problems& problems);
[[nodiscard]] Response refusal_response(const Refusal& refusal);
// Answers a command that took effect but could not be stored, for the reason in `refusal`.
[[nodiscard]] Response done_but_not_stored(Refusal refusal);
// Returns a function that responds with `response` when a change is stored, or that the change is
// done, but not stored.
[[nodiscard]] std::function<void(std::optional<Refusal>)> when_stored(Respond respond,
                                                                      Response response);
// Answers 404, because no `what` ("arm") has this name.
[[nodiscard]] Response no_such(const char* what, const std::string& name);

// Answers with `value` as JSON. `clock` is required by formats that write wall time.
template <class T>
[[nodiscard]] Response answer(int status, const FormatPtr<T>& format, const T& value,
                              const WallClock* clock = nullptr) {
  return json_response(status, text_of(*format, value, clock));
}

// Adds a Location header. `path` is without the prefix: "/jobs/pick-7".
[[nodiscard]] Response located(Response response, const std::string& path);

}  // namespace armloom
