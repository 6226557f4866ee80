#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "core/base/problem.h"
#include "server/http/message.h"

namespace armloom {

// PEM files: certificate chain (without the root) and private key.
struct TlsFiles {
  std::string certificate;
  std::string key;
};

// Clients that can reach a listener on the address. The first value means that the address is not
// an IP address.
enum class AddressReach { nobody, this_machine, others };
[[nodiscard]] AddressReach reach_of(const std::string& address);

// The listening socket and the one thread that serves every connection.
class HttpServer {
 public:
  // Binds and listens; accepts no connection before run(). Port zero takes any free port. When
  // `connections_max` connections are open, or the system has no free file descriptor, a new
  // connection is served in the reserve (session.h). There, a stop is served, and any other request
  // is answered with 503 ("too-many-connections"). If the reserve is full, connections are dropped
  // without an answer. Problem (unavailable, "cannot-listen"): the address is not an IP address, or
  // the port is in use.
  [[nodiscard]] static Result<std::unique_ptr<HttpServer>> listen(const std::string& address,
                                                                  std::uint16_t port,
                                                                  std::size_t connections_max);
  ~HttpServer();

  // Serves every connection over TLS (1.2 or later). Call before run(). Problem (invalid): a file
  // cannot be read, or the key does not match the certificate.
  [[nodiscard]] Result<void> use_tls(const TlsFiles& files);

  [[nodiscard]] std::uint16_t port() const;

  // Serves `site` on the calling thread until stop() or, with `until_signal`, until SIGINT, SIGTERM
  // or SIGHUP. A signal brings all arms to rest, and then sends the close reason to every
  // subscriber. Then closes all connections.
  void run(Site site, bool until_signal);

  // Thread-safe. Runs `task` soon on the server's thread, in order. Sockets are served between the
  // tasks.
  void post(std::function<void()> task);
  // Thread-safe. Runs `task` soon on the server's thread, before the tasks that wait in the queue
  // of post().
  void post_urgent(std::function<void()> task);
  void stop();  // thread-safe

 private:
  class Impl;
  explicit HttpServer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace armloom
