#include "server/http/session.h"

#include <chrono>
#include <new>
#include <optional>

#include "server/http/arrival.h"
#include "server/http/event_stream.h"
#include "server/http/pieced_body.h"
#include "server/http/websocket_session.h"

namespace armloom {
namespace {

// Sets `gone` if the client disconnects before the response. Any other input belongs to the
// client's next request.
void watch_peer(Socket& socket, std::shared_ptr<std::atomic<bool>> gone) {
  socket.async_wait(Socket::wait_read, [&socket, gone = std::move(gone)](ErrorCode over) {
    if (over) return;
    char next = 0;
    ErrorCode end;
    socket.receive(asio::buffer(&next, 1), Socket::message_peek, end);
    if (end) *gone = true;
  });
}

Awaitable<Response> answer(const Site& site, const Request& request, Socket& socket) {
  struct Pending {
    explicit Pending(const Executor& executor)
        : arrived(executor, std::chrono::steady_clock::now() + kWriteTime) {}
    Timer arrived;
    std::optional<Response> response;
  };
  const auto pending = std::make_shared<Pending>(co_await asio::this_coro::executor);
  site.handle(request, [pending](Response response) {
    pending->response = std::move(response);
    pending->arrived.cancel();
  });
  ErrorCode ignored;
  if (!pending->response) {
    watch_peer(socket, request.gone);
    co_await pending->arrived.async_wait(into(ignored));
    socket.cancel(ignored);
  }
  if (pending->response) co_return std::move(*pending->response);
  *request.gone = true;
  co_return site.refuse({503, "no-answer", "the server did not answer in time"});
}

// Charges the response to the memory budget unless its bytes are shared. Returns a refusal instead
// if the budget is exhausted.
Response within_memory(Response response, MemoryBudget::Charge& charge, const Site& site) {
  const std::size_t held = response.pieces ? kPieceSize : response.body.size();
  if (response.shared || charge.grow_to(held)) return response;
  return site.refuse({503,
                      "server-busy",
                      "too many large responses are being sent at once",
                      std::nullopt,
                      std::nullopt,
                      {{"Retry-After", "1"}}});
}

Awaitable<bool> deliver(Connection& connection, Response response, Delivery delivery,
                        const Site& site) {
  ErrorCode ec;
  MemoryBudget::Charge charge(connection.memory);
  co_await send(connection, within_memory(std::move(response), charge, site), delivery, ec);
  if (!ec && !delivery.keep_alive) co_await linger(connection);
  co_return !ec && delivery.keep_alive;
}

// Serves one request. Returns true if another may follow on the connection.
Awaitable<bool> serve_request(Connection& connection, const Site& site) {
  const Terms terms{{kIdleTime, site.read_time}};
  auto arrived = co_await read_request(connection, site, terms);
  if (!arrived) {
    if (arrived.error()) co_await refuse(connection, std::move(*arrived.error()));
    co_return false;
  }
  const Request& request = arrived->request;
  Response response = co_await answer(site, request, connection.stream.socket());
  if (response.events && response.status == 101) {
    co_await serve_websocket(std::move(connection.stream), std::move(arrived->header), request.id,
                             std::move(*response.events), site);
    co_return false;
  }
  if (response.events) {
    co_await serve_event_stream(std::move(connection.stream), arrived->request,
                                std::move(*response.events), site, arrived->delivery.without_body);
    co_return false;
  }
  answer_conditionally(request, response);
  answer_below_prefix(request, response);
  answer_across_origins(request, response);
  co_return co_await deliver(connection, std::move(response), arrived->delivery, site);
}

}  // namespace

Awaitable<void> serve_connection(Transport transport, const Site& site, MemoryBudget& memory) {
  ErrorCode ignored;
  transport.socket().set_option(asio::ip::tcp::no_delay(true), ignored);
  Connection connection(std::move(transport), memory);
  try {
    if (!co_await connection.stream.shake_hands(site.read_time)) co_return;
    while (co_await serve_request(connection, site)) {
    }
  } catch (const std::bad_alloc&) {
    // Out of memory: closes this connection only.
  }
}

Awaitable<void> serve_in_reserve(Transport transport, Reserve::Place& place, Refusal why,
                                 const Site& site, MemoryBudget& memory) {
  Connection connection(std::move(transport), memory);
  if (!co_await connection.stream.shake_hands(kReserveTime)) co_return;
  const Terms terms{{kReserveTime, kReserveTime}, [&](const Request& request) {
                      return site.is_stop(request) ? std::nullopt : std::optional(why);
                    }};
  auto arrived = co_await read_request(connection, site, terms);
  if (!arrived) {
    std::optional<Response> said = std::move(arrived.error());
    if (!said) said = site.refuse(why);
    co_return co_await refuse(connection, std::move(*said));
  }
  if (!place.keep(true)) co_return;
  Response response = co_await answer(site, arrived->request, connection.stream.socket());
  answer_across_origins(arrived->request, response);
  arrived->delivery.keep_alive = false;
  place.keep(false);  // may be evicted now: the response is short and written at once
  co_await deliver(connection, std::move(response), arrived->delivery, site);
}

}  // namespace armloom
