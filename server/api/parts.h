#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/executive/real_time_loop.h"
#include "core/model/cell.h"
#include "server/api/answers.h"
#include "server/api/guard.h"
#include "server/codec/wall_clock.h"
#include "server/comparison/jobs_at_hand.h"
#include "server/durable/accepted_requests.h"
#include "server/durable/alert_book.h"
#include "server/durable/job_keeper.h"
#include "server/http/client_limits.h"
#include "server/hub/hub.h"
#include "server/hub/recent_states.h"
#include "server/metrics/metrics.h"
#include "server/recording/recording.h"

namespace armloom {

class Comparison;
class Control;
class Listings;

// What the verbs of one run of the server work with; everything in it outlives them. The verbs run
// on the server's thread. A command to the executive is posted to its strand and answered when it
// has come back, so that nothing there waits. What clients read comes from the loop's board.
struct ApiParts {
  CellPtr cell;
  std::string stream;
  WallClock& clock;  // the server's thread's
  RealTimeLoop& loop;
  Hub& hub;
  const RecentStates& states;
  Recording* recording;  // null: none
  JobKeeper* keeper;     // null: jobs end with the server
  AlertBook& alerts;
  std::function<void(std::function<void()>)> post;         // to the server's thread, in order
  std::function<void(std::function<void()>)> post_urgent;  // before all of these
  Guard& guard;
  // To a thread for what takes long and needs nothing of this.
  std::function<void(std::function<void()>)> aside;
  Listings& listings;
  Metrics& metrics;
  ClientLimits& limits;
  Comparison& comparison;
  Control& control;
  std::optional<std::filesystem::path> data;  // where recordings lie; absent: nowhere
  std::chrono::milliseconds jog_lease;       // a move by hand goes on for so long without word
  // Readers of events that wait for a snapshot: all that wait when it is begun share it.
  struct Newcomer {
    bool gap;
    std::function<void(SubscriptionPtr)> then;
  };
  std::shared_ptr<AcceptedRequests> accepted = std::make_shared<AcceptedRequests>();
  std::shared_ptr<JobsAtHand> at_hand = std::make_shared<JobsAtHand>();
  struct Newcomers {
    std::vector<Newcomer> waiting = {};
    bool is_one_written = false;  // a snapshot for those that came before
  };
  std::shared_ptr<Newcomers> newcomers = std::make_shared<Newcomers>();
};

// Runs ask(executive) on the strand, then then(its answer) on the server's thread.
template <class Ask, class Then>
void ask(const ApiParts& parts, Ask ask, Then then) {
  parts.loop.post([&parts, ask = std::move(ask), then = std::move(then)](Executive& executive) {
    using Answer = decltype(ask(executive));
    parts.post([answer = std::make_shared<Answer>(ask(executive)), then] { then(*answer); });
  });
}

// The same before all that waits for the strand, and for the server's thread.
template <class Ask, class Then>
void ask_urgently(const ApiParts& parts, Ask ask, Then then) {
  parts.loop.post_urgent([&parts, ask = std::move(ask),
                          then = std::move(then)](Executive& executive) {
    using Answer = decltype(ask(executive));
    parts.post_urgent([answer = std::make_shared<Answer>(ask(executive)), then] { then(*answer); });
  });
}

// Why nothing can be stored at present, where there is a store.
[[nodiscard]] std::optional<Refusal> refusal_of_store(const ApiParts& parts);

// So many more jobs that whoever asks submits; answered, where they are too many.
[[nodiscard]] bool is_limited(const ApiParts& parts, const std::string& client, std::size_t jobs,
                              const Respond& respond);

// Problem (unsupported): the body is not said to be JSON in UTF-8, or is encoded.
[[nodiscard]] Result<void> check_content_type(const Request& request);

// Larger bodies are read aside: others are served meanwhile.
inline constexpr std::size_t kReadAtOnceMax = 64 * 1024;

// The body as read(text) -> Result<...> makes it out, to then(value) on the server's thread;
// problems are answered.
template <class Read, class Then>
void read_body(const ApiParts& parts, const Request& request, const Respond& respond, Read read,
               Then then) {
  if (auto json = check_content_type(request); !json) {
    return respond(problem_response(json.error()));
  }
  const auto go_on = [respond, then = std::move(then)](auto& value) {
    if (!value) return respond(problem_response(value.error()));
    then(std::move(*value));
  };
  using Value = decltype(read(std::string_view{}));
  if (request.body->size() <= kReadAtOnceMax) {
    Value value = read(std::string_view(*request.body));
    return go_on(value);
  }
  parts.aside([&parts, body = request.body, read = std::move(read), go_on] {
    const auto value = std::make_shared<Value>(read(std::string_view(*body)));
    parts.post([value, go_on] { go_on(*value); });
  });
}

}  // namespace armloom
