#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "core/base/problem.h"

namespace armloom {

// The address of a server: "http://127.0.0.1:8080", "https://cell7.example/below".
struct ServerUrl {
  bool is_tls = false;
  std::string host;    // without brackets
  std::string port;    // "80" or "443" by default
  std::string prefix;  // path below which the server is served, without a slash at the end
  [[nodiscard]] std::string authority() const;
};
// Problem (invalid): not such an address.
[[nodiscard]] Result<ServerUrl> read_server_url(const std::string& text);

struct ClientRequest {
  std::string method;
  std::string target;       // below the prefix: "/api/v1/jobs"
  std::string token = {};   // sent as a bearer token unless empty
  std::string accept = {};  // media type
  std::string body = {};    // JSON
};
struct ClientResponse {
  int status = 0;
  std::string content_type;
  std::string body;
};

// Sends a request to a server and waits for the response. Blocks the thread. With TLS, the server's
// certificate must be valid for the host; SSL_CERT_FILE names further certificates. Problem
// (unavailable): the server cannot be reached or does not answer.
[[nodiscard]] Result<ClientResponse> fetch(const ServerUrl& server, const ClientRequest& request);

// Does the same, but passes the body to `take` line by line while it arrives, until `take` returns
// false or the server ends the body. The body of the response is empty unless its status is 4xx or
// 5xx.
[[nodiscard]] Result<ClientResponse> follow(const ServerUrl& server, const ClientRequest& request,
                                            const std::function<bool(std::string_view line)>& take);

}  // namespace armloom
