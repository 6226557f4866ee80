#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "core/executive/real_time_loop.h"
#include "core/model/cell.h"
#include "server/api/answers.h"
#include "server/codec/wall_clock.h"
#include "server/hub/hub.h"
#include "server/recording/recording.h"

namespace armloom {

// What the verbs of one run of the server work with; everything in it outlives them. The verbs run
// on the server's thread; what concerns the executive is posted to its strand and answered when it
// has come back, so that nothing there waits.
struct ApiParts {
  CellPtr cell;
  std::string stream;
  std::string policy;  // in force
  WallClock& clock;    // the server's thread's
  RealTimeLoop& loop;
  Hub& hub;
  Recording* recording;                             // null: none
  std::function<void(std::function<void()>)> post;  // to the server's thread, in order
};

// Runs ask(executive) on the strand, then then(its answer) on the server's thread.
template <class Ask, class Then>
void ask(const ApiParts& parts, Ask ask, Then then) {
  parts.loop.post([&parts, ask = std::move(ask), then = std::move(then)](Executive& executive) {
    using Answer = decltype(ask(executive));
    parts.post([answer = std::make_shared<Answer>(ask(executive)), then] { then(*answer); });
  });
}

// Problem (unsupported): the body is not said to be JSON in UTF-8, or is encoded.
[[nodiscard]] Result<void> check_content_type(const Request& request);

// The body as read(text) -> Result<...> makes it out.
template <class Read>
auto read_body(const Request& request, Read read) -> decltype(read(std::string_view{})) {
  if (auto json = check_content_type(request); !json) return failure(std::move(json.error()));
  return read(std::string_view(request.body));
}

}  // namespace armloom
