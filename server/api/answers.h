#pragma once

#include <string>

#include "core/base/problem.h"
#include "server/codec/read_text.h"
#include "server/http/message.h"

namespace armloom {

// Messages as answers.
[[nodiscard]] Response json_response(int status, std::string body);
[[nodiscard]] Response problem_response(const Problems& problems);
[[nodiscard]] Response refusal_response(const Refusal& refusal);
// Of what acts already, and is not stored because of `refusal`.
[[nodiscard]] Response done_but_not_stored(Refusal refusal);
// There is no `what` ("arm") of that name.
[[nodiscard]] Response no_such(const char* what, const std::string& name);

// `clock`: for messages that tell wall time.
template <class T>
[[nodiscard]] Response answer(int status, const FormatPtr<T>& format, const T& value,
                              const WallClock* clock = nullptr) {
  return json_response(status, text_of(*format, value, clock));
}

// With Location: `path` is without the prefix ("/jobs/pick-7").
[[nodiscard]] Response located(Response response, const std::string& path);

}  // namespace armloom
