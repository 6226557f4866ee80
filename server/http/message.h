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

// A percent-decoded request target: "/api/v1/jobs?state=running".
struct Target {
  std::string path;  // begins with '/', without NUL, encoded slash or backslash
  std::map<std::string, std::string> query;
  // The first fault of the query: a broken escape, or a parameter that occurs twice. `query` then
  // lacks the broken part, and has the first value of the parameter.
  std::optional<Problem> query_fault = {};

  [[nodiscard]] std::optional<std::string> parameter(const std::string& name) const {
    const auto it = query.find(name);
    return it == query.end() ? std::nullopt : std::optional(it->second);
  }
};
// Splits and decodes a request target. Problem (malformed): the target is not an absolute path, has
// a fragment, or a broken or forbidden escape in the path.
[[nodiscard]] Result<Target> parse_target(std::string_view text);

// Returns the query's fault, or a problem (malformed) that names a parameter not in `known`; else
// nullopt.
[[nodiscard]] std::optional<Problem> query_problem(const Target& target,
                                                   const std::vector<std::string>& known);

// Returns `text` as one path segment, with all but unreserved characters percent-encoded.
[[nodiscard]] std::string url_segment(std::string_view text);

// Why a request is refused. Plain data; the site formats the response.
struct Refusal {
  int status;
  std::string slug;    // stable name for programs
  std::string detail;  // one sentence
  std::optional<std::string> pointer = {};
  std::optional<std::string> value = {};  // what was found
  std::vector<std::pair<std::string, std::string>> headers = {};
};
[[nodiscard]] Refusal refusal_of(int status, const Problem& problem);

// A whole request with checked framing. Handlers do not see sockets.
struct Request {
  std::string method;  // "GET" for HEAD, too: its response is sent without the body
  Target target;
  std::optional<std::string> content_type = {};
  std::optional<std::string> content_encoding = {};
  std::optional<std::string> last_event_id = {};  // of a subscriber that reconnects
  std::optional<std::string> if_none_match = {};
  std::optional<std::string> if_match = {};
  std::optional<std::string> token = {};            // from the Bearer header or the log-in cookie
  std::string peer = {};                            // client address
  std::string id = {};                              // for X-Request-Id: the client's, or generated
  std::optional<std::string> idempotency_key = {};  // identifies a repeated request
  std::string accept = {};                          // all values, comma-separated
  std::string accept_encoding = {};                 // likewise
  std::string prefix = {};                          // path that a reverse proxy removes: "/cell7"
  std::optional<Refusal> stranger = {};             // refuses every request (Host not allowed)
  std::optional<std::string> cross_origin = {};     // allowed Origin of another site
  std::optional<Refusal> foreign = {};              // refuses commands (page of another site)
  bool upgrade = false;                             // wants a WebSocket
  bool has_body = false;                            // as the header announces
  // True once no client waits for the response: it disconnected, or the response took too long.
  std::shared_ptr<std::atomic<bool>> gone = std::make_shared<std::atomic<bool>>(false);
  std::shared_ptr<const std::string> body = std::make_shared<const std::string>();
};

// Why a subscriber is disconnected.
struct CloseReason {
  enum class Why { too_slow, server_ends, not_permitted };
  Why why;
  std::string text;
};

// One subscriber of events, connected by WebSocket or Server-Sent Events. Call on the server's
// thread.
class Subscription {
 public:
  struct Message {
    std::shared_ptr<const std::string> text;
    std::optional<std::uint64_t> seq;  // nullopt for a pose frame, which may be skipped
  };
  virtual ~Subscription() = default;
  // Returns the next message to send, or nullopt if there is none yet.
  virtual std::optional<Message> next() = 0;
  // Returns why the subscriber must be disconnected, or nullopt while it may stay.
  [[nodiscard]] virtual std::optional<CloseReason> close_reason() const = 0;
  // Sets the function that is called when the results of next() or close_reason() may have changed.
  virtual void on_news(std::function<void()> call) = 0;
};
using SubscriptionPtr = std::shared_ptr<Subscription>;

