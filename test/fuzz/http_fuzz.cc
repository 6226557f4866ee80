#include <boost/beast/_experimental/test/stream.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <string>

#include "server/http/entity_tag.h"
#include "server/http/framing.h"
#include "server/http/request_body.h"
#include "server/http/request_head.h"
#include "server/http/request_id.h"
#include "test/fuzz/fuzz.h"

// Fuzzes the bytes of a connection: pipelined requests, as server/http reads them, or WebSocket
// frames if the first byte is odd.

namespace armloom::fuzz {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;

const HostRule kHosts{{"cell7.example"}, {"https://station.example"}, false};

void demand_said(const Refusal& refusal) {
  demand(refusal.status >= 400 && refusal.status < 600);
  demand(!refusal.slug.empty() && !refusal.detail.empty());
}

// Checks properties of an accepted request on which the routes rely.
void demand_fit(const Request& request) {
  const std::string& path = request.target.path;
  demand(path == "*" || path.starts_with('/'));
  demand(path.find('\0') == path.npos && path.find('\\') == path.npos);
  demand(parse_target("/" + url_segment(path.substr(1))).has_value() ==
         (path.find('/', 1) == path.npos));
  if (request.foreign) demand_said(*request.foreign);
  if (request.stranger) demand(request.foreign.has_value());
  for (const auto& tags : {request.if_match, request.if_none_match}) {
    if (tags) (void)any_tag(*tags, [](std::string_view tag) { return tag.empty(); });
    if (tags) (void)is_tag_list(*tags);
  }
  (void)query_problem(request.target, {"limit"});
  Response response{200, "text/plain", "x", {{"ETag", "\"x\""}, {"Vary", "Accept"}}};
  answer_conditionally(request, response);
  answer_across_origins(request, response);
}

// Parses one request at the front of `bytes`. Returns its size, or 0 if it is incomplete or
// refused.
std::size_t read_one(std::string& bytes) {
  while (bytes.starts_with("\r\n")) bytes.erase(0, 2);
  const std::size_t line = bytes.find("\r\n");
  if (line == bytes.npos) return 0;
  if (const auto refusal = settle_version(bytes.data(), line)) {
    demand_said(*refusal);
    return 0;
  }
  MemoryBudget budget(1 << 20);
  RequestParser parser;
  parser.body_limit(8 << 20);
  parser.header_limit(16 * 1024);
  parser.eager(true);
  parser.get().body().charge = MemoryBudget::Charge(budget);
  ErrorCode ec;
  std::size_t taken = 0;
  while (!ec && !parser.is_done() && taken < bytes.size()) {
    const std::size_t more = parser.put(boost::asio::buffer(bytes) + taken, ec);
    taken += more;
    if (more == 0) break;
  }
  if (!parser.is_header_done()) return 0;
  const RequestHeader& header = parser.get().base();
  const auto refusal = header_refusal(header);
  if (refusal) demand_said(*refusal);
  if (is_handshake(header)) {
    if (const auto fault = handshake_fault(header)) demand_said(*fault);
  }
  const auto id = header[kRequestIdField.data()];
  (void)is_request_id({id.data(), id.size()});
  const auto request = request_of(header, kHosts);
  if (!request) {
    demand_said(request.error());
  } else if (!refusal) {
    demand_fit(*request);
  }
  demand(parser.get().body().text.size() <= bytes.size());
  return ec || refusal || !parser.is_done() ? 0 : taken;
}

void read_requests(std::string bytes) {
  for (int requests = 0; requests < 16; ++requests) {
    const std::size_t taken = read_one(bytes);
    if (taken == 0) return;
    bytes.erase(0, taken);
  }
}

void read_frames(const std::string& frames) {
  static const std::string kHandshake =
      "GET /api/v1/ws HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
      "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
  boost::asio::io_context context;
  beast::test::stream peer(context);
  websocket::stream<beast::test::stream> socket(context);
  socket.next_layer().connect(peer);
  socket.next_layer().append(kHandshake);
  ErrorCode ec;
  socket.accept(ec);
  demand(!ec);
  socket.read_message_max(4096);
  socket.next_layer().append(frames);
  peer.close();  // the data is still read before the end
  beast::flat_buffer buffer;
  while (!ec) {
    socket.read(buffer, ec);
    demand(buffer.size() <= 4096);
    buffer.clear();
  }
}

}  // namespace
}  // namespace armloom::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace armloom::fuzz;
  if (size == 0) return 0;
  const std::string rest = text_of(data + 1, size - 1);
  if (data[0] % 2 == 0) {
    read_requests(rest);
  } else {
    read_frames(rest);
  }
  return 0;
}
