#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "test/server/command_fixture.h"
#include "test/server/serve_process.h"
#include "test/server/wire.h"

namespace armloom {
namespace {

class Token : public test::CommandFixture {
 protected:
  std::string tokens() const { return (folder_ / "tokens").string(); }
  std::string serve(const std::string& more) const { return "serve --cell " + test::kCell + more; }
  std::string add(const std::string& name, const std::string& role) const {
    const auto made = run("token add --tokens " + tokens() + " --name " + name + " --role " + role);
    EXPECT_EQ(made.exit_code, 0) << made.err;
    return made.out.substr(0, made.out.find('\n'));
  }
};

TEST_F(Token, IsAddedListedAndRevoked) {
  const std::string token = add("cell-7", "operator");
  EXPECT_TRUE(token.starts_with("armloom_")) << token;
  EXPECT_EQ(token.size(), 72U);
  const auto listed = run("token list --tokens " + tokens());
  EXPECT_TRUE(listed.out.starts_with("cell-7 operator 20")) << listed.out;
  EXPECT_EQ(listed.out.find(token), listed.out.npos);
  EXPECT_EQ(run("token revoke --tokens " + tokens() + " --name cell-7").exit_code, 0);
  EXPECT_EQ(run("token list --tokens " + tokens()).out, "");
  EXPECT_EQ(run("token revoke --tokens " + tokens() + " --name cell-7").exit_code, 2);
  EXPECT_EQ(run("token add --tokens " + tokens() + " --name a --role root").exit_code, 2);
}

TEST_F(Token, FileKeepsItsPermissions) {
  namespace fs = std::filesystem;
  add("a", "viewer");
  EXPECT_EQ(fs::status(tokens()).permissions(), fs::perms{0600}) << "nobody else, unless it is let";
  fs::permissions(tokens(), fs::perms{0640});
  add("b", "viewer");
  EXPECT_EQ(fs::status(tokens()).permissions(), fs::perms{0640});
}

TEST_F(Token, IsRequiredWithTlsBeyondLoopback) {
  add("a", "viewer");
  for (const std::string& options :
       {std::string(" --listen 0.0.0.0:0"), " --listen [::]:0 --tokens " + tokens(),
        std::string(" --listen 0.0.0.0:0 --tls-certificate x --tls-key y")}) {
    const auto refused = run(serve(options));
    EXPECT_EQ(refused.exit_code, 2) << options;
    const bool has_tokens = options.find("--tokens") != options.npos;
    EXPECT_EQ(refused.err.find("armloom token add") == std::string::npos, has_tokens)
        << refused.err;
    const bool has_tls = options.find("--tls") != options.npos;
    EXPECT_EQ(refused.err.find("--tls-key") == std::string::npos, has_tls) << refused.err;
    EXPECT_NE(refused.err.find("listen on 127.0.0.1"), std::string::npos) << refused.err;
  }
  const auto half = run(serve(" --listen 127.0.0.1:0 --tls-key y"));
  EXPECT_EQ(half.exit_code, 2);
  EXPECT_NE(half.err.find("must be given together"), std::string::npos) << half.err;
  const auto none = run(serve(" --listen 127.0.0.1:0 --tokens " + tokens() + "x"));
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.err.find("cannot be read"), std::string::npos) << none.err;
  const auto bad =
      run(serve(" --listen 127.0.0.1:0 --tls-certificate " + tokens() + " --tls-key " + tokens()));
  EXPECT_EQ(bad.exit_code, 2);
  EXPECT_NE(bad.err.find("--tls-certificate"), std::string::npos) << bad.err;
  EXPECT_NE(bad.err.find("holds no certificate in PEM"), std::string::npos) << bad.err;
  const auto missing =
      run(serve(" --listen 127.0.0.1:0 --tls-certificate nowhere --tls-key " + tokens()));
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_NE(missing.err.find("nowhere cannot be read: No such file"), std::string::npos)
      << missing.err;
}

// An unset shell variable (empty value) must not open the server to everybody.
TEST_F(Token, EmptyOptionsAreRefused) {
  for (const char* option : {"--tokens", "--data", "--tls-certificate", "--allow-host"}) {
    const auto refused = run(serve(" --listen 127.0.0.1:0 " + std::string(option) + " ''"));
    EXPECT_EQ(refused.exit_code, 2) << option;
    EXPECT_NE(refused.err.find(option + std::string(": is empty")), std::string::npos)
        << refused.err;
  }
  const auto alone = run(serve(" --listen 127.0.0.1:0 --record"));
  EXPECT_EQ(alone.exit_code, 2);
  EXPECT_NE(alone.err.find("--record requires --data"), std::string::npos) << alone.err;
}

TEST_F(Token, IsRequiredOnLoopbackIfAFileIsGiven) {
  const std::string token = add("a", "viewer");
  test::ServeProcess server({"--cell", test::kCell, "--tokens", tokens()},
                            (folder_ / "log").string());
  EXPECT_EQ(test::request(server.port(), "GET", "/api/v1/arms").status, 401);
  test::Wire wire(server.port());
  wire.send("GET /api/v1/arms HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer " + token +
            "\r\n\r\n");
  EXPECT_EQ(test::read_answer(wire).status, 200);
  server.signal(SIGTERM);
  EXPECT_EQ(server.wait(), 0);
}

}  // namespace
}  // namespace armloom
