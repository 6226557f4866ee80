#include "server/http/http_server.h"

#include <algorithm>
#include <boost/asio/basic_signal_set.hpp>
#include <boost/asio/basic_socket_acceptor.hpp>
#include <boost/asio/post.hpp>
#include <csignal>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>

#include "server/http/asio.h"
#include "server/http/posted_tasks.h"
#include "server/http/reserve.h"
#include "server/http/session.h"
#include "server/http/transport.h"

namespace armloom {
namespace {

using Acceptor = asio::basic_socket_acceptor<asio::ip::tcp, Executor>;

constexpr std::chrono::milliseconds kReadToTheEnd{500};  // for clients to read the close reason
constexpr std::size_t kReservedMax = 64;                 // reserve slots
// Number of connections accepted in a row before other tasks get a turn.
constexpr int kTakenAtOnce = 16;
// Time for arms to come to rest. The whole shutdown takes two seconds at most.
constexpr std::chrono::milliseconds kWindDownMax{1200};

Problem cannot_listen(const std::string& address, std::uint16_t port, const std::string& why) {
  const std::string place = address + ":" + std::to_string(port);
  return Problem{ProblemKind::unavailable, "cannot-listen", "--listen",
                 "cannot listen on " + place + ": " + why, place};
}

// Returns the client's address, or "" if it has disconnected.
std::string client_of(const Socket& socket) {
  ErrorCode ec;
  const auto peer = socket.remote_endpoint(ec);
  return ec ? std::string() : peer.address().to_string();
}

}  // namespace

AddressReach reach_of(const std::string& address) {
  ErrorCode ec;
  const auto ip = asio::ip::make_address(address, ec);
  if (ec) return AddressReach::nobody;
  return ip.is_loopback() ? AddressReach::this_machine : AddressReach::others;
}

class HttpServer::Impl {
 public:
  explicit Impl(std::size_t connections_max)
      : reserve_(std::clamp<std::size_t>(connections_max / 4, 4, kReservedMax)),
        connections_{.max = connections_max} {}

  std::optional<Problem> open(const std::string& address, std::uint16_t port) {
    ErrorCode ec;
    const auto ip = asio::ip::make_address(address, ec);
    if (ec)
      return cannot_listen(
          address, port, "not an IP address; names are not resolved, use 127.0.0.1 for localhost");
    const asio::ip::tcp::endpoint endpoint(ip, port);
    acceptor_.open(endpoint.protocol(), ec);
    if (!ec) acceptor_.set_option(asio::socket_base::reuse_address(true), ec);
    if (!ec) acceptor_.bind(endpoint, ec);
    if (!ec) acceptor_.listen(asio::socket_base::max_listen_connections, ec);
    if (!ec) acceptor_.non_blocking(true, ec);
    if (ec) return cannot_listen(address, port, ec.message());
    return std::nullopt;
  }

  Result<void> use_tls(const TlsFiles& files) {
    auto tls = tls_context(files);
    if (!tls) return failure(std::move(tls.error()));
    tls_ = std::move(*tls);
    return {};
  }

  void run(Site site, bool until_signal) {
    site_ = std::move(site);
    memory_.emplace(site_.memory_max);
    if (until_signal) {
      signals_.add(SIGINT);
      signals_.add(SIGTERM);
      // SIGHUP means that the terminal was closed. Under nohup, SIGHUP is ignored and must stay
      // ignored.
      struct sigaction hangup {};
      if (sigaction(SIGHUP, nullptr, &hangup) == 0 && hangup.sa_handler != SIG_IGN) {
        signals_.add(SIGHUP);
      }
      signals_.async_wait([this](ErrorCode ec, int) {
        if (!ec) wind_down();
      });
    }
    reserve_.fill();
    spawn(io_.get_executor(), accept());
    io_.run();
  }

  asio::io_context& io() { return io_; }
  PostedTasks& posted() { return posted_; }
  std::uint16_t port() const { return acceptor_.local_endpoint().port(); }

 private:
  // Accepts no more connections and brings all arms to rest. A second signal skips the wait.
  void wind_down() {
    ErrorCode ignored;
    acceptor_.close(ignored);
    ending_ = true;
    signals_.async_wait([this](ErrorCode ec, int) {
      if (!ec) end();
    });
    winding_down_.expires_after(kWindDownMax);
    winding_down_.async_wait([this](ErrorCode ec) {
      if (!ec) end();
    });
    site_.wind_down([this] { asio::post(io_, [this] { end(); }); });
  }

  // Ends all subscriptions, and gives clients a moment to read the reason.
  void end() {
    if (std::exchange(told_readers_, true)) return;
    site_.end();
    winding_down_.expires_after(kReadToTheEnd);
    winding_down_.async_wait([this](ErrorCode) { io_.stop(); });
    if (connections_.open == 0) io_.stop();
  }

  Awaitable<void> serve(Socket socket, std::string client) {
    co_await serve_connection(Transport(std::move(socket), tls_), site_, *memory_);
    if (--connections_.of_client[client] == 0) connections_.of_client.erase(client);
    if (--connections_.open == 0 && told_readers_) io_.stop();
  }

