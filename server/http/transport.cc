#include "server/http/transport.h"

#include <algorithm>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/error.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/beast/core/basic_stream.hpp>
#include <boost/beast/websocket/teardown.hpp>
#include <cerrno>
#include <fstream>
#include <optional>
#include <system_error>

#include "server/http/http_server.h"

namespace armloom {
namespace {

namespace ssl = asio::ssl;

// The TLS library reports the same error for a missing and for an invalid file.
Problem unusable(const char* option, const std::string& file, const char* expected,
                 const ErrorCode& why) {
  const bool is_readable = std::ifstream(file).good();
  return {ProblemKind::invalid, "bad-certificate", option,
          is_readable ? file + " contains no " + expected + " (" + why.message() + ")"
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

struct Transport::Layers {
  using Tcp = boost::beast::basic_stream<asio::ip::tcp, Executor>;
  explicit Layers(Socket socket) : tcp(std::move(socket)) {}
  Tcp tcp;
  std::optional<ssl::stream<Tcp&>> tls;
};

Transport::Transport(Socket socket, const TlsContextPtr& tls)
    : layers_(std::make_unique<Layers>(std::move(socket))) {
  if (tls) layers_->tls.emplace(layers_->tcp, *tls);
}
Transport::Transport(Transport&&) noexcept = default;
Transport::~Transport() = default;

Socket& Transport::socket() { return layers_->tcp.socket(); }
void Transport::expires_after(std::chrono::milliseconds time) { layers_->tcp.expires_after(time); }
void Transport::expires_never() { layers_->tcp.expires_never(); }
void Transport::cancel() { layers_->tcp.cancel(); }
void Transport::close() { layers_->tcp.close(); }

std::string Transport::peer() const {
  ErrorCode ec;
  const auto end = layers_->tcp.socket().remote_endpoint(ec);
  return ec ? std::string() : end.address().to_string(ec);
}

Awaitable<bool> Transport::shake_hands(std::chrono::milliseconds time) {
  if (!layers_->tls) co_return true;
  ErrorCode ec;
  expires_after(time);
  co_await layers_->tls->async_handshake(ssl::stream_base::server, into(ec));
  co_return !ec;
}

Awaitable<std::size_t> Transport::read_some(asio::mutable_buffer to, ErrorCode& ec) {
  co_return co_await async_read_some(to, into(ec));
}

Awaitable<void> Transport::write(asio::const_buffer first, asio::const_buffer second,
                                 ErrorCode& ec) {
  ec = {};
  while (!ec && first.size() + second.size() > 0) {
    const std::array both{first, second};
    const std::size_t written = co_await async_write_some(both, into(ec));
    second += written - std::min(written, first.size());
    first += written;
  }
}

void Transport::start_read(asio::mutable_buffer to, Completion then) {
  if (layers_->tls) return layers_->tls->async_read_some(to, std::move(then));
  layers_->tcp.async_read_some(to, std::move(then));
}

void Transport::start_write(const Written& from, Completion then) {
  if (layers_->tls) return layers_->tls->async_write_some(from, std::move(then));
  layers_->tcp.async_write_some(from, std::move(then));
}

void async_teardown(boost::beast::role_type role, Transport& transport, Completion then) {
  boost::beast::websocket::async_teardown(role, transport.socket(), std::move(then));
}

void beast_close_socket(Transport& transport) { transport.close(); }

}  // namespace armloom
