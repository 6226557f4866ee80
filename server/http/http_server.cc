#include "server/http/http_server.h"

#include <csignal>
#include <string>
#include <unordered_map>
#include <utility>

#include "server/http/asio.h"
#include "server/http/posted_tasks.h"
#include "server/http/session.h"
#include "server/http/transport.h"

namespace armloom {
namespace {

constexpr std::chrono::milliseconds kReadToTheEnd{500};  // for readers to read to the end
constexpr std::size_t kRefusingMax = 32;                 // at once; beyond, closed without a word
// For arms to come to rest: with the closing of connections, the process ends within two seconds.
constexpr std::chrono::milliseconds kWindDownMax{1200};

Problem cannot_listen(const std::string& address, std::uint16_t port, const std::string& why) {
  const std::string place = address + ":" + std::to_string(port);
  return Problem{ProblemKind::unavailable, "cannot-listen", "--listen",
                 "cannot listen on " + place + ": " + why, place};
}

}  // namespace

Reach reach_of(const std::string& address) {
  ErrorCode ec;
  const auto ip = asio::ip::make_address(address, ec);
  if (ec) return Reach::nobody;
  return ip.is_loopback() ? Reach::this_machine : Reach::others;
}

class HttpServer::Impl {
 public:
  explicit Impl(std::size_t connections_max) : connections_{.max = connections_max} {}

  std::optional<Problem> open(const std::string& address, std::uint16_t port) {
    ErrorCode ec;
    const auto ip = asio::ip::make_address(address, ec);
    if (ec) return cannot_listen(address, port, "not an IP address");
    const tcp::endpoint endpoint(ip, port);
    acceptor_.open(endpoint.protocol(), ec);
    if (!ec) acceptor_.set_option(asio::socket_base::reuse_address(true), ec);
    if (!ec) acceptor_.bind(endpoint, ec);
    if (!ec) acceptor_.listen(asio::socket_base::max_listen_connections, ec);
    if (!ec) acceptor_.non_blocking(true, ec);
    if (!ec) spare_.open(tcp::v4(), ec);
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
      // The terminal is closed; but nohup has said that this is nothing to us.
      struct sigaction hangup {};
      if (sigaction(SIGHUP, nullptr, &hangup) == 0 && hangup.sa_handler != SIG_IGN) {
        signals_.add(SIGHUP);
      }
      signals_.async_wait([this](ErrorCode ec, int) {
        if (!ec) wind_down();
      });
    }
    asio::co_spawn(io_, accept(), asio::detached);
    io_.run();
  }

  asio::io_context& io() { return io_; }
  PostedTasks& posted() { return posted_; }
  std::uint16_t port() const { return acceptor_.local_endpoint().port(); }

 private:
  // Nobody new; what runs comes to rest. A second signal does not wait for that.
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

  // Subscriptions are told that the server ends, and connections get a moment to read it.
  void end() {
    if (std::exchange(told_readers_, true)) return;
    site_.end();
    winding_down_.expires_after(kReadToTheEnd);
    winding_down_.async_wait([this](ErrorCode) { io_.stop(); });
    if (connections_.open == 0) io_.stop();
  }

  asio::awaitable<void> serve(tcp::socket socket, std::string client) {
    ++connections_.open;
    ++connections_.of_client[client];
    co_await serve_connection(Transport(std::move(socket), tls_), site_, *memory_);
    if (--connections_.of_client[client] == 0) connections_.of_client.erase(client);
    if (--connections_.open == 0 && told_readers_) io_.stop();
  }

  [[nodiscard]] Refusal too_many() const {
    const std::string why = connections_.open < connections_.max
                                ? "the system gives no more file descriptors"
                                : std::to_string(connections_.max) +
                                      " connections are open, more are not served at once";
    return {503, "too-many-connections", why, std::nullopt, std::nullopt, {{"Retry-After", "1"}}};
  }
  [[nodiscard]] Refusal too_many_of(const std::string& client) const {
    return {429,
            "too-many-connections",
            std::to_string(site_.connections_per_client_max) + " connections are open from " +
                client + ", more are not served to one client",
            std::nullopt,
            client,
            {{"Retry-After", "1"}}};
  }

  asio::awaitable<void> refuse(tcp::socket socket, Refusal why) {
    ++connections_.refusing;
    co_await refuse_connection(Transport(std::move(socket), tls_), site_.refuse(why), *memory_);
    --connections_.refusing;
  }

  void refuse_soon(tcp::socket socket, Refusal why) {
    if (connections_.refusing >= kRefusingMax) return;
    asio::co_spawn(io_, refuse(std::move(socket), std::move(why)), asio::detached);
  }

  void take(tcp::socket socket) {
    if (connections_.open >= connections_.max) return refuse_soon(std::move(socket), too_many());
    ErrorCode ec;
    const auto peer = socket.remote_endpoint(ec);
    const std::string client = ec ? std::string() : peer.address().to_string();
    const auto known = connections_.of_client.find(client);
    if (known != connections_.of_client.end() &&
        known->second >= site_.connections_per_client_max) {
      if (site_.on_limited_connection) site_.on_limited_connection();
      return refuse_soon(std::move(socket), too_many_of(client));
    }
    asio::co_spawn(io_, serve(std::move(socket), client), asio::detached);
  }

  // The system gives no descriptor for whoever comes: the one that was kept for this takes them,
  // one after the other, to be told so.
  asio::awaitable<void> refuse_with_spare() {
    ErrorCode ec;
    spare_.close(ec);
    tcp::socket socket(io_);
    acceptor_.accept(socket, ec);
    if (!ec) co_await refuse(std::move(socket), too_many());
    spare_.open(tcp::v4(), ec);
  }

  asio::awaitable<void> accept() {
    asio::steady_timer pause(io_);
    for (;;) {
      ErrorCode ec;
      tcp::socket socket = co_await acceptor_.async_accept(into(ec));
      if (!ec) {
        take(std::move(socket));
        continue;
      }
      if (ending_) co_return;
      if (ec == boost::system::errc::too_many_files_open && spare_.is_open()) {
        co_await refuse_with_spare();
        continue;
      }
      pause.expires_after(std::chrono::milliseconds(50));
      co_await pause.async_wait(into(ec));
    }
  }

  Site site_;  // outlives the connections, which end with io_
  std::optional<MemoryBudget> memory_;
  TlsContextPtr tls_;  // null: without
  asio::io_context io_{1};
  PostedTasks posted_{io_};
  tcp::acceptor acceptor_{io_};
  tcp::socket spare_{io_};  // a descriptor for refusing whoever comes when there is no other
  asio::signal_set signals_{io_};
  asio::steady_timer winding_down_{io_};
  struct Connections {
    const std::size_t max;
    std::size_t open = 0;
    std::unordered_map<std::string, std::size_t> of_client = {};  // of these, by address
    std::size_t refusing = 0;
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
