#include "server/drivers/line_stream.h"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>

namespace armloom {
namespace {

constexpr int kConnectSlices = 40;
constexpr int kConnectSlice_ms = 50;
constexpr int kBacklog = 8;
constexpr std::size_t kReadAtOnce = 64 * 1024;

tl::unexpected<Problems> unavailable(const std::string& what, int error) {
  return failure(Problem{ProblemKind::unavailable, "endpoint-unavailable", "",
                         what + ": " + std::strerror(error)});
}

struct Address {
  sockaddr_storage storage{};
  socklen_t size = 0;
  [[nodiscard]] const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage); }
  [[nodiscard]] int family() const { return storage.ss_family; }
};

Result<Address> address_of(const Endpoint& endpoint, int flags) {
  Address address;
  if (endpoint.is_unix()) {
    sockaddr_un name{};
    name.sun_family = AF_UNIX;
    endpoint.path.copy(name.sun_path, sizeof name.sun_path - 1);
    std::memcpy(&address.storage, &name, sizeof name);
    address.size = sizeof name;
    return address;
  }
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = flags | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int error = getaddrinfo(endpoint.host.c_str(), endpoint.port.c_str(), &hints, &found);
  if (error != 0) {
    return failure(Problem{ProblemKind::unavailable, "endpoint-unavailable", "",
                           endpoint.text() + ": " + gai_strerror(error)});
  }
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> owner(found, freeaddrinfo);
  std::memcpy(&address.storage, found->ai_addr, found->ai_addrlen);
  address.size = found->ai_addrlen;
  return address;
}

Descriptor socket_for(const Address& address) {
  Descriptor made(socket(address.family(), SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const int on = 1;
  if (made.is_open() && address.family() != AF_UNIX) {
    setsockopt(made.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  }
  return made;
}

// Removes the file of a socket whose process has ended. Returns a problem if another process
// listens there, or if the file is no socket.
std::optional<Problem> remove_stale(const Endpoint& endpoint, const Address& address) {
  const auto in_use = [&](const std::string& why) {
    return Problem{ProblemKind::unavailable, "endpoint-unavailable", "",
                   "cannot listen on " + endpoint.text() + ": " + why};
  };
  struct stat file {};
  if (lstat(endpoint.path.c_str(), &file) != 0) return std::nullopt;
  if (!S_ISSOCK(file.st_mode)) {
    return in_use("the file exists and is no socket of an arm: remove it, or choose another path");
  }
  const Descriptor probe = socket_for(address);
  if (connect(probe.get(), address.get(), address.size) == 0) {
    return in_use("another process listens there: end it, or choose another path");
  }
  if (errno == ECONNREFUSED) unlink(endpoint.path.c_str());
  return std::nullopt;
}

}  // namespace

Descriptor::~Descriptor() {
  if (fd_ >= 0) close(fd_);
}

Result<Descriptor> connect_to(const Endpoint& endpoint, const std::stop_token& stop) {
  const auto address = address_of(endpoint, 0);
  if (!address) return failure(address.error());
  Descriptor made = socket_for(*address);
  if (!made.is_open()) return unavailable(endpoint.text(), errno);
  if (connect(made.get(), address->get(), address->size) == 0) return made;
  if (errno != EINPROGRESS) return unavailable("no answer from " + endpoint.text(), errno);
  pollfd waits{made.get(), POLLOUT, 0};
  for (int i = 0; i < kConnectSlices && waits.revents == 0 && !stop.stop_requested(); ++i) {
    (void)poll(&waits, 1, kConnectSlice_ms);
  }
  int error = ETIMEDOUT;
  socklen_t size = sizeof error;
  if (waits.revents != 0) getsockopt(made.get(), SOL_SOCKET, SO_ERROR, &error, &size);
  if (error != 0) return unavailable("no answer from " + endpoint.text(), error);
  return made;
}

Result<Descriptor> listen_on(const Endpoint& endpoint) {
  const auto address = address_of(endpoint, AI_PASSIVE);
  if (!address) return failure(address.error());
  if (endpoint.is_unix()) {
    if (auto problem = remove_stale(endpoint, *address)) return failure(*std::move(problem));
  }
  Descriptor made = socket_for(*address);
  const int on = 1;
  if (!endpoint.is_unix()) setsockopt(made.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (!made.is_open() || bind(made.get(), address->get(), address->size) != 0 ||
      listen(made.get(), kBacklog) != 0) {
    return unavailable("cannot listen on " + endpoint.text(), errno);
  }
  return made;
}

Endpoint bound_endpoint(const Endpoint& endpoint, const Descriptor& listening) {
  Endpoint bound = endpoint;
  sockaddr_storage name{};
  socklen_t size = sizeof name;
  if (endpoint.is_unix() ||
      getsockname(listening.get(), reinterpret_cast<sockaddr*>(&name), &size) != 0) {
    return bound;
  }
  const auto port = name.ss_family == AF_INET6 ? reinterpret_cast<sockaddr_in6&>(name).sin6_port
                                               : reinterpret_cast<sockaddr_in&>(name).sin_port;
  bound.port = std::to_string(ntohs(port));
  return bound;
}

Descriptor accept_from(const Descriptor& listening) {
  Descriptor made(accept4(listening.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  const int on = 1;
  if (made.is_open()) setsockopt(made.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  return made;
}

void LineStream::fail(std::string why) {
  if (!end_) end_ = std::move(why);
}

void LineStream::receive() {
  if (taken_ > 0) {
    in_.erase(0, taken_);
    searched_ -= std::min(searched_, taken_);
    taken_ = 0;
  }
  while (!end_) {
    const std::size_t before = in_.size();
    in_.resize(before + kReadAtOnce);
    const ssize_t got = recv(socket_.get(), in_.data() + before, kReadAtOnce, 0);
    in_.resize(before + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    if (got == 0) return fail("the connection was closed");
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) {
      if (errno != EAGAIN && errno != EWOULDBLOCK) fail(std::strerror(errno));
      return;
    }
    if (static_cast<std::size_t>(got) < kReadAtOnce || in_.size() > line_max_) return;
  }
}

std::optional<std::string> LineStream::next_line() {
  const std::size_t at = in_.find('\n', std::max(taken_, searched_));
  const bool is_complete = at != in_.npos;
  if ((is_complete ? at : in_.size()) - taken_ > line_max_) {
    fail("a line is longer than " + std::to_string(line_max_) + " bytes");
    return std::nullopt;
  }
  if (!is_complete) {
    searched_ = in_.size();
    return std::nullopt;
  }
  std::string line = in_.substr(taken_, at - taken_);
  searched_ = taken_ = at + 1;
  return line;
}

void LineStream::send(std::string_view line) {
  if (end_) return;
  if (out_.size() - sent_ + line.size() > unsent_max_) {
    return fail("the peer does not read: " + std::to_string(out_.size() - sent_) +
                " bytes wait to be sent");
  }
  out_.append(line).push_back('\n');
}

void LineStream::flush() {
  while (!end_ && has_unsent()) {
    const ssize_t put =
        ::send(socket_.get(), out_.data() + sent_, out_.size() - sent_, MSG_NOSIGNAL);
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) {
      if (errno != EAGAIN && errno != EWOULDBLOCK) fail(std::strerror(errno));
      break;
    }
    sent_ += static_cast<std::size_t>(put);
  }
  if (!has_unsent()) {
    out_.clear();
    sent_ = 0;
  } else if (sent_ > kReadAtOnce) {
    out_.erase(0, sent_);
    sent_ = 0;
  }
}

}  // namespace armloom
