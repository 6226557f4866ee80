// The options of `serve`, by what they are about.
#include <memory>

#include "server/command/command.h"
#include "server/command/command_line.h"

namespace armloom {
namespace {

void add_data(CLI::App& command, ServeOptions& options) {
  CLI::Option* data =
      command.add_option("--data", options.data,
                         "folder for jobs, kept when the server ends, and a recording of the run");
  command.add_option("--keep-jobs", options.keep_jobs, "with --data: so many that have ended")
      ->check(CLI::Range(0, 100'000'000))
      ->capture_default_str()
      ->needs(data);
  command
      .add_option("--keep-days", options.keep_days,
                  "with --data: those that have ended for so long at most (for ever)")
      ->check(CLI::Range(1, 36'500))
      ->needs(data);
  command
      .add_option("--keep-recordings", options.keep_recordings,
                  "with --data: so many, the running one included; the oldest go first (all)")
      ->check(CLI::Range(1, 1'000'000))
      ->needs(data);
  command
      .add_option("--keep-recording-days", options.keep_recording_days,
                  "with --data: those that were written last so long ago at most (for ever)")
      ->check(CLI::Range(1, 36'500))
      ->needs(data);
  command
      .add_option("--keep-recording-mb", options.keep_recording_mb,
                  "with --data: as many as fit, the running one included (all)")
      ->check(CLI::Range(1, 1'000'000'000))
      ->needs(data);
  command.add_flag("--record", options.record, "with --data: write states.csv, too")->needs(data);
}

void add_log(CLI::App& command, ServeOptions& options) {
  command
      .add_option("--log-format", options.log_format,
                  "of what is said on stderr: lines for people, or JSON")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  command
      .add_option("--log-requests", options.log_requests,
                  "which of them stand in the log, with their X-Request-Id")
      ->check(CLI::IsMember({"none", "commands", "all"}))
      ->capture_default_str();
}

void add_access(CLI::App& command, ServeOptions& options) {
  command.add_option("--tokens", options.tokens,
                     "file of `armloom token`: only who shows one of them is served");
  command.add_option("--tls-certificate", options.tls_certificate,
                     "PEM, with those between it and its root; with --tls-key");
  command.add_option("--tls-key", options.tls_key, "PEM");
  command
      .add_option("--allow-host", options.allowed_hosts,
                  "a name by which the server may be commanded, as behind a proxy")
      ->type_name("NAME");
  command
      .add_option("--allow-origin", options.allowed_origins,
                  "a site whose pages may command the server, as https://station.example; may be "
                  "repeated")
      ->type_name("ORIGIN");
}

void add_limits(CLI::App& command, ServeOptions& options) {
  command
      .add_option("--requests-per-second", options.requests_per_s,
                  "of one client (token or address), twice as many at once; of all together four "
                  "times as many. Stop is never limited")
      ->check(CLI::Range(0.01, 1e9))
      ->capture_default_str();
  command
      .add_option("--jobs-per-second", options.jobs_per_s,
                  "submitted by one client, ten times as many at once; by all together twice as "
                  "many")
      ->check(CLI::Range(0.01, 1e9))
      ->capture_default_str();
  command
      .add_option("--connections-per-client", options.connections_per_client,
                  "open at once from one address")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
}

}  // namespace

Command serve_command(CLI::App& app) {
  const auto options = std::make_shared<ServeOptions>();
  CLI::App* command = app.add_subcommand("serve", "run the server with simulated arms");
  command->add_option("--cell", options->cell_file, "cell file (JSON)")->required();
  command->add_option("--listen", options->listen, "ADDRESS:PORT")->capture_default_str();
  command->add_option("--speed", options->speed, "cell seconds per second")
      ->check(CLI::Range(0.001, 1000.0));
  command->add_option("--web", options->web, "folder of the dashboard's files");
  command->add_option("--policy", options->policy, "instead of the cell's");
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
