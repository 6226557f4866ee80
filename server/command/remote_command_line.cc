// Commands for a running server.
#include <memory>
#include <string>

#include "server/command/command_line.h"
#include "server/command/remote.h"

namespace armloom {
namespace {

void add_server(CLI::App& command, RemoteOptions& options) {
  command.add_option("--url", options.url, "address of the server")
      ->envname("ARMLOOM_URL")
      ->capture_default_str();
  command
      .add_option("--token", options.token,
                  "access token; prefer ARMLOOM_TOKEN, because other users see command lines")
      ->envname("ARMLOOM_TOKEN");
  command.add_flag("--json", options.json, "print the server's answer as it is");
}

Command jobs_command(CLI::App& app) {
  const auto options = std::make_shared<JobsOptions>();
  CLI::App* command = app.add_subcommand("jobs", "list the jobs of a running server, newest first");
  add_server(*command, options->server);
  command->add_option("--state", options->state, "list only jobs in this state")
      ->check(CLI::IsMember(job_states()));
  command->add_option("--arm", options->arm, "list only jobs that move this arm");
  command->add_option("--limit", options->limit, "number of jobs")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  return {command, [options] { return list_remote_jobs(*options); }};
}

Command why_command(CLI::App& app) {
  const auto options = std::make_shared<OneJobOptions>();
  CLI::App* command = app.add_subcommand(
      "why", "explain a job of a running server: state, what it waits for, how it will end");
  command->add_option("job", options->job, "id of the job")->required();
  add_server(*command, options->server);
  return {command, [options] { return explain_job(*options); }};
}

Command cancel_command(CLI::App& app) {
  const auto options = std::make_shared<OneJobOptions>();
  CLI::App* command = app.add_subcommand("cancel", "cancel a job of a running server");
  command->add_option("job", options->job, "id of the job")->required();
  add_server(*command, options->server);
  return {command, [options] { return cancel_remote_job(*options); }};
}

Command resume_command(CLI::App& app) {
  const auto options = std::make_shared<ArmsOptions>();
  CLI::App* command = app.add_subcommand("resume", "resume stopped arms of a running server");
  command->add_option("arms", options->arms, "arms to resume (default: all)");
  add_server(*command, options->server);
  return {command, [options] { return resume_remote_arms(*options); }};
}

Command stop_command(CLI::App& app) {
  const auto options = std::make_shared<ArmsOptions>();
  CLI::App* command = app.add_subcommand(
      "stop", "stop arms of a running server (an operational stop, no emergency stop)");
  command->add_option("arms", options->arms, "arms to stop (default: all)");
  command
      ->add_option(
          "--category", options->category,
          "2: brake, then hold (default); 1: brake, then drives off; 0: drives off at once, "
          "and the arms leave their paths. With any other value the arms are stopped with 2")
      ->type_name("CATEGORY");
  add_server(*command, options->server);
  return {command, [options] { return stop_remote_arms(*options); }};
}

Command speed_command(CLI::App& app) {
  const auto options = std::make_shared<SpeedOptions>();
  CLI::App* command = app.add_subcommand(
      "speed",
      "set or print the speed override of a running server (not the time of a simulation)");
  command->add_option("override", options->share,
                      "largest share of the planned speed: 0, or 0.001 to 1 (default: print it)");
  command->add_option("arms,--arm", options->arms,
                      "arms to set, or with --arm also to print (default: the cell)");
  add_server(*command, options->server);
  return {command, [options] { return speed_of_remote_arms(*options); }};
}

Command events_command(CLI::App& app) {
  const auto options = std::make_shared<EventsOptions>();
  CLI::App* command = app.add_subcommand("events", "print the events of a running server");
  add_server(*command, options->server);
  command->add_option("--count", options->count, "end after this many events (default: never)");
  return {command, [options] { return print_events(*options); }};
}

// `armloom faults`, `faults list`, `faults add`, `faults remove`.
Command faults_command(CLI::App& app) {
  const auto options = std::make_shared<FaultsOptions>();
  CLI::App* command = app.add_subcommand(
      "faults", "list, add or remove faults of a running server's simulated arms (default: list)");
  command->require_subcommand(0, 1);
  add_server(*command, options->server);
  const auto add = [&](FaultsOptions::What what, const char* name, const char* text) {
    CLI::App* one = command->add_subcommand(name, text);
    one->fallthrough();  // to the options of the server
    one->callback([options, what] { options->what = what; });
    return one;
  };
  add(FaultsOptions::What::list, "list", "list the faults that are not over");
  CLI::App* added = add(FaultsOptions::What::add, "add", "add a fault, and print it");
  added->add_option("arm", options->arm, "simulated arm")->required();
  added->add_option("kind", options->kind, "kind of fault, for example stall")->required();
  added->add_option("--value", options->value, "value, for example the share of the speed");
  added->add_option("--at", options->at_s, "start in seconds of cell time (default: now)");
  added->add_option("--for", options->for_s, "duration in seconds (default: until it is removed)");
  CLI::App* removed = add(FaultsOptions::What::remove, "remove", "remove faults");
  removed->add_option("ids", options->ids, "ids of the faults")->required();
  return {command, [options] { return change_remote_faults(*options); }};
}

}  // namespace

std::vector<Command> remote_commands(CLI::App& app) {
  return {jobs_command(app),  why_command(app),    stop_command(app),   resume_command(app),
          speed_command(app), faults_command(app), cancel_command(app), events_command(app)};
}

}  // namespace armloom
