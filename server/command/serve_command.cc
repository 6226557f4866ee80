#include <memory>

#include "server/command/command.h"
#include "server/command/command_line.h"

namespace armloom {
namespace {

void add_data(CLI::App& command, ServeOptions& options) {
  CLI::Option* data = command.add_option(
      "--data", options.data,
      "folder for jobs, which survive a restart, and for a recording of each session");
  command.add_option("--keep-jobs", options.keep_jobs, "with --data: number of ended jobs to keep")
      ->check(CLI::Range(0, 100'000'000))
      ->capture_default_str()
      ->needs(data);
  command
      .add_option("--keep-days", options.keep_days,
                  "with --data: days to keep ended jobs (default: unlimited)")
      ->check(CLI::Range(1, 36'500))
      ->needs(data);
  command
      .add_option("--keep-recordings", options.keep_recordings,
                  "with --data: number of recordings to keep, the running one included (default: "
                  "unlimited)")
      ->check(CLI::Range(1, 1'000'000))
      ->needs(data);
  command
      .add_option("--keep-recording-days", options.keep_recording_days,
                  "with --data: days to keep a recording after its last write (default: unlimited)")
      ->check(CLI::Range(1, 36'500))
      ->needs(data);
  command
      .add_option("--keep-recording-mb", options.keep_recording_mb,
                  "with --data: total size of recordings in MB, the running one included (default: "
                  "unlimited)")
      ->check(CLI::Range(1, 1'000'000'000))
      ->needs(data);
  command
      .add_flag("--record", options.record,
                "with --data: also record joint positions at 1 kHz (states.csv)")
      ->needs(data);
}

void add_log(CLI::App& command, ServeOptions& options) {
  command
      .add_option("--log-format", options.log_format,
                  "format of the log on stderr: text, or one JSON object per line")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  command
      .add_option("--log-requests", options.log_requests,
                  "requests to log, with their X-Request-Id")
      ->check(CLI::IsMember({"none", "commands", "all"}))
      ->capture_default_str();
}

void add_access(CLI::App& command, ServeOptions& options) {
  command.add_option("--tokens", options.tokens,
                     "token file of `armloom token`; requests without a valid token are refused");
  command.add_option("--tls-certificate", options.tls_certificate,
                     "TLS certificate chain (PEM); requires --tls-key");
  command.add_option("--tls-key", options.tls_key, "private key of the certificate (PEM)");
  command
      .add_option("--allow-host", options.allowed_hosts,
                  "host name by which clients reach the server, for example the name of a proxy; "
                  "may be repeated")
      ->type_name("NAME");
  command
      .add_option("--allow-origin", options.allowed_origins,
                  "origin whose pages may use the server, for example https://station.example; may "
                  "be repeated")
      ->type_name("ORIGIN");
}

void add_limits(CLI::App& command, ServeOptions& options) {
  command
      .add_option("--requests-per-second", options.requests_per_s,
                  "request rate of one client (token or address); bursts of twice as many; all "
                  "clients together: four times. Stop requests are never limited")
      ->check(CLI::Range(0.01, 1e9))
      ->capture_default_str();
  command
      .add_option(
          "--jobs-per-second", options.jobs_per_s,
          "job rate of one client; bursts of ten times as many; all clients together: twice")
      ->check(CLI::Range(0.01, 1e9))
      ->capture_default_str();
  command
      .add_option("--connections-per-client", options.connections_per_client,
                  "open connections per address")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
}

}  // namespace

Command serve_command(CLI::App& app) {
  const auto options = std::make_shared<ServeOptions>();
  CLI::App* command = app.add_subcommand(
      "serve", "run the server; it moves simulated arms, and robots in other processes");
  command->add_option("--cell", options->cell_file, "cell file (JSON)")->required();
  command->add_option("--listen", options->listen, "ADDRESS:PORT to listen on")
      ->capture_default_str();
  command->add_option("--speed", options->speed, "seconds of cell time per second")
      ->check(CLI::Range(0.001, 1000.0));
  command->add_option("--web", options->web, "folder of the dashboard's files");
  command->add_option("--policy", options->policy, "policy to use instead of the cell's");
  command
      ->add_option("--jog-lease", options->jog_lease_s,
                   "seconds after which a jogged arm brakes if the client does not renew its lease")
      ->check(CLI::Range(0.05, 10.0))
      ->capture_default_str();
  add_data(*command, *options);
  add_log(*command, *options);
  add_access(*command, *options);
  add_limits(*command, *options);
  return {command, [options] { return serve(*options); }};
}

}  // namespace armloom
