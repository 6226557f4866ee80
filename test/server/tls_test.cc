#include <gtest/gtest.h>
#include <openssl/bio.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <filesystem>
#include <memory>

#include "server/access/token_file.h"
#include "test/server/running_server.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;

template <auto kFree>
struct Free {
  template <class T>
  void operator()(T* value) const {
    kFree(value);
  }
};
template <class T, auto kFree>
using Owned = std::unique_ptr<T, Free<kFree>>;

void close_file(std::FILE* file) { std::fclose(file); }
using File = Owned<std::FILE, close_file>;

// Writes a key and a self-signed certificate.
void write_certificate(const fs::path& certificate, const fs::path& key) {
  const Owned<EVP_PKEY, EVP_PKEY_free> pair(EVP_EC_gen("P-256"));
  const Owned<X509, X509_free> made(X509_new());
  ASN1_INTEGER_set(X509_get_serialNumber(made.get()), 1);
  X509_gmtime_adj(X509_getm_notBefore(made.get()), -60);
  X509_gmtime_adj(X509_getm_notAfter(made.get()), 3600);
  X509_set_pubkey(made.get(), pair.get());
  X509_NAME* name = X509_get_subject_name(made.get());
  X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC,
                             reinterpret_cast<const unsigned char*>("localhost"), -1, -1, 0);
  X509_set_issuer_name(made.get(), name);
  ASSERT_GT(X509_sign(made.get(), pair.get(), EVP_sha256()), 0);
  ASSERT_EQ(PEM_write_X509(File(std::fopen(certificate.c_str(), "w")).get(), made.get()), 1);
  ASSERT_EQ(PEM_write_PrivateKey(File(std::fopen(key.c_str(), "w")).get(), pair.get(), nullptr,
                                 nullptr, 0, nullptr, nullptr),
            1);
}

// A TLS connection; reads time out after ten seconds.
class TlsWire {
 public:
  explicit TlsWire(std::uint16_t port, int version_max = 0)
      : context_(SSL_CTX_new(TLS_client_method())) {
    if (version_max != 0) SSL_CTX_set_max_proto_version(context_.get(), version_max);
    bio_.reset(BIO_new_ssl_connect(context_.get()));
    BIO_set_conn_hostname(bio_.get(), ("127.0.0.1:" + std::to_string(port)).c_str());
    is_open_ = BIO_do_connect(bio_.get()) == 1;
    int socket = -1;
    BIO_get_fd(bio_.get(), &socket);
    const timeval limit{10, 0};
    setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
  }
  [[nodiscard]] bool is_open() const { return is_open_; }
  void send(const std::string& text) {
    ASSERT_EQ(BIO_write(bio_.get(), text.data(), static_cast<int>(text.size())),
              static_cast<int>(text.size()));
  }
  // Reads until `mark` has arrived or the server has closed.
  std::string read_until(const std::string& mark) {
    std::string text;
    char some[4096];
    while (text.find(mark) == text.npos) {
      const int size = BIO_read(bio_.get(), some, sizeof some);
      if (size <= 0) break;
      text.append(some, static_cast<std::size_t>(size));
    }
    return text;
  }

 private:
  Owned<SSL_CTX, SSL_CTX_free> context_;
  Owned<BIO, BIO_free_all> bio_;
  bool is_open_ = false;
};

class Tls : public test::RunningServer {
 protected:
  void SetUp() override {
    const fs::path folder = fs::path(::testing::TempDir()) / "armloom-tls" /
                            ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder);
    fs::create_directories(folder);
    write_certificate(folder / "c.pem", folder / "k.pem");
    options_.tls = TlsFiles{folder / "c.pem", folder / "k.pem"};
    options_.tokens = folder / "tokens";
    token_ = TokenFile(*options_.tokens).add("a", Role::operate).value();
    start(1);
  }
  std::string asking(const std::string& line, const std::string& more = "") const {
    return line + " HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer " + token_ + "\r\n" +
           more + "\r\n";
  }
  std::string token_;
};

TEST_F(Tls, ServesRequestsAndStreams) {
  TlsWire wire(port());
  ASSERT_TRUE(wire.is_open());
  for (const char* path : {"/api/v1/arms/left", "/healthz"}) {  // on one connection
    wire.send(asking(std::string("GET ") + path));
    const std::string answer = wire.read_until("}");
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 200")) << answer;
  }
  TlsWire socket(port());
  socket.send(asking("GET /api/v1/ws",
                     "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                     "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"));
  EXPECT_NE(socket.read_until("\"type\":\"state\"").find("\"type\":\"snapshot\""),
            std::string::npos);
  TlsWire events(port());
  events.send(asking("GET /api/v1/events"));
  EXPECT_NE(events.read_until("snapshot").find("data: {"), std::string::npos);
}

TEST_F(Tls, MarksTheCookieSecure) {
  TlsWire wire(port());
  const std::string body = R"({"token": ")" + token_ + "\"}";
  wire.send(asking("POST /api/v1/session", "Content-Type: application/json\r\nContent-Length: " +
                                               std::to_string(body.size()) + "\r\n") +
            body);
  EXPECT_NE(wire.read_until("; Secure").find("HttpOnly; SameSite=Strict; Secure"),
            std::string::npos);
}

// Without TLS an attacker on the network can show a page under the server's host name.
TEST_F(Tls, TreatsHttpPagesAsAnotherOrigin) {
  for (const auto& [scheme, answer] : {std::pair("http", "403"), std::pair("https", "202")}) {
    TlsWire wire(port());
    wire.send(asking("POST /api/v1/resume",
                     std::string("Content-Length: 0\r\nOrigin: ") + scheme + "://localhost\r\n"));
    EXPECT_TRUE(wire.read_until("\r\n").starts_with(std::string("HTTP/1.1 ") + answer)) << scheme;
  }
}

TEST_F(Tls, RefusesPlainAndOldClientsWithoutDelayingOthers) {
  test::Wire plain(port());
  plain.send("GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_EQ(plain.take_all().find("HTTP/1.1 200"), std::string::npos);
  EXPECT_FALSE(TlsWire(port(), TLS1_1_VERSION).is_open());
  test::Wire silent(port());
  TlsWire wire(port());
  wire.send("GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_NE(wire.read_until("ok").find("200 OK"), std::string::npos);
}

}  // namespace
}  // namespace armloom
