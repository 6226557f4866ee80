#include "server/http/transport.h"

#include <boost/asio/ssl/error.hpp>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "server/http/http_server.h"

namespace armloom {
namespace {

namespace ssl = asio::ssl;

// The library says of a file that is not there no more than that it cannot be used.
Problem unusable(const char* option, const std::string& file, const char* expected,
                 const ErrorCode& why) {
  const bool is_readable = std::ifstream(file).good();
  return {ProblemKind::invalid, "bad-certificate", option,
          is_readable ? file + " holds no " + expected + " (" + why.message() + ")"
                      : file + " cannot be read: " + std::generic_category().message(errno),
          file};
}

}  // namespace

Result<TlsContextPtr> tls_context(const TlsFiles& files) {
  auto context = std::make_shared<ssl::context>(ssl::context::tls_server);
  context->set_options(ssl::context::default_workarounds | ssl::context::no_sslv2 |
                       ssl::context::no_sslv3 | ssl::context::no_tlsv1 | ssl::context::no_tlsv1_1 |
                       ssl::context::single_dh_use);
  ErrorCode ec;
  context->use_certificate_chain_file(files.certificate, ec);
  if (ec)
    return failure(unusable("--tls-certificate", files.certificate, "certificate in PEM", ec));
  context->use_private_key_file(files.key, ssl::context::pem, ec);
  if (ec) return failure(unusable("--tls-key", files.key, "private key in PEM", ec));
  return context;
}

Transport::Transport(tcp::socket socket, const TlsContextPtr& tls)
    : tcp_(std::make_unique<next_layer_type>(std::move(socket))) {
  if (tls) tls_ = std::make_unique<ssl::stream<next_layer_type&>>(*tcp_, *tls);
}

std::string Transport::peer() const {
  ErrorCode ec;
  const auto end = tcp_->socket().remote_endpoint(ec);
  return ec ? std::string() : end.address().to_string(ec);
}

asio::awaitable<bool> Transport::shake_hands(std::chrono::milliseconds time) {
  if (!tls_) co_return true;
  ErrorCode ec;
  tcp_->expires_after(time);
  co_await tls_->async_handshake(ssl::stream_base::server, into(ec));
  co_return !ec;
}

void teardown(boost::beast::role_type role, Transport& transport, ErrorCode& ec) {
  using boost::beast::websocket::teardown;
  teardown(role, transport.next_layer(), ec);
}

}  // namespace armloom
