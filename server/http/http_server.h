#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "core/base/problem.h"
#include "server/http/message.h"

namespace armloom {

// Files in PEM: a certificate with those between it and its root, and its key.
struct TlsFiles {
  std::string certificate;
  std::string key;
};

// Who can reach a server that listens there: nobody (it is no IP address), this machine alone, or
// others too.
enum class Reach { nobody, this_machine, others };
[[nodiscard]] Reach reach_of(const std::string& address);

// The listening socket and the one thread on which every connection is served.
class HttpServer {
 public:
  // Binds and listens; nothing is accepted before run(). Port zero: any free one. Whoever connects
  // while `connections_max` are open, or when the system gives no more descriptors, is served in
  // the reserve (session.h): a stop is taken, any other request answered 503
  // ("too-many-connections"). When dozens come at once, the first of them are closed without a
  // word. Problem (unavailable, "cannot-listen"): the address is no IP address, or the port is in
  // use.
  [[nodiscard]] static Result<std::unique_ptr<HttpServer>> listen(const std::string& address,
                                                                  std::uint16_t port,
                                                                  std::size_t connections_max);
  ~HttpServer();

  // From now on, before run(), every connection goes through TLS (1.2 or later). Problem (invalid):
  // a file cannot be read, or the key is not the certificate's.
  [[nodiscard]] Result<void> use_tls(const TlsFiles& files);

  [[nodiscard]] std::uint16_t port() const;

  // Serves `site` on the calling thread until stop(), or until SIGINT, SIGTERM or SIGHUP if those
  // are to be watched: then every subscription says why it closes first. Connections are closed.
  void run(Site site, bool until_signal);

  // Thread-safe. Runs `task` on the server's thread, soon, in the order posted; whoever is at a
  // socket has a turn between.
  void post(std::function<void()> task);
  // Before all that was posted and has not run.
  void post_urgent(std::function<void()> task);
  void stop();  // thread-safe

 private:
  class Impl;
  explicit HttpServer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace armloom