  [[nodiscard]] Refusal too_many() const {
    const std::string why =
        connections_.open < connections_.max
            ? "the system has no free file descriptors"
            : std::to_string(connections_.max) + " connections are open, which is the limit";
    return {503, "too-many-connections", why, std::nullopt, std::nullopt, {{"Retry-After", "1"}}};
  }
  [[nodiscard]] Refusal too_many_of(const std::string& client) const {
    return {429,
            "too-many-connections",
            std::to_string(site_.connections_per_client_max) + " connections are open from " +
                client + ", which is the limit for one client",
            std::nullopt,
            client,
            {{"Retry-After", "1"}}};
  }

  Awaitable<void> serve_reserved(Transport transport, std::unique_ptr<Reserve::Place> place,
                                 Refusal why) {
    co_await serve_in_reserve(std::move(transport), *place, std::move(why), site_, *memory_);
    place.reset();
    reserve_.fill();
  }

  void reserve(Socket socket, const Refusal& why) {
    std::string client = client_of(socket);
    Transport transport(std::move(socket), tls_);
    auto place = std::make_unique<Reserve::Place>(reserve_, transport.socket(), std::move(client));
    spawn(io_.get_executor(), serve_reserved(std::move(transport), std::move(place), why));
  }

  void refuse(Socket socket, const Refusal& why) {
    if (reserve_.make_room()) reserve(std::move(socket), why);
  }

  void take(Socket socket) {
    if (connections_.open >= connections_.max) return refuse(std::move(socket), too_many());
    const std::string client = client_of(socket);
    const auto known = connections_.of_client.find(client);
    if (known != connections_.of_client.end() &&
        known->second >= site_.connections_per_client_max) {
      if (site_.on_limited_connection) site_.on_limited_connection();
      return refuse(std::move(socket), too_many_of(client));
    }
    ++connections_.open;
    ++connections_.of_client[client];
    spawn(io_.get_executor(), serve(std::move(socket), client));
  }

  // Accepts one connection in the reserve, with a file descriptor that the reserve frees.
  ErrorCode take_in_reserve() {
    ErrorCode ec = asio::error::no_descriptors;
    if (!reserve_.make_room()) return ec;
    Socket socket(io_);
    acceptor_.accept(socket, ec);
    if (ec) {
      reserve_.fill();
    } else {
      reserve(std::move(socket), too_many());
    }
    return ec;
  }

  // Accepts at most kTakenAtOnce waiting connections. Returns the error that ended this early, if
  // any.
  ErrorCode take_some() {
    ErrorCode ec;
    for (int taken = 0; !ec && taken < kTakenAtOnce; ++taken) {
      Socket socket(io_);
      acceptor_.accept(socket, ec);
      if (!ec) {
        take(std::move(socket));
      } else if (ec == asio::error::no_descriptors) {
        ec = take_in_reserve();
      }
    }
    return ec;
  }

  Awaitable<void> accept() {
    Timer pause(io_);
    for (;;) {
      ErrorCode ec;
      co_await acceptor_.async_wait(Acceptor::wait_read, into(ec));
      if (!ec) ec = take_some();
      if (ending_) co_return;
      if (!ec || ec == asio::error::would_block) continue;
      pause.expires_after(std::chrono::milliseconds(50));
      co_await pause.async_wait(into(ec));
    }
  }

  Site site_;  // outlives the connections, which end with io_
  std::optional<MemoryBudget> memory_;
  TlsContextPtr tls_;  // null without TLS
  Reserve reserve_;
  asio::io_context io_{1};
  PostedTasks posted_{io_};
  Acceptor acceptor_{io_};
  asio::basic_signal_set<Executor> signals_{io_};
  Timer winding_down_{io_};
  struct Connections {
    const std::size_t max;
    std::size_t open = 0;
    std::unordered_map<std::string, std::size_t> of_client = {};  // open connections by address
  };
  Connections connections_;
  bool ending_ = false;
  bool told_readers_ = false;
};

Result<std::unique_ptr<HttpServer>> HttpServer::listen(const std::string& address,
                                                       std::uint16_t port,
                                                       std::size_t connections_max) {
  auto impl = std::make_unique<Impl>(connections_max);
  if (auto problem = impl->open(address, port)) return failure(std::move(*problem));
  return std::unique_ptr<HttpServer>(new HttpServer(std::move(impl)));
}

HttpServer::HttpServer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
HttpServer::~HttpServer() = default;

Result<void> HttpServer::use_tls(const TlsFiles& files) { return impl_->use_tls(files); }
std::uint16_t HttpServer::port() const { return impl_->port(); }
void HttpServer::run(Site site, bool until_signal) { impl_->run(std::move(site), until_signal); }
void HttpServer::post(std::function<void()> task) { impl_->posted().post(std::move(task)); }
void HttpServer::post_urgent(std::function<void()> task) {
  asio::post(impl_->io(), std::move(task));
}
void HttpServer::stop() { impl_->io().stop(); }

}  // namespace armloom