// A subscription as a response: over a WebSocket (status 101) or Server-Sent Events.
struct EventStream {
  SubscriptionPtr subscription;
  std::string id;                        // prefix of event ids: "<id>:<seq>"
  bool frames = true;                    // also send messages without seq
  std::function<bool()> permitted = {};  // returns false if the token was revoked; may be null
};

// A response body that is too large for memory. It is read in pieces while it is sent.
struct PiecedBody {
  std::uintmax_t size = 0;  // in bytes
  // Passes `count` bytes starting at `from` to `then`, once, on the server's thread. Passes nullopt
  // if the bytes cannot be read; the connection is then cut.
  using Then = std::function<void(std::optional<std::string>)>;
  std::function<void(std::uintmax_t from, std::size_t count, Then then)> read = {};
};

struct Response {
  int status = 200;
  std::string content_type = "application/json";
  std::string body = {};
  std::vector<std::pair<std::string, std::string>> headers = {};
  std::optional<EventStream> events = {};
  // instead of `body`, if many responses share the bytes
  std::shared_ptr<const std::string> shared = {};
  std::optional<PiecedBody> pieces = {};  // instead of `body`
  bool is_routine = false;                // a frequent command that leaves no audit entry
  // Returns the JSON body as text for people, for clients that prefer text/plain; may be null. May
  // run on another thread.
  std::function<std::string(std::string_view json)> as_text = {};
};

// Sends the response. Call exactly once, on the server's thread.
using Respond = std::function<void(Response)>;
using WriteRefusal = std::function<Response(const Refusal&)>;

// Adds names of request headers to Vary.
void vary_by(Response& response, std::string_view names);

// Puts the path that a reverse proxy removes from requests (X-Forwarded-Prefix) before the path in
// Location.
void answer_below_prefix(const Request& request, Response& response);

// Adds CORS headers if the requesting page's origin is allowed.
void answer_across_origins(const Request& request, Response& response);

// Turns the response into a 304 if If-None-Match lists its ETag (RFC 9110, 13.1.2).
void answer_conditionally(const Request& request, Response& response);

// Host allow-list against DNS rebinding. If an attacker lets the DNS name of a page resolve to this
// server, the browser treats page and server as one site. Only the Host header shows the attacker's
// name. IP addresses and localhost are always allowed.
struct HostRule {
  std::vector<std::string> names;    // further allowed names
  std::vector<std::string> origins;  // of other sites whose pages may command: "https://a.example"
  bool any_plain = false;            // also allow names without a dot, which no internet site has
  bool is_sealed = false;            // TLS is used, so own pages are https
};

// The cookie that stores a browser's token.
inline constexpr std::string_view kTokenCookie = "armloom_token";

// The application behind the listener. All functions are called on the server's thread. `handle`
// may answer later, but its request is only valid during the call.
struct Site {
  std::function<void(const Request&, Respond)> handle;
  // Returns a refusal that does not depend on the body, or nullopt if `handle` must answer.
  std::function<std::optional<Response>(const Request&)> refuse_unread;
  WriteRefusal refuse;  // formats errors of HTTP itself: framing, limits, targets
  // Returns true if the request stops arms. It is exempt from connection limits, and its body is
  // not read.
  std::function<bool(const Request&)> is_stop;
  // Graceful shutdown: brings all arms to rest, then calls `done` (from any thread).
  std::function<void(std::function<void()> done)> wind_down;
  std::function<void()> end;  // shutdown: gives every subscription its close reason
  HostRule hosts;             // allowed hosts
  std::chrono::milliseconds keep_alive{15'000};  // silence before a keep-alive comment line
  // for one message of a stream; then the stream is cut
  std::chrono::milliseconds send_time{30'000};
  // bytes, of a stream; small, so that a slow reader receives recent poses
  int send_buffer = 128 * 1024;
  std::chrono::milliseconds read_time{10'000};      // for a whole header, and for a whole body
  std::size_t memory_max = std::size_t{64} << 20U;  // bytes of large bodies and responses together
  // from one address; further connections are answered with 429
  std::size_t connections_per_client_max = ~std::size_t{0};
  std::function<void()> on_limited_connection = {};  // called for each connection beyond this limit
};

}  // namespace armloom
