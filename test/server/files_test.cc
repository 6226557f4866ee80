#include <gtest/gtest.h>

#include <fstream>

#include "server/http/open_file.h"
#include "server/http/static_files.h"
#include "test/server/running_server.h"
#include "test/server/unpacked.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;

Response plain_refusal(const Refusal& refusal) { return {refusal.status, "", refusal.slug}; }

Request get_of(const std::string& path, const std::string& accept = "") {
  Request request;
  request.method = "GET";
  request.target.path = path;
  request.accept_encoding = accept;
  return request;
}

std::string header(const Response& response, const std::string& name) {
  for (const auto& [found, value] : response.headers) {
    if (found == name) return value;
  }
  return "";
}

class Files : public test::RunningServer {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) / "armloom-files" /
              ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "dist/assets");
    write("dist/index.html", "<html>");
    for (int i = 0; i < 2000; ++i) script_ += "call_number(" + std::to_string(i) + ");\n";
    write("dist/assets/app.js", script_);
    write("dist/assets/font.woff2", std::string(5000, 'w'));
  }
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }
  test::Answer ask(const std::string& method, const std::string& target,
                   const std::string& fields) {
    test::Wire wire(port());
    wire.send(method + " " + target + " HTTP/1.1\r\nHost: localhost\r\n" + fields + "\r\n");
    return test::read_answer(wire, method == "HEAD");
  }

  fs::path folder_;
  std::string script_;
};

TEST_F(Files, AreSharedInMemory) {
  StaticFiles files(folder_ / "dist", plain_refusal);
  const Response one = files.answer(get_of("/assets/app.js"));
  const Response other = files.answer(get_of("/assets/app.js"));
  ASSERT_TRUE(one.shared);
  EXPECT_EQ(one.shared, other.shared);
  EXPECT_EQ(*one.shared, script_);
  EXPECT_EQ(files.answer(get_of("/assets/app.js", "gzip")).shared,
            files.answer(get_of("/assets/app.js", "br, gzip;q=0.5")).shared);
}

TEST_F(Files, AreReadAgainWhenTheyHaveChanged) {
  StaticFiles files(folder_ / "dist", plain_refusal);
  const std::string before = header(files.answer(get_of("/")), "ETag");
  write("dist/index.html", "<html>another");
  const Response after = files.answer(get_of("/"));
  EXPECT_EQ(*after.shared, "<html>another");
  EXPECT_NE(header(after, "ETag"), before);
}

TEST_F(Files, AreCompressedOnRequest) {
  start(1.0, folder_ / "dist");
  const auto packed = ask("GET", "/assets/app.js", "Accept-Encoding: br, gzip\r\n");
  EXPECT_EQ(packed.headers.at("content-encoding"), "gzip");
  EXPECT_EQ(packed.headers.at("vary"), "Accept-Encoding");
  EXPECT_LT(packed.body.size(), script_.size() / 3);
  EXPECT_EQ(test::unpacked(packed.body), script_);
  for (const char* fields : {"", "Accept-Encoding: gzip;q=0\r\n", "Accept-Encoding: *;q=0.0\r\n",
                             "Accept-Encoding: br\r\nAccept-Encoding: deflate\r\n"}) {
    const auto plain = ask("GET", "/assets/app.js", fields);
    EXPECT_EQ(plain.body, script_) << fields;
    EXPECT_EQ(plain.headers.count("content-encoding"), 0U) << fields;
    EXPECT_EQ(plain.headers.at("vary"), "Accept-Encoding") << fields;
    EXPECT_NE(plain.headers.at("etag"), packed.headers.at("etag"));
  }
  const auto font = ask("GET", "/assets/font.woff2", "Accept-Encoding: gzip\r\n");
  EXPECT_EQ(font.headers.count("content-encoding"), 0U);
  const auto head = ask("HEAD", "/assets/app.js", "Accept-Encoding: gzip\r\n");
  EXPECT_EQ(head.headers.at("content-length"), std::to_string(packed.body.size()));
}

TEST_F(Files, AreNotSentAgainIfTheETagMatches) {
  start(1.0, folder_ / "dist");
  for (const char* target : {"/", "/openapi.json", "/docs", "/cell.schema.json"}) {
    const std::string tag = ask("GET", target, "").headers.at("etag");
    for (const std::string& fields : {"If-None-Match: " + tag, "If-None-Match: \"x\", W/" + tag,
                                      std::string("If-None-Match: *")}) {
      test::Wire wire(port());
      wire.send(std::string("GET ") + target + " HTTP/1.1\r\nHost: localhost\r\n" + fields +
                "\r\n\r\nGET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
      const std::string all = wire.take_all();
      EXPECT_TRUE(all.starts_with("HTTP/1.1 304 Not Modified\r\n")) << all;
      const std::string first = all.substr(0, all.find("\r\n\r\n"));
      EXPECT_NE(first.find("ETag: " + tag), std::string::npos) << first;
      EXPECT_NE(first.find("Cache-Control: "), std::string::npos) << first;
      EXPECT_EQ(first.find("Content-Length"), std::string::npos) << first;
      // no body in between
      EXPECT_NE(all.find("\r\n\r\nHTTP/1.1 200 OK"), std::string::npos) << all;
    }
    EXPECT_EQ(ask("GET", target, "If-None-Match: \"other\"\r\n").status, 200);
  }
}

TEST_F(Files, AreNotServedThroughSymlinks) {
  write("secret", "secret");
  fs::create_symlink(folder_ / "secret", folder_ / "dist/link");
  fs::create_directory_symlink(folder_, folder_ / "dist/up");
  StaticFiles files(folder_ / "dist", plain_refusal);
  for (const char* path : {"/link", "/up/secret", "/up/dist/.hidden"}) {
    EXPECT_EQ(files.answer(get_of(path)).status, 404) << path;
  }
  const auto open = OpenFile::open(folder_ / "dist/link", 1000);
  ASSERT_TRUE(open);
  EXPECT_EQ(open->place(), fs::canonical(folder_ / "secret"));
  EXPECT_EQ(OpenFile::open(folder_ / "secret", 5).error(), NoFile::absent);
  EXPECT_EQ(OpenFile::open(folder_ / "dist", 5).error(), NoFile::absent);
}

}  // namespace
}  // namespace armloom
