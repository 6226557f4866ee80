#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include "core/base/enumeration.h"
#include "server/access/token_file.h"
#include "server/api/route.h"
#include "test/server/running_server.h"

namespace armloom::test {

struct Answered {
  int status;
  std::string head;
};

// A server with one token for each role and one revoked token.
class TokenServer : public RunningServer {
 protected:
  void SetUp() override {
    const std::filesystem::path folder =
        std::filesystem::path(::testing::TempDir()) / "armloom-rights" /
        ::testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    file_ = folder / "tokens";
    for (const char* name : {"viewer", "operator", "admin", "revoked"}) {
      const auto role = value_named<Role>(name).value_or(Role::admin);
      tokens_[name] = TokenFile(file_).add(name, role).value();
    }
    ASSERT_TRUE(TokenFile(file_).revoke("revoked"));
    options_.tokens = file_;
    start(1);
  }
  static std::string bearer(const std::string& token) {
    return "Authorization: Bearer " + token + "\r\n";
  }
  // Returns only the header of the response, because some responses never end.
  Answered ask(const std::string& method, const std::string& path, const std::string& headers,
               const std::string& body = "", const std::string& host = "127.0.0.1") {
    Wire wire(port());
    const bool socket = path.ends_with("/ws");
    wire.send(method + " " + path + " HTTP/1.1\r\nHost: " + host + "\r\n" + headers +
              (socket ? "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
                      : "") +
              (method == "GET" ? "" : "Content-Length: " + std::to_string(body.size()) + "\r\n") +
              "\r\n" + body);
    std::string head = wire.take_until("\r\n\r\n");
    return {std::stoi(head.substr(9, 3)), std::move(head)};
  }
  Answered ask(const Route& route, const std::string& headers,
               const std::string& host = "127.0.0.1") {
    std::string path = route.path;
    for (const char* part : {"{id}", "{name}", "{file}"}) {
      if (const std::size_t at = path.find(part); at != path.npos) {
        path.replace(at, std::string(part).size(), "nothing");
      }
    }
    EXPECT_EQ(path.find('{'), path.npos) << path;
    return ask(route.method, path, headers, "", host);
  }

  std::filesystem::path file_;
  std::map<std::string, std::string> tokens_;
};

}  // namespace armloom::test
