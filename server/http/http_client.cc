#include "server/http/http_client.h"

#include <openssl/ssl.h>

#include <algorithm>
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/host_name_verification.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>
#include <cctype>
#include <optional>

#include "server/http/asio.h"

namespace armloom {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
namespace ssl = asio::ssl;

using Tcp = asio::ip::tcp::socket;
using Parser = http::response_parser<http::string_body>;

constexpr std::size_t kAnswerMax = std::size_t{256} << 20U;

Problem unreachable(const ServerUrl& server, const ErrorCode& why) {
  return Problem{ProblemKind::unavailable, "server-unreachable", "",
                 "no server answers at " + std::string(server.is_tls ? "https://" : "http://") +
                     server.authority() + " (" + why.message() + ")",
                 server.authority()};
}

// A connection, plain or through TLS. Throws boost::system::system_error.
class ClientStream {
 public:
  explicit ClientStream(const ServerUrl& server) : tcp_(io_) {
    asio::ip::tcp::resolver resolver(io_);
    asio::connect(tcp_, resolver.resolve(server.host, server.port));
    if (!server.is_tls) return;
    context_.set_default_verify_paths();
    tls_.emplace(tcp_, context_);
    tls_->set_verify_mode(ssl::verify_peer);
    tls_->set_verify_callback(ssl::host_name_verification(server.host));
    SSL_set_tlsext_host_name(tls_->native_handle(), server.host.c_str());
    tls_->handshake(ssl::stream_base::client);
  }

  template <class Message>
  void write(const Message& message) {
    tls_ ? http::write(*tls_, message) : http::write(tcp_, message);
  }
  void read_header(Parser& parser) {
    tls_ ? http::read_header(*tls_, buffer_, parser) : http::read_header(tcp_, buffer_, parser);
  }
  void read(Parser& parser) {
    tls_ ? http::read(*tls_, buffer_, parser) : http::read(tcp_, buffer_, parser);
  }
  void read_some(Parser& parser, ErrorCode& ec) {
    tls_ ? http::read_some(*tls_, buffer_, parser, ec) : http::read_some(tcp_, buffer_, parser, ec);
  }

 private:
  asio::io_context io_;
  Tcp tcp_;
  ssl::context context_{ssl::context::tls_client};
  std::optional<ssl::stream<Tcp&>> tls_;
  beast::flat_buffer buffer_;
};

http::request<http::string_body> message_of(const ServerUrl& server, const ClientRequest& request) {
  http::request<http::string_body> message;
  message.version(11);
  message.method_string(request.method);
  message.target(server.prefix + request.target);
  message.set(http::field::host, server.authority());
  message.set(http::field::user_agent, "armloom");
  message.set(http::field::connection, "close");
  if (!request.accept.empty()) message.set(http::field::accept, request.accept);
  if (!request.token.empty()) message.set(http::field::authorization, "Bearer " + request.token);
  if (!request.body.empty()) message.set(http::field::content_type, "application/json");
  message.body() = request.body;
  if (request.method != "GET") message.prepare_payload();
  return message;
}

ClientResponse response_of(Parser& parser) {
  return {static_cast<int>(parser.get().result_int()),
          std::string(parser.get()[http::field::content_type]), std::move(parser.get().body())};
}

// Passes the whole lines to `take` and removes them. Returns false if `take` did.
bool take_lines(std::string& text, const std::function<bool(std::string_view)>& take) {
  std::size_t begin = 0;
  for (std::size_t end = 0; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    if (!take(std::string_view(text).substr(begin, end - begin))) return false;
  }
  text.erase(0, begin);
  return true;
}

}  // namespace

std::string ServerUrl::authority() const {
  const std::string name = host.find(':') == host.npos ? host : "[" + host + "]";
  return port == (is_tls ? "443" : "80") ? name : name + ":" + port;
}

Result<ServerUrl> read_server_url(const std::string& text) {
  const auto bad = [&](const char* why) {
    return failure(Problem{ProblemKind::invalid, "bad-url", "",
                           "\"" + text + "\" is not the address of a server: " + why +
                               "; expected for example http://127.0.0.1:8080",
                           text});
  };
  ServerUrl server;
  std::string_view rest = text;
  if (rest.starts_with("https://")) {
    server.is_tls = true;
    rest.remove_prefix(8);
  } else if (rest.starts_with("http://")) {
    rest.remove_prefix(7);
  } else {
    return bad("it begins with neither http:// nor https://");
  }
  const std::string_view authority = rest.substr(0, rest.find('/'));
  server.prefix = rest.substr(authority.size());
  while (server.prefix.ends_with('/')) server.prefix.pop_back();
  if (server.prefix.find_first_of("?#") != std::string::npos) return bad("it has a query");
  const bool is_bracketed = authority.starts_with('[');
  const std::size_t end = is_bracketed ? authority.find(']') : 0;
  if (end == authority.npos) return bad("a bracket is missing");
  const std::size_t colon = authority.find(':', end);
  server.host = is_bracketed ? authority.substr(1, end - 1) : authority.substr(0, colon);
  server.port = colon == authority.npos ? std::string_view(server.is_tls ? "443" : "80")
                                        : authority.substr(colon + 1);
  if (server.host.empty()) return bad("it names no host");
  const bool is_number =
      std::ranges::all_of(server.port, [](unsigned char c) { return std::isdigit(c) != 0; });
  if (server.port.empty() || !is_number) return bad("the port is not a number");
  return server;
}

Result<ClientResponse> fetch(const ServerUrl& server, const ClientRequest& request) {
  try {
    ClientStream stream(server);
    stream.write(message_of(server, request));
    Parser parser;
    parser.body_limit(kAnswerMax);
    stream.read(parser);
    return response_of(parser);
  } catch (const boost::system::system_error& error) {
    return failure(unreachable(server, error.code()));
  }
}

Result<ClientResponse> follow(const ServerUrl& server, const ClientRequest& request,
                              const std::function<bool(std::string_view line)>& take) {
  try {
    ClientStream stream(server);
    stream.write(message_of(server, request));
    Parser parser;
    parser.body_limit(boost::none);
    stream.read_header(parser);
    if (parser.get().result_int() >= 300) {
      stream.read(parser);
      return response_of(parser);
    }
    ErrorCode ec;
    for (bool goes_on = true; goes_on && !ec && !parser.is_done();) {
      stream.read_some(parser, ec);
      goes_on = take_lines(parser.get().body(), take);
    }
    parser.get().body().clear();
    return response_of(parser);
  } catch (const boost::system::system_error& error) {
    return failure(unreachable(server, error.code()));
  }
}

}  // namespace armloom
