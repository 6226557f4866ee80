#include <spdlog/async.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <csignal>
#include <iostream>

#include "server/access/token_file.h"
#include "server/command/command.h"
#include "server/drivers/remote_controller.h"
#include "server/http/framing.h"
#include "server/http/http_server.h"
#include "server/log/log_line.h"
#include "server/service/service.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;

// Parses "127.0.0.1:8080" or "[::1]:8080".
bool parse_listen(const std::string& text, std::string& address, std::uint16_t& port) {
  const std::size_t colon = text.rfind(':');
  if (colon == text.npos || colon == 0) return false;
  address = text.substr(0, colon);
  if (address.front() == '[' && address.back() == ']')
    address = address.substr(1, address.size() - 2);
  const char* end = text.data() + text.size();
  const auto [stop, ec] = std::from_chars(text.data() + colon + 1, end, port);
  return ec == std::errc{} && stop == end;
}

// Returns the folder of the dashboard's files: `asked` if given, else web/dist of the repository,
// the installed folder, or `web` next to the binary.
fs::path web_folder(const std::string& asked) {
  if (!asked.empty()) return asked;
  std::error_code ec;
  const fs::path folder = fs::read_symlink("/proc/self/exe", ec).parent_path();
  for (const fs::path& candidate : {folder.parent_path() / "web" / "dist",
                                    folder.parent_path() / "share" / "armloom" / "web"}) {
    if (fs::is_directory(candidate, ec)) return candidate;
  }
  return folder / "web";
}

// Raises the limit of file descriptors to its maximum. Returns the number of connections that it
// allows, at most `wanted`.
std::size_t connections_within_descriptors(std::size_t wanted) {
  // Descriptors that are not for connections: 64 for files and 64 for the reserve of HttpServer. If
  // the limit is low, half of it.
  constexpr rlim_t kOther = 128;
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return wanted;
  limit.rlim_cur = limit.rlim_max;
  setrlimit(RLIMIT_NOFILE, &limit);
  getrlimit(RLIMIT_NOFILE, &limit);
  if (limit.rlim_cur == RLIM_INFINITY || limit.rlim_cur >= wanted + kOther) return wanted;
  return static_cast<std::size_t>(limit.rlim_cur - std::min<rlim_t>(kOther, limit.rlim_cur / 2));
}

void limit_clients(const ServeOptions& options, ServiceOptions& service) {
  const double requests = options.requests_per_s, jobs = options.jobs_per_s;
  service.limits = {.requests = {requests, 2 * requests},
                    .requests_of_all = {4 * requests, 8 * requests},
                    .jobs = {jobs, 10 * jobs},
                    .jobs_of_all = {2 * jobs, 20 * jobs}};
  service.connections_per_client_max = options.connections_per_client;
}

// Adds faults of the options for tokens and TLS. An address that other machines can reach requires
// tokens, and TLS to protect them.
void find_faults_of_access(const ServeOptions& options, const std::string& address,
                           const Result<std::vector<KeptToken>>& tokens, Problems& problems) {
  if (options.tls_certificate.empty() != options.tls_key.empty()) {
    problems.push_back(Problem{ProblemKind::invalid, "half-of-tls", "--tls-key",
                               "--tls-certificate and --tls-key must be given together"});
  }
  const bool asks = !options.tokens.empty(), is_sealed = !options.tls_certificate.empty();
  if (reach_of(address) == AddressReach::others && !(asks && is_sealed)) {
    const std::string danger = asks ? "tokens sent to " + address + " could be read on the network"
                                    : "everybody who can reach " + address + " could move the arms";
    const std::string how =
        "--tokens FILE (create it with `armloom token add --tokens FILE --name NAME --role "
        "operator`)";
    problems.push_back(Problem{ProblemKind::invalid, "open-to-others", "--listen",
                               danger + ": give " + (asks ? "" : how) +
                                   (asks || is_sealed ? "" : ", ") +
                                   (is_sealed ? "" : "--tls-certificate and --tls-key") +
                                   "; or listen on 127.0.0.1 behind a proxy or a tunnel",
                               address});
  }
  if (!tokens) problems.insert(problems.end(), tokens.error().begin(), tokens.error().end());
}

// Robots in other processes run in real time.
void find_faults_of_speed(const ServeOptions& options, const Cell& cell, Problems& problems) {
  const std::vector<std::string> remote = remote_robots(cell);
  if (options.speed == 1.0 || remote.empty()) return;
  problems.push_back(Problem{ProblemKind::invalid, "speed-of-remote-robot", "--speed",
                             "robot " + remote.front() +
                                 " has a remote controller, which runs in real time: leave the "
                                 "option out, or simulate the robot (controller type sim)",
                             options.speed});
}

std::string dashboard_address(const std::string& scheme, const std::string& address,
                              std::uint16_t port) {
  const bool v6 = address.find(':') != address.npos;
  return scheme + "://" + (v6 ? "[" + address + "]" : address) + ":" + std::to_string(port) + "/";
}

// Returns faults of the options. They are reported before the server listens.
Problems faults_of(const ServeOptions& options) {
  Problems problems;
  std::error_code ec;
  if (!options.web.empty() && !fs::is_directory(options.web, ec)) {
    problems.push_back(Problem{ProblemKind::not_found, "no-folder", "--web",
                               "no such folder: " + options.web, options.web});
  }
  for (const std::string& name : options.allowed_hosts) {
    if (valid_authority(name) && name.find(':') == name.npos) continue;
    problems.push_back(Problem{ProblemKind::invalid, "bad-name", "--allow-host",
                               "expected a host name without a port", name});
  }
  for (const std::string& origin : options.allowed_origins) {
    const std::size_t scheme = origin.find("://");
    const bool is_web = origin.starts_with("http://") || origin.starts_with("https://");
    if (is_web && valid_authority(origin.substr(scheme + 3))) continue;
    problems.push_back(Problem{ProblemKind::invalid, "bad-origin", "--allow-origin",
                               "expected an origin, for example https://station.example:8443",
                               origin});
  }
  return problems;
}

