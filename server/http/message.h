#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/problem.h"

namespace armloom {

// The target of a request, percent-decoded: "/api/v1/jobs?state=running".
struct Target {
  std::string path;  // begins with '/', holds no NUL and no encoded slash or backslash
  std::map<std::string, std::string> query;

  [[nodiscard]] std::optional<std::string> parameter(const std::string& name) const {
    const auto it = query.find(name);
    return it == query.end() ? std::nullopt : std::optional(it->second);
  }
};
// Problem (malformed): no absolute path, a fragment, a broken or forbidden escape, a parameter that
// occurs twice.
[[nodiscard]] Result<Target> parse_target(std::string_view text);

// The first parameter of the query that is not `known`, as a problem (malformed) that names it.
[[nodiscard]] std::optional<Problem> unknown_parameter(const Target& target,
                                                       const std::vector<std::string>& known);

// `text` as one segment of a path: everything but unreserved characters percent-encoded.
[[nodiscard]] std::string url_segment(std::string_view text);

// Why a request is refused. Plain data: how it is told is the site's.
struct Refusal {
  int status;
  std::string slug;    // stable name for programs
  std::string detail;  // one sentence
  std::optional<std::string> pointer = {};
  std::optional<std::string> value = {};  // what was found
  std::vector<std::pair<std::string, std::string>> headers = {};
};
[[nodiscard]] Refusal refusal_of(int status, const Problem& problem);

// A whole request, framing checked. Plain data: handlers know nothing of sockets.
struct Request {
  std::string method;  // "GET"; a HEAD comes as GET, its answer loses the body later
  Target target;
  std::optional<std::string> content_type = {};
  std::optional<std::string> content_encoding = {};
  std::optional<std::string> last_event_id = {};  // of a reader of events who comes back
  std::optional<std::string> if_none_match = {};
  std::optional<std::string> if_match = {};
  std::optional<std::string> token = {};  // shown as Bearer, or in the cookie that a log-in sets
  std::string peer = {};                  // the address that it came from
  std::string id = {};                    // told in X-Request-Id: the client's, or one of ours
  std::optional<std::string> idempotency_key = {};  // names the request, should it come again
  std::string accept_encoding = {};                 // all of it, commas between
  std::optional<Refusal> stranger = {};          // why whoever asks may not even read; absent: may
  std::optional<std::string> cross_origin = {};  // the page of another site that asks and may
  std::optional<Refusal> foreign = {};           // why whoever asks may not command; absent: may
  bool upgrade = false;                          // wants a WebSocket
  // Set when nobody waits for the answer any more: the connection has gone, or it took too long.
  std::shared_ptr<std::atomic<bool>> gone = std::make_shared<std::atomic<bool>>(false);
  std::shared_ptr<const std::string> body = std::make_shared<const std::string>();
};

// Why a reader of the event stream is sent away.
struct CloseReason {
  enum class Why { too_slow, server_ends, not_permitted };
  Why why;
  std::string text;
};

// One reader of the event stream, as a WebSocket or SSE sees it. All calls on the server's thread.
class Subscription {
 public:
  struct Message {
    std::shared_ptr<const std::string> text;
    std::optional<std::uint64_t> seq;  // none: a pose frame, which may be passed over
  };
  virtual ~Subscription() = default;
  // The next message to send; absent: nothing at present.
  virtual std::optional<Message> next() = 0;
  // Absent while the reader may stay.
  [[nodiscard]] virtual std::optional<CloseReason> close_reason() const = 0;
  // `call` is called whenever next() or close_reason() may have something new.
  virtual void on_news(std::function<void()> call) = 0;
};
using SubscriptionPtr = std::shared_ptr<Subscription>;

// A subscription as the answer to a request: on a WebSocket (status 101), or as Server-Sent Events.
struct EventStream {
  SubscriptionPtr subscription;
  std::string id;                        // stands before the number of each event: "<id>:<seq>"
  bool frames = true;                    // messages without a number, too
  std::function<bool()> permitted = {};  // whether its reader still may; null: always
};

// A body that is too large to be held: it is read a piece at a time, as its reader takes it.
struct PiecedBody {
  std::uintmax_t size = 0;  // in bytes; known before
  // Hands so many bytes from `from` on to `then`, once, on the server's thread; absent: they cannot
  // be read any more, and the connection is cut.
  using Then = std::function<void(std::optional<std::string>)>;
  std::function<void(std::uintmax_t from, std::size_t count, Then then)> read = {};
};

struct Response {
  int status = 200;
  std::string content_type = "application/json";
  std::string body = {};
  std::vector<std::pair<std::string, std::string>> headers = {};
  std::optional<EventStream> events = {};
  std::shared_ptr<const std::string> shared = {};  // instead of `body`: many read the same bytes
  std::optional<PiecedBody> pieces = {};           // instead of `body`
  bool is_routine = false;  // a command of which no trace is kept, as it comes ten times a second
};

// To be called exactly once, on the server's thread.
using Respond = std::function<void(Response)>;
using WriteRefusal = std::function<Response(const Refusal&)>;

// Lets the page that asked read the answer (CORS), where it may.
void answer_across_origins(const Request& request, Response& response);

// Makes a 304 of an answer whose ETag the request names in If-None-Match (RFC 9110, 13.1.2).
void answer_conditionally(const Request& request, Response& response);

// By which names the server may be asked: a page whose name an attacker lets point here is of
// the same origin to a browser, and only its Host tells. IP addresses and localhost always may.
struct HostRule {
  std::vector<std::string> names;    // further ones
  std::vector<std::string> origins;  // of other sites whose pages may command: "https://a.example"
  bool any_plain = false;  // and every name without a dot: no site on the internet has one
  bool is_sealed = false;  // by TLS: its own pages are https
};

// The cookie in which a browser keeps its token.
inline constexpr std::string_view kTokenCookie = "armloom_token";

// What the listener serves. All functions are called on the server's thread; `handle` answers
// through its callback, at once or later. The request is only valid during the call.
struct Site {
  std::function<void(const Request&, Respond)> handle;
  // The answer to a request that is refused whatever its body says; absent: `handle` answers it.
  std::function<std::optional<Response>(const Request&)> refuse_unread;
  WriteRefusal refuse;  // what is wrong with HTTP itself: framing, limits, targets
  // Whether this request is served however many connections are open, and before its body is here.
  std::function<bool(const Request&)> is_never_limited;
  // The server is asked to end: bring everything to rest, then call `done` (from any thread).
  std::function<void(std::function<void()> done)> wind_down;
  std::function<void()> end;  // the server ends: every subscription says why it closes
  HostRule hosts;             // by which names requests may come
  std::chrono::milliseconds keep_alive{15'000};     // no event for so long: a comment line is sent
  std::chrono::milliseconds send_time{30'000};      // that one message may take; then it is cut
  int send_buffer = 128 * 1024;                     // of a stream: bounds how old a pose can arrive
  std::chrono::milliseconds read_time{10'000};      // for a whole header, and for a whole body
  std::size_t memory_max = std::size_t{64} << 20U;  // of large bodies and answers, all together
  std::size_t connections_per_client_max = ~std::size_t{0};  // of one address; more: 429
  std::function<void()> on_limited_connection = {};          // is told of each
};

}  // namespace armloom
