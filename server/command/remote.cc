#include "server/command/remote.h"

#include <iostream>
#include <nlohmann/json.hpp>
#include <utility>

#include "server/command/command.h"
#include "server/http/http_client.h"
#include "server/http/message.h"
#include "server/messages/mesh_address.h"
#include "server/messages/plain_text.h"

namespace armloom {
namespace {

constexpr const char* kText = "text/plain";
constexpr const char* kJson = "application/json";

int complain_with(const std::string& text, int code) {
  std::cerr << "armloom: " << text << '\n';
  return code;
}

// The options of a command that give the members of a body, by pointer.
using OptionNames = std::vector<std::pair<std::string, std::string>>;

// Names options in place of members. `text`: one problem a line, each after its pointer.
std::string with_options(const std::string& text, const OptionNames& names) {
  std::string renamed = '\n' + text;
  for (const auto& [pointer, option] : names) {
    const std::string old = '\n' + pointer + ": ";
    for (auto at = renamed.find(old); at != std::string::npos; at = renamed.find(old, at)) {
      renamed.replace(at + 1, pointer.size(), option);
    }
  }
  return renamed.substr(1);
}

// Explains why a request failed, and returns the exit code.
int explain(const ClientResponse& response, const RemoteOptions& options,
            const OptionNames& names = {}) {
  if (response.status == 401) {
    return complain_with(
        options.token.empty()
            ? "the server asks for a token: set ARMLOOM_TOKEN to a token printed by `armloom "
              "token add`, or give it with --token"
            : "the server does not accept the token in ARMLOOM_TOKEN (or --token): it is "
              "unknown or was revoked",
        kExitBadInput);
  }
  std::string text = response.body;
  if (response.content_type.starts_with("application/problem+json")) {
    text = problem_text(Schema::parse(text));
  } else if (!response.content_type.starts_with(kText)) {
    text = "the answer, status " + std::to_string(response.status) +
           ", is not one of an armloom server: is ARMLOOM_URL (or --url) its address?";
  }
  while (text.ends_with('\n')) text.pop_back();
  return complain_with(with_options(text, names),
                       response.status < 500 ? kExitBadInput : kExitUnavailable);
}

int unreachable(const Problems& problems) {
  return complain_with(
      problems.front().detail +
          "; start it with `armloom serve`, or set ARMLOOM_URL (or --url) to its address",
      kExitUnavailable);
}

int bad_url(const Problems& problems) {
  return complain_with("ARMLOOM_URL or --url: " + problems.front().detail, kExitBadInput);
}

// Sends the request and returns the answer. If it fails, explains why and returns the exit code.
// `target` is without the prefix of the API.
tl::expected<std::string, int> answer_to(const RemoteOptions& options, const char* accept,
                                         const char* method, const std::string& target,
                                         std::string body = {}, const OptionNames& names = {}) {
  const auto server = read_server_url(options.url);
  if (!server) return tl::unexpected(bad_url(server.error()));
  auto response =
      fetch(*server, {method, kApiPrefix + target, options.token, accept, std::move(body)});
  if (!response) return tl::unexpected(unreachable(response.error()));
  if (response->status < 300) return std::move(response->body);
  if (options.json) std::cout << response->body << std::flush;
  return tl::unexpected(explain(*response, options, names));
}

int print(const std::string& text) {
  std::cout << text << std::flush;
  return std::cout ? kExitDone : kExitNotWritten;
}

// Sends the request and prints the answer.
int send(const RemoteOptions& options, const char* method, const std::string& target,
         std::string body = {}, const OptionNames& names = {}) {
  const auto answer =
      answer_to(options, options.json ? kJson : kText, method, target, std::move(body), names);
  return answer ? print(*answer) : answer.error();
}

// Resumes all arms. An arm that is not resumed is an error, as if it were named.
int resume_all(const RemoteOptions& options) {
  const auto answer = answer_to(options, kJson, "POST", "/resume");
  if (!answer) return answer.error();
  const auto resumed = Schema::parse(*answer, nullptr, false);
  const bool is_partial = resumed.is_object() && resumed.contains("not_resumed");
  const std::string text = resumed.is_object() ? stopped_text(resumed, {}) : *answer;
  if (is_partial && options.json) std::cout << *answer << std::flush;
  if (is_partial) return complain_with(text.substr(0, text.find('\n')), kExitBadInput);
  return print(options.json ? *answer : text);
}

// Sends a command to each of the arms, or to all.
int send_to_arms(const RemoteOptions& server, const std::vector<std::string>& arms,
                 const char* method, const std::string& command, const std::string& body = {}) {
  if (arms.empty()) return send(server, method, command, body);
  int code = kExitDone;
  for (const std::string& arm : arms) {
    const int one = send(server, method, "/arms/" + url_segment(arm) + command, body);
    if (code == kExitDone) code = one;
  }
  return code;
}

}  // namespace

int list_remote_jobs(const JobsOptions& options) {
  std::string query = "?limit=" + std::to_string(options.limit);
  if (!options.state.empty()) query += "&state=" + url_segment(options.state);
  if (!options.arm.empty()) query += "&arm=" + url_segment(options.arm);
  return send(options.server, "GET", "/jobs" + query);
}

int explain_job(const OneJobOptions& options) {
  return send(options.server, "GET", "/jobs/" + url_segment(options.job));
}

int cancel_remote_job(const OneJobOptions& options) {
  return send(options.server, "DELETE", "/jobs/" + url_segment(options.job));
}

int stop_remote_arms(const ArmsOptions& options) {
  return send_to_arms(options.server, options.arms, "POST",
                      "/stop?category=" + url_segment(options.category));
}
int resume_remote_arms(const ArmsOptions& options) {
  if (options.arms.empty()) return resume_all(options.server);
  return send_to_arms(options.server, options.arms, "POST", "/resume");
}

int speed_of_remote_arms(const SpeedOptions& options) {
  if (!options.share) return send_to_arms(options.server, options.arms, "GET", "/speed");
  const Schema body{{"speed_override", *options.share}};
  return send_to_arms(options.server, options.arms, "PUT", "/speed", body.dump());
}

int change_remote_faults(const FaultsOptions& options) {
  const std::string faults = "/sim/faults";
  if (options.what == FaultsOptions::What::list) return send(options.server, "GET", faults);
  if (options.what == FaultsOptions::What::remove) {
    int code = kExitDone;
    for (const std::string& id : options.ids) {
      const int one = send(options.server, "DELETE", faults + "/" + url_segment(id));
      if (code == kExitDone) code = one;
    }
    return code;
  }
  Schema body{{"arm", options.arm}, {"kind", options.kind}};
  if (options.value) body["value"] = *options.value;
  if (options.at_s) body["at_s"] = *options.at_s;
  if (options.for_s) body["for_s"] = *options.for_s;
  return send(options.server, "POST", faults, body.dump(),
              {{"/arm", "arm"},
               {"/kind", "kind"},
               {"/value", "--value"},
               {"/at_s", "--at"},
               {"/for_s", "--for"}});
}

int print_events(const EventsOptions& options) {
  const auto server = read_server_url(options.server.url);
  if (!server) return bad_url(server.error());
  std::size_t printed = 0;
  const auto print = [&](std::string_view line) {
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (!line.starts_with("data: ")) return true;
    line.remove_prefix(6);
    std::string text = std::string(line) + '\n';
    if (!options.server.json) {
      const auto message = Schema::parse(line, nullptr, false);
      text = message.is_discarded() ? text : event_text(message);
    }
    std::cout << text << std::flush;
    if (!text.empty()) ++printed;
    return std::cout && (options.count == 0 || printed < options.count);
  };
  const auto response = follow(*server,
                               {"GET", std::string(kApiPrefix) + "/events", options.server.token,
                                "text/event-stream, text/plain;q=0.5"},
                               print);
  if (!response) return unreachable(response.error());
  if (response->status >= 300) return explain(*response, options.server);
  return std::cout ? kExitDone : kExitNotWritten;
}

}  // namespace armloom