// Returns a log that writes on a thread of its own, so that a slow stderr reader never blocks the
// server. If more than kLinesMax lines wait, the oldest are lost.
Log log_of(const std::string& format) {
  constexpr std::size_t kLinesMax = 8192;
  spdlog::init_thread_pool(kLinesMax, 1);
  const auto logger = spdlog::create_async_nb<spdlog::sinks::stderr_color_sink_mt>("armloom");
  spdlog::set_default_logger(logger);
  const bool is_json = format == "json";
  if (is_json) logger->set_pattern("%v");
  return [logger, is_json](const LogLine& line) {
    const auto level = line.level == LogLine::Level::error     ? spdlog::level::err
                       : line.level == LogLine::Level::warning ? spdlog::level::warn
                                                               : spdlog::level::info;
    logger->log(level, "{}",
                is_json ? json_of(line, std::chrono::system_clock::now()) : text_of(line));
  };
}

LoggedRequests logged_requests(const std::string& which) {
  if (which == "all") return LoggedRequests::all;
  return which == "commands" ? LoggedRequests::commands : LoggedRequests::none;
}

RecordingBounds recording_bounds(const ServeOptions& options) {
  RecordingBounds bounds;
  if (options.keep_recordings > 0) bounds.count = options.keep_recordings;
  if (options.keep_recording_days > 0) bounds.age = std::chrono::days(options.keep_recording_days);
  if (options.keep_recording_mb > 0) bounds.bytes = options.keep_recording_mb * 1'000'000;
  return bounds;
}

// Flushes the log before the process ends.
struct LogEnds {
  ~LogEnds() { spdlog::shutdown(); }
};

}  // namespace

int serve(const ServeOptions& options) {
  const LogEnds log_ends;
  const Log log = log_of(options.log_format);
  const auto loaded = load_cell(options.cell_file);
  if (!loaded) return kExitBadInput;
  ServiceOptions service_options;
  if (!parse_listen(options.listen, service_options.address, service_options.port)) {
    complain("", {Problem{ProblemKind::invalid, "bad-address", "--listen",
                          "expected ADDRESS:PORT, for example 127.0.0.1:8080 for this machine only",
                          options.listen}});
    return kExitBadInput;
  }
  Problems faults = faults_of(options);
  find_faults_of_speed(options, *loaded->cell, faults);
  const auto tokens =
      options.tokens.empty() ? Result<std::vector<KeptToken>>() : TokenFile(options.tokens).read();
  find_faults_of_access(options, service_options.address, tokens, faults);
  if (const Problems& problems = faults; !problems.empty()) {
    complain("", problems);
    return kExitBadInput;
  }
  if (!options.tokens.empty()) service_options.tokens = options.tokens;
  if (!options.tls_key.empty()) {
    service_options.tls = TlsFiles{options.tls_certificate, options.tls_key};
  }
  service_options.allowed_origins = options.allowed_origins;
  service_options.allowed_hosts = options.allowed_hosts;
  service_options.speed = options.speed;
  service_options.policy = options.policy;
  service_options.web = web_folder(options.web);
  (void)umask(umask(0) | S_IRWXO);  // other users must not read the audit log
  if (!options.data.empty()) service_options.data = options.data;
  service_options.record_states = options.record;
  service_options.store.retention.jobs_max = options.keep_jobs;
  if (options.keep_days > 0) {
    service_options.store.retention.age_max = std::chrono::days(options.keep_days);
  }
  service_options.connections_max = connections_within_descriptors(service_options.connections_max);
  limit_clients(options, service_options);
  service_options.log = log;
  service_options.jog_lease = std::chrono::milliseconds(std::lround(1e3 * options.jog_lease_s));
  service_options.logged_requests = logged_requests(options.log_requests);
  service_options.kept_recordings = recording_bounds(options);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a write beyond the file size limit then fails with an error

  auto service = Service::start(loaded->cell, {loaded->file, loaded->text}, service_options);
  if (!service) {
    Problems problems = said_of_option(std::move(service.error()), "cannot-write", "--data");
    if (!options.policy.empty()) {
      problems = said_of_option(std::move(problems), "unknown-policy", "--policy");
    }
    complain(options.cell_file, problems);
    return kExitBadInput;
  }
  log({LogLine::Level::info,
       "serving",
       {{"cell", loaded->cell->name},
        {"arms", static_cast<std::int64_t>(loaded->cell->arms.size())},
        {"policy", options.policy.empty() ? loaded->cell->scheduling.policy : options.policy},
        {"speed", options.speed}}});
  if (service_options.tokens && tokens->empty()) {
    log({LogLine::Level::warning,
         "the token file has no token, so all requests are refused: create one with `armloom token "
         "add`",
         {{"tokens", service_options.tokens->string()}}});
  }
  if (const auto folder = (*service)->recorded_to()) {
    log({LogLine::Level::info, "recording", {{"folder", folder->string()}}});
  }
  std::cout << "dashboard: "
            << dashboard_address(service_options.tls ? "https" : "http", service_options.address,
                                 (*service)->port())
            << std::endl;
  (*service)->run(true);
  const auto lost = (*service)->close();
  if (lost) log({LogLine::Level::error, "not everything was written: " + *lost});
  log({LogLine::Level::info, "stopped"});
  return lost ? kExitNotWritten : kExitDone;
}

}  // namespace armloom
