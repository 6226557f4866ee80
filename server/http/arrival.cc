#include "server/http/arrival.h"

#include <boost/beast/http.hpp>
#include <utility>

#include "server/http/request_id.h"

namespace armloom {
namespace {

namespace http = boost::beast::http;

// Returns the request without its body, or the response to an invalid header.
tl::expected<Request, Response> head_of(const RequestParser& parser, const Site& site) {
  const RequestHeader& header = parser.get();
  const auto refused = [&](const Refusal& why) { return tl::unexpected(site.refuse(why)); };
  if (const auto refusal = header_refusal(header)) return refused(*refusal);
  auto request = request_of(header, site.hosts);
  if (!request) return refused(request.error());
  request->upgrade = is_handshake(header) && parser.is_done();
  if (request->upgrade) {
    if (const auto fault = handshake_fault(header)) return refused(*fault);
  }
  return std::move(*request);
}

// Returns true if the client waits for 100 Continue (RFC 9110, 10.1.1).
bool waits_to_be_asked(const RequestParser& parser) {
  return parser.get().version() >= 11 && parser.get().count(http::field::expect) > 0 &&
         !parser.is_done();
}

}  // namespace

Awaitable<tl::expected<Arrived, NotArrived>> read_request(Connection& connection, const Site& site,
                                                          const Terms& terms) {
  const auto none_for = [&site](const NoRequest& none) {
    return tl::unexpected<NotArrived>(none.refusal ? std::optional(site.refuse(*none.refusal))
                                                   : std::nullopt);
  };
  connection.request_id = fresh_request_id();
  RequestParser parser;
  if (const auto none = co_await read_header(connection, parser, terms.times)) {
    co_return none_for(*none);
  }
  const auto own_id = parser.get()[kRequestIdField.data()];
  if (is_request_id({own_id.data(), own_id.size()})) connection.request_id = std::string(own_id);
  auto request = head_of(parser, site);
  if (!request) co_return tl::unexpected<NotArrived>(std::move(request.error()));
  request->peer = connection.stream.peer();
  request->id = connection.request_id;
  if (const auto why = terms.refusal ? terms.refusal(*request) : std::nullopt) {
    co_return tl::unexpected<NotArrived>(site.refuse(*why));
  }
  // Copies the header before the body is read, because the parser adds trailers to it.
  RequestHeader header = parser.get().base();
  request->has_body = !parser.is_done();
  // A stop does not wait for its body.
  if (site.is_stop(*request) && request->has_body) {
    const Delivery delivery{header.version(), false, false};
    co_return Arrived{std::move(*request), std::move(header), delivery,
                      MemoryBudget::Charge(connection.memory)};
  }
  const bool waits = waits_to_be_asked(parser);
  if (waits) {
    if (auto refused = site.refuse_unread(*request)) {
      co_return tl::unexpected<NotArrived>(std::move(*refused));
    }
  }
  if (const auto none = co_await read_body(connection, parser, terms.times.read, waits)) {
    co_return none_for(*none);
  }
  auto message = parser.release();
  request->body = std::make_shared<const std::string>(std::move(message.body().text));
  const Delivery delivery{header.version(), message.keep_alive() && !request->upgrade,
                          header.method() == http::verb::head};
  co_return Arrived{std::move(*request), std::move(header), delivery,
                    std::move(message.body().charge)};
}

}  // namespace armloom
