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
#include "server/api/fault_targets.h"
#include "server/api/guard.h"
#include "server/codec/wall_clock.h"
#include "server/codec/yaml_text.h"
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

// The parts of the server that routes use; they outlive the routes. Routes run on the server's
// thread. Commands are sent to the executive's strand, and their results come back asynchronously.
// Reads use the state that the loop publishes on its board.
struct ApiParts {
  CellPtr cell;
  std::string stream;
  WallClock& clock;  // used on the server's thread
  RealTimeLoop& loop;
  Hub& hub;
  RecentStates& states;
  Recording* recording;  // null if nothing is recorded
  JobKeeper* keeper;     // null if jobs are not stored
  AlertBook& alerts;
  std::function<void(std::function<void()>)> post;  // runs a task on the server's thread, in order
  std::function<void(std::function<void()>)> post_urgent;  // ahead of tasks from `post`
  Guard& guard;
  // Runs a long task on a worker thread. The task may use only thread-safe parts.
  std::function<void(std::function<void()>)> aside;
  Listings& listings;
  Metrics& metrics;
  ClientLimits& limits;
  Comparison& comparison;
  Control& control;
  const FaultTargets& faults;
  std::optional<std::filesystem::path> data;  // folder of recordings, if any
  std::chrono::milliseconds jog_lease;        // jogs are canceled after this time without renewal
  // A subscriber that waits for a snapshot. All newcomers share the next snapshot.
  struct Newcomer {
    bool gap;
    std::function<void(SubscriptionPtr)> then;
  };
  std::shared_ptr<AcceptedRequests> accepted = std::make_shared<AcceptedRequests>();
  std::shared_ptr<JobsAtHand> at_hand = std::make_shared<JobsAtHand>();
  struct Newcomers {
    std::vector<Newcomer> waiting = {};
    bool is_one_written = false;
  };
  std::shared_ptr<Newcomers> newcomers = std::make_shared<Newcomers>();
};

// Runs ask(executive) on the executive's strand, then then(result) on the server's thread.
template <class Ask, class Then>
void ask(const ApiParts& parts, Ask ask, Then then) {
  parts.loop.post([&parts, ask = std::move(ask), then = std::move(then)](Executive& executive) {
    using Answer = decltype(ask(executive));
    parts.post([answer = std::make_shared<Answer>(ask(executive)), then] { then(*answer); });
  });
}

// Does the same as ask(), but ahead of all other tasks on the strand and on the server's thread.
template <class Ask, class Then>
void ask_urgently(const ApiParts& parts, Ask ask, Then then) {
  parts.loop.post_urgent([&parts, ask = std::move(ask),
                          then = std::move(then)](Executive& executive) {
    using Answer = decltype(ask(executive));
    parts.post_urgent([answer = std::make_shared<Answer>(ask(executive)), then] { then(*answer); });
  });
}

// Returns why the store refuses writes, or nullopt.
[[nodiscard]] std::optional<Refusal> refusal_of_store(const ApiParts& parts);

// Answer 404 for a job or an arm with this name, with the nearest name that exists.
[[nodiscard]] Response no_such_job(const ApiParts& parts, const std::string& key);
[[nodiscard]] Response no_such_arm(const ApiParts& parts, const std::string& name);

// Counts `jobs` against the client's limit of jobs per second. Beyond the limit, answers 429 and
// returns true.
[[nodiscard]] bool is_limited(const ApiParts& parts, const std::string& client, std::size_t jobs,
                              const Respond& respond);

// Returns the form of the body from Content-Type and Content-Encoding. Problem (unsupported): the
// body is neither JSON nor YAML in UTF-8, or is encoded (compressed).
enum class BodyForm { json, yaml };
[[nodiscard]] Result<BodyForm> body_form(const Request& request);

// Adds the header for YAML to a problem of a body that does not look like JSON.
void hint_at_yaml(Problems& problems);

// Maximum number of bytes of a body that is read at once. Larger bodies are read on a worker
// thread.
inline constexpr std::size_t kReadAtOnceMax = 64 * 1024;

// Reads the body with read(text), which returns a Result. Then calls then(value) on the server's
// thread, or answers with the problems.
template <class Read, class Then>
void read_body(const ApiParts& parts, const Request& request, const Respond& respond, Read read,
               Then then) {
  const auto form = body_form(request);
  if (!form) return respond(problem_response(form.error()));
  const auto go_on = [respond, then = std::move(then)](auto& value) {
    if (!value) return respond(problem_response(value.error()));
    then(std::move(*value));
  };
  using Value = decltype(read(std::string_view{}));
  const auto read_form = [form = *form, read = std::move(read)](const std::string& body) -> Value {
    if (form == BodyForm::json) {
      auto value = read(std::string_view(body));
      if (!value) hint_at_yaml(value.error());
      return value;
    }
    const auto json = json_of_yaml(body);
    if (!json) return failure(json.error());
    return read(std::string_view(*json));
  };
  if (request.body->size() <= kReadAtOnceMax) {
    Value value = read_form(*request.body);
    return go_on(value);
  }
  parts.aside([&parts, body = request.body, read_form, go_on] {
    const auto value = std::make_shared<Value>(read_form(*body));
    parts.post([value, go_on] { go_on(*value); });
  });
}

}  // namespace armloom
