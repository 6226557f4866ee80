#include <CLI/CLI.hpp>
#include <charconv>
#include <exception>
#include <iostream>

#include "server/command/command.h"

namespace {

using namespace armloom;

void add_cell(CLI::App& command, std::string& file) {
  command.add_option("--cell", file, "cell file (JSON)")->required();
}

// The parser's own reading of an unsigned number takes -1 for the largest one.
std::string not_a_seed(const std::string& text) {
  std::uint64_t seed = 0;
  const char* end = text.data() + text.size();
  const auto [stop, ec] = std::from_chars(text.data(), end, seed);
  if (ec == std::errc{} && stop == end) return {};
  return text + " is no whole number from 0 to 18446744073709551615";
}

void add_seed(CLI::App& command, std::uint64_t& seed, const char* of = "of the arms' noise") {
  command.add_option("--seed", seed, of)->check(not_a_seed)->capture_default_str();
}

int run(int argc, char** argv) {
  CLI::App app("Armloom: an execution server for robot cells with several arms");
  app.require_subcommand(1);
  app.set_version_flag("--version", "armloom " ARMLOOM_VERSION);

  ServeOptions serving;
  CLI::App* serve_command = app.add_subcommand("serve", "run the server with simulated arms");
  add_cell(*serve_command, serving.cell_file);
  serve_command->add_option("--listen", serving.listen, "ADDRESS:PORT")->capture_default_str();
  serve_command->add_option(
      "--data", serving.data,
      "folder for jobs, kept when the server ends, and a recording of the run");
  serve_command
      ->add_option("--keep-jobs", serving.keep_jobs, "with --data: so many that have ended")
      ->check(CLI::Range(0, 100'000'000))
      ->capture_default_str();
  serve_command
      ->add_option("--keep-days", serving.keep_days,
                   "with --data: those that have ended for so long at most (for ever)")
      ->check(CLI::Range(1, 36'500));
  serve_command->add_option("--tokens", serving.tokens,
                            "file of `armloom token`: only who shows one of them is served");
  serve_command->add_option("--tls-certificate", serving.tls_certificate,
                            "PEM, with those between it and its root; with --tls-key");
  serve_command->add_option("--tls-key", serving.tls_key, "PEM");
  serve_command->add_flag("--record", serving.record, "with --data: write states.csv, too");
  serve_command->add_option("--speed", serving.speed, "cell seconds per second")
      ->check(CLI::Range(0.001, 1000.0));
  serve_command->add_option("--web", serving.web, "folder of the dashboard's files");
  serve_command->add_option("--policy", serving.policy, "instead of the cell's");
  serve_command
      ->add_option("--allow-host", serving.allowed_hosts,
                   "a name by which the server may be commanded, as behind a proxy")
      ->type_name("NAME");
  serve_command
      ->add_option("--allow-origin", serving.allowed_origins,
                   "a site whose pages may command the server, as https://station.example; may be "
                   "repeated")
      ->type_name("ORIGIN");

  serve_command
      ->add_option("--requests-per-second", serving.requests_per_s,
                   "of one client (token or address), twice as many at once; of all together four "
                   "times as many. Stop is never limited")
      ->check(CLI::Range(0.01, 1e9))
      ->capture_default_str();
  serve_command
      ->add_option("--jobs-per-second", serving.jobs_per_s,
                   "submitted by one client, ten times as many at once; by all together twice as "
                   "many")
      ->check(CLI::Range(0.01, 1e9))
      ->capture_default_str();
  serve_command
      ->add_option("--connections-per-client", serving.connections_per_client,
                   "open at once from one address")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();

  std::string validated_file;
  CLI::App* validate_command =
      app.add_subcommand("validate", "say what a cell holds, or its faults");
  add_cell(*validate_command, validated_file);

  bool markdown = false;
  bool openapi = false;
  CLI::App* schema_command =
      app.add_subcommand("schema", "print the JSON schema of cell files, as editors use it");
  schema_command->add_flag("--markdown", markdown, "the reference for people instead");
  schema_command->add_flag("--openapi", openapi, "the description of the HTTP interface instead")
      ->excludes("--markdown");

  ImportOptions importing;
  CLI::App* import_command =
      app.add_subcommand("import", "write a cell file from a robot's URDF and SRDF");
  import_command
      ->add_option("--urdf", importing.urdf, "URDF; repeated for several: one for each --robot")
      ->required()
      ->allow_extra_args(false);
  import_command
      ->add_option("--srdf", importing.srdf,
                   "SRDF; repeated, the first for the first URDF, and so on")
      ->required()
      ->allow_extra_args(false);
  import_command
      ->add_option("--joint-limits", importing.joint_limits,
                   "MoveIt's joint_limits.yaml; repeated as --urdf is")
      ->allow_extra_args(false);
  import_command
      ->add_option("--robot", importing.robots,
                   "a robot and where it stands, as left:x=-0.75,yaw_deg=90 (x, y, z in m; "
                   "roll_deg, pitch_deg, yaw_deg); may be repeated")
      ->type_name("NAME[:...]")
      ->allow_extra_args(false);
  import_command
      ->add_option("--package", importing.packages,
                   "where package://NAME/ is; else it is looked for above the URDF")
      ->type_name("NAME=FOLDER")
      ->allow_extra_args(false);
  import_command->add_option("--prefix", importing.prefix,
                             "of joints and links; several robots have their names as prefixes");
  import_command->add_option("--name", importing.name, "of the cell (that of --out)");
  import_command->add_option("--out", importing.out,
                             "cell file, with paths relative to it (stdout, with absolute ones)");

  CheckOptions checking;
  CLI::App* check_command =
      app.add_subcommand("check", "judge jobs against each other without running them");
  add_cell(*check_command, checking.cell_file);
  check_command->add_option("--jobs", checking.jobs_file, "jobs file (JSON)")->required();
  check_command->add_option("--policy", checking.policy, "instead of the cell's");

  PlanOptions planning;
  CLI::App* plan_command =
      app.add_subcommand("plan", "a job that brings an arm to a goal, all others at home");
  add_cell(*plan_command, planning.cell_file);
  plan_command->add_option("--arm", planning.arm, "which one")->required();
  plan_command
      ->add_option("--to", planning.to,
                   "a named state, or JSON: {\"joints\": [...]}, {\"pose\": {\"link\", "
                   "\"xyz\", \"rpy\"}}")
      ->required();
  plan_command->add_option("--from", planning.from,
                           "where it stands: a named state or joints (home)");
  add_seed(*plan_command, planning.seed, "of the search");
  plan_command->add_option("--out", planning.out, "file of the job, a body of POST /jobs (stdout)");

  ReachOptions reaching;
  CLI::App* reach_command = app.add_subcommand(
      "reach", "what each arm's tool reaches, and where the arms' reach overlaps");
  add_cell(*reach_command, reaching.cell_file);
  reach_command->add_option("--step", reaching.step_m, "between places of the grid, m")
      ->check(CLI::Range(0.01, 1.0))
      ->capture_default_str();
  reach_command->add_option("--link", reaching.link,
                            "the tool, with or without prefix (the link of the last joint)");
  reach_command->add_option("--picture", reaching.picture,
                            "SVG file: what is reached, from above and from the side");
  reach_command->add_flag("--json", reaching.json, "instead of tables");

  SimulateOptions simulating;
  CLI::App* simulate_command = app.add_subcommand("simulate", "run jobs on simulated time");
  add_cell(*simulate_command, simulating.cell_file);
  simulate_command->add_option("--jobs", simulating.jobs_file, "jobs file (JSON)")->required();
  simulate_command->add_option("--policy", simulating.policy, "instead of the cell's");
  add_seed(*simulate_command, simulating.seed);
  simulate_command->add_option("--out", simulating.out, "folder for the recording");
  simulate_command->add_option("--faults", simulating.faults_file, "faults file (JSON)");

  CompareOptions comparing;
  CLI::App* compare_command =
      app.add_subcommand("compare", "run the same jobs under several policies: a table");
  add_cell(*compare_command, comparing.cell_file);
  compare_command->add_option("--jobs", comparing.jobs_file, "jobs file (JSON)")->required();
  compare_command->add_option("--policies", comparing.policies, "names, a comma between (all)");
  add_seed(*compare_command, comparing.seed);
  compare_command->add_option("--out", comparing.out, "folder for compare.csv and compare.svg");

  ReplayOptions replaying;
  CLI::App* replay_command = app.add_subcommand(
      "replay", "run a recording of `serve --data` again, and compare its events");
  auto* replayed_data =
      replay_command->add_option("--data", replaying.data, "data folder: the newest run in it");
  auto* replayed_folder = replay_command->add_option("--recording", replaying.recording,
                                                     "this one instead: its folder");
  replayed_data->excludes(replayed_folder);
  replay_command->require_option(1, 0);
  replay_command->add_option("--until", replaying.until_s, "so far, in seconds of cell time (all)");
  replay_command->add_option("--out", replaying.out, "folder for the events of the replay");

  HistoryOptions reading;
  CLI::App* history_command =
      app.add_subcommand("history", "print the jobs of a data folder, one a line");
  history_command->add_option("--data", reading.data, "folder of `serve --data`")->required();
  history_command->add_option("--state", reading.state, "only those in this state");
  history_command->add_option("--arm", reading.arm, "only those that move this arm");
  history_command->add_flag("--csv", reading.csv, "as CSV instead of JSON lines");

  TokenOptions tokens;
  CLI::App* token_command =
      app.add_subcommand("token", "who may use a server that asks for tokens");
  token_command->require_subcommand(1);
  const auto add_token_command = [&](TokenOptions::What what, const char* name, const char* text) {
    CLI::App* command = token_command->add_subcommand(name, text);
    command->add_option("--tokens", tokens.file, "file of `serve --tokens`")->required();
    if (what != TokenOptions::What::list) {
      command->add_option("--name", tokens.name, "of whom or what has it")->required();
    }
    if (what == TokenOptions::What::add) {
      command->add_option("--role", tokens.role, "viewer, operator or admin")->required();
    }
    command->callback([&tokens, what] { tokens.what = what; });
  };
  add_token_command(TokenOptions::What::add, "add", "make one, which is printed this once");
  add_token_command(TokenOptions::What::list, "list", "names and roles");
  add_token_command(TokenOptions::What::withdraw, "withdraw", "it is worth nothing from now on");

  AuditOptions auditing;
  CLI::App* audit_command = app.add_subcommand("audit", "re-check a recording for contacts");
  add_cell(*audit_command, auditing.cell_file);
  audit_command->add_option("--recording", auditing.recording, "folder with states.csv")
      ->required();
  audit_command->add_option("--step", auditing.step_s, "largest step between states, in seconds")
      ->check(CLI::Range(1e-6, 10.0))
      ->capture_default_str();

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitDone : kExitBadInput;
  }
  if (serve_command->parsed()) return serve(serving);
  if (validate_command->parsed()) return validate_cell(validated_file);
  if (schema_command->parsed()) return openapi ? print_openapi() : print_cell_schema(markdown);
  if (import_command->parsed()) return import_robots(importing);
  if (check_command->parsed()) return check_jobs_file(checking);
  if (plan_command->parsed()) return plan_way(planning);
  if (reach_command->parsed()) return show_reach(reaching);
  if (simulate_command->parsed()) return simulate_jobs(simulating);
  if (compare_command->parsed()) return compare_policies(comparing);
  if (token_command->parsed()) return change_tokens(tokens);
  if (replay_command->parsed()) return replay_recording(replaying);
  if (history_command->parsed()) return print_history(reading);
  return audit_recording(auditing);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "armloom: stopped by a fault of its own: " << error.what() << '\n';
    return 70;  // EX_SOFTWARE
  }
}
