#include "server/command/command_line.h"

#include <charconv>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "core/base/enumeration.h"
#include "core/executive/plan_task.h"
#include "server/command/command.h"

namespace armloom {
namespace {

void add_cell(CLI::App& command, std::string& file) {
  command.add_option("--cell", file, "cell file (JSON)")->required();
}

void add_jobs(CLI::App& command, std::string& file) {
  command.add_option("--jobs", file, "jobs file (JSON)")->required();
}

void add_policy(CLI::App& command, std::string& policy) {
  command.add_option("--policy", policy, "policy to use instead of the cell's");
}

// Checks a seed, because the parser would accept -1 as the largest unsigned number.
std::string not_a_seed(const std::string& text) {
  std::uint64_t seed = 0;
  const char* end = text.data() + text.size();
  const auto [stop, ec] = std::from_chars(text.data(), end, seed);
  if (ec == std::errc{} && stop == end) return {};
  return text + " is not an integer from 0 to 18446744073709551615";
}

void add_seed(CLI::App& command, std::uint64_t& seed,
              const char* of = "seed of the simulated arms' noise") {
  command.add_option("--seed", seed, of)->check(not_a_seed)->capture_default_str();
}

void add_verbose(CLI::App& command, bool& verbose) {
  command.add_flag("--verbose", verbose,
                   "print every fault and warning, not one line for each kind");
}

Command validate_command(CLI::App& app) {
  struct Options {
    std::string file;
    bool verbose = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("validate", "print what a cell contains, or all of its faults");
  add_cell(*command, options->file);
  add_verbose(*command, options->verbose);
  return {command, [options] { return validate_cell(options->file, options->verbose); }};
}

Command schema_command(CLI::App& app) {
  struct What {
    bool markdown = false;
    bool openapi = false;
  };
  const auto what = std::make_shared<What>();
  CLI::App* command =
      app.add_subcommand("schema", "print the JSON schema of cell files, for editors");
  command->add_flag("--markdown", what->markdown, "print the reference as Markdown instead");
  command
      ->add_flag("--openapi", what->openapi, "print the OpenAPI document of the HTTP API instead")
      ->excludes("--markdown");
  return {command,
          [what] { return what->openapi ? print_openapi() : print_cell_schema(what->markdown); }};
}

Command import_command(CLI::App& app) {
  const auto options = std::make_shared<ImportOptions>();
  CLI::App* command =
      app.add_subcommand("import", "write a cell file from a robot's URDF and SRDF");
  command
      ->add_option("--urdf", options->urdf, "URDF file; repeat for several robots, one per --robot")
      ->required()
      ->allow_extra_args(false);
  command->add_option("--srdf", options->srdf, "SRDF file; one for each --urdf, in the same order")
      ->required()
      ->allow_extra_args(false);
  command
      ->add_option("--joint-limits", options->joint_limits,
                   "MoveIt's joint_limits.yaml; none, or one for each --urdf, in the same order")
      ->allow_extra_args(false);
  command
      ->add_option("--robot", options->robots,
                   "name and base pose of a robot, for example left:x=-0.75,yaw_deg=90 (x, y, z in "
                   "m; roll_deg, pitch_deg, yaw_deg); may be repeated")
      ->type_name("NAME[:...]")
      ->allow_extra_args(false);
  command
      ->add_option("--package", options->packages,
                   "folder of the meshes at package://NAME/... or file:///.../NAME/... (default: "
                   "searched above the URDF); may be repeated")
      ->type_name("NAME=FOLDER")
      ->allow_extra_args(false);
  command->add_option(
      "--prefix", options->prefix,
      "prefix of joints and links of a single robot; several robots use their names");
  command
      ->add_option("--srdf-prefix", options->srdf_prefixes,
                   "prefix of the URDF's names that the names in the SRDF lack, for example ur_; "
                   "one for all --urdf, or one for each (\"\": none)")
      ->type_name("PREFIX")
      ->allow_extra_args(false);
  command
      ->add_option("--joint-limits-prefix", options->joint_limits_prefixes,
                   "the same for --joint-limits")
      ->type_name("PREFIX")
      ->allow_extra_args(false);
  add_verbose(*command, options->verbose);
  command->add_option("--name", options->name,
                      "name of the cell (default: name of the --out file)");
  command->add_option(
      "--out", options->out,
      "cell file to write, with paths relative to it (default: stdout, with absolute paths)");
  return {command, [options] { return import_robots(*options); }};
}

Command check_command(CLI::App& app) {
  const auto options = std::make_shared<CheckOptions>();
  CLI::App* command =
      app.add_subcommand("check", "check jobs against each other without running them");
  add_cell(*command, options->cell_file);
  add_jobs(*command, options->jobs_file);
  add_policy(*command, options->policy);
  return {command, [options] { return check_jobs_file(*options); }};
}

Command plan_command(CLI::App& app) {
  const auto options = std::make_shared<PlanOptions>();
  CLI::App* command =
      app.add_subcommand("plan", "plan a job that moves an arm to a goal, all other arms at home");
  add_cell(*command, options->cell_file);
  auto* which = command->add_option_group("arm to move");
  which->add_option("--arm", options->arm, "arm to move");
  which
      ->add_option("--arms", options->arms,
                   "candidate arms, for example left,right; the fastest one moves")
      ->delimiter(',');
  which->require_option(1);
  command
      ->add_option("--to", options->to,
                   "goal: a named state, or JSON: {\"joints\": [...]}, {\"pose\": {\"link\", "
                   "\"xyz\", \"rpy\"}}")
      ->required();
  command->add_option("--from", options->from, "start: a named state or joints (default: home)");
  add_seed(*command, options->seed, "seed of the search");
  command
      ->add_option("--budget", options->budget,
                   "maximum number of evaluations of the search, for each arm (default: 400000)")
      ->check(CLI::Range(1, kPlanBudgetMax));
  command->add_option("--out", options->out,
                      "file to write the job to, a body of POST /jobs (default: stdout)");
  return {command, [options] { return plan_way(*options); }};
}

Command reach_command(CLI::App& app) {
  const auto options = std::make_shared<ReachOptions>();
  CLI::App* command = app.add_subcommand(
      "reach", "print what each arm's tool reaches, and where the arms' reach overlaps");
  add_cell(*command, options->cell_file);
  command->add_option("--step", options->step_m, "spacing of the grid in m")
      ->check(CLI::Range(0.01, 1.0))
      ->capture_default_str();
  command->add_option("--link", options->link,
                      "tool link, with or without prefix (default: link of the last joint)");
  command->add_option("--picture", options->picture,
                      "SVG file to write: reach seen from above and from the side");
  command->add_flag("--json", options->json, "print JSON instead of tables");
  return {command, [options] { return show_reach(*options); }};
}

Command simulate_command(CLI::App& app) {
  const auto options = std::make_shared<SimulateOptions>();
  CLI::App* command =
      app.add_subcommand("simulate", "simulate a jobs file as fast as the machine allows");
  add_cell(*command, options->cell_file);
  add_jobs(*command, options->jobs_file);
  add_policy(*command, options->policy);
  add_seed(*command, options->seed);
  command->add_option("--out", options->out, "folder to write the recording to");
  command->add_option("--faults", options->faults_file, "faults file (JSON)");
  return {command, [options] { return simulate_jobs(*options); }};
}

Command compare_command(CLI::App& app) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* command = app.add_subcommand(
      "compare", "simulate the same jobs under several policies and print a table");
  add_cell(*command, options->cell_file);
  add_jobs(*command, options->jobs_file);
  command->add_option("--policies", options->policies,
                      "policies to compare, separated by commas (default: all)");
  add_seed(*command, options->seed);
  command->add_option("--out", options->out, "folder to write compare.csv and compare.svg to");
  return {command, [options] { return compare_policies(*options); }};
}

Command arm_command(CLI::App& app) {
  const auto options = std::make_shared<ArmOptions>();
  CLI::App* command = app.add_subcommand(
      "arm", "run the simulated arms of one robot as a process that `armloom serve` connects to");
  add_cell(*command, options->cell_file);
  command->add_option("--robot", options->robot, "robot of the cell file")->required();
  CLI::Option* listen =
      command->add_option("--listen", options->listen,
                          "address at which the server connects: unix:PATH or tcp:ADDRESS:PORT");
  command
      ->add_flag("--hello", options->hello,
                 "print the server's first message to this robot, for tests of a driver")
      ->excludes(listen);
  CLI::Option* physics = command->add_flag("--physics", options->physics,
                                           "simulate masses, drives, brakes and contacts (MuJoCo)");
  command
      ->add_option("--payload", options->payload,
                   "with --physics: LINK=KG, a mass at a link that the drives do not know")
      ->needs(physics);
  add_seed(*command, options->seed);
  command->final_callback([options] {
    if (options->listen.empty() && !options->hello) {
      throw CLI::RequiredError("--listen");
    }
  });
  return {command, [options] { return run_arm(*options); }};
}

Command replay_command(CLI::App& app) {
  const auto options = std::make_shared<ReplayOptions>();
  CLI::App* command =
      app.add_subcommand("replay", "replay a recording of `serve --data` and compare its events");
  auto* replayed_data =
      command->add_option("--data", options->data, "data folder; replays its newest recording");
  auto* replayed_folder =
      command->add_option("--recording", options->recording, "folder of the recording to replay");
  replayed_data->excludes(replayed_folder);
  command->require_option(1, 0);
  command
      ->add_option("--until", options->until_s,
                   "end of the replay in seconds of cell time (default: end of the recording)")
      ->check(CLI::Range(0.0, 1e9));
  command->add_option("--out", options->out, "folder to write the replayed events to");
  return {command, [options] { return replay_recording(*options); }};
}

Command history_command(CLI::App& app) {
  const auto options = std::make_shared<HistoryOptions>();
  CLI::App* command =
      app.add_subcommand("history", "print the jobs of a data folder, one per line");
  command->add_option("--data", options->data, "folder given to `serve --data`")->required();
  command->add_option("--state", options->state, "print only jobs in this state")
      ->check(CLI::IsMember(job_states()));
  command->add_option("--arm", options->arm, "print only jobs that move this arm");
  command->add_flag("--csv", options->csv, "print CSV instead of JSON lines");
  return {command, [options] { return print_history(*options); }};
}

Command token_command(CLI::App& app) {
  const auto options = std::make_shared<TokenOptions>();
  CLI::App* command = app.add_subcommand("token", "add, list or revoke access tokens of a server");
  command->require_subcommand(1);
  const auto add = [&](TokenOptions::What what, const char* name, const char* text) {
    CLI::App* one = command->add_subcommand(name, text);
    one->add_option("--tokens", options->file, "token file given to `serve --tokens`")->required();
    if (what != TokenOptions::What::list) {
      one->add_option("--name", options->name, "name of the person or program that uses the token")
          ->required();
    }
    if (what == TokenOptions::What::add) {
      one->add_option("--role", options->role, "role of the token: viewer, operator or admin")
          ->required();
    }
    one->callback([options, what] { options->what = what; });
  };
  add(TokenOptions::What::add, "add", "create a token and print it, this once only");
  add(TokenOptions::What::list, "list", "list names, roles and creation times of all tokens");
  add(TokenOptions::What::revoke, "revoke", "revoke a token; takes effect at once");
  return {command, [options] { return change_tokens(*options); }};
}

Command audit_command(CLI::App& app) {
  const auto options = std::make_shared<AuditOptions>();
  CLI::App* command =
      app.add_subcommand("audit", "check a recording for contacts, independently of the server");
  add_cell(*command, options->cell_file);
  command
      ->add_option(
          "--recording", options->recording,
          "folder of the recording; must contain states.csv. If it has true_states.csv, the "
          "true positions of simulated arms are checked instead of measured ones")
      ->required();
  command
      ->add_option("--step", options->step_s,
                   "largest time step between checked states, in seconds")
      ->check(CLI::Range(1e-6, 10.0))
      ->capture_default_str();
  return {command, [options] { return audit_recording(*options); }};
}

// Checks a number, because the parser would accept nan and inf.
std::string not_a_number(const std::string& text) {
  double number = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, ec] = std::from_chars(text.data(), end, number);
  if (ec == std::errc{} && stop == end && std::isfinite(number)) return {};
  return text + " is not a number";
}

// Refuses numbers that are none, and empty values, which come from unset shell variables: `--tokens
// ""` would admit every request.
void check_values(CLI::App& command) {
  for (CLI::Option* option : command.get_options()) {
    if (option->get_type_name().starts_with("FLOAT")) option->check(not_a_number);
    if (option->get_items_expected_max() == 0) continue;  // a flag
    if (option->get_type_name() == "PREFIX") continue;    // one of several may be empty
    if (option->get_type_name() == "CATEGORY") continue;  // the server stops, then refuses it
    option->check([](const std::string& value) {
      return value.empty() ? std::string("is empty: give it a value or leave the option out")
                           : std::string();
    });
  }
  for (CLI::App* below : command.get_subcommands({})) check_values(*below);
}

}  // namespace

std::vector<std::string> job_states() {
  std::vector<std::string> names;
  for (const JobState state : kValues<JobState>) names.emplace_back(to_string(state));
  return names;
}

std::vector<Command> add_commands(CLI::App& app) {
  std::vector<Command> commands{
      serve_command(app),   validate_command(app), schema_command(app), import_command(app),
      check_command(app),   plan_command(app),     reach_command(app),  simulate_command(app),
      compare_command(app), arm_command(app),      replay_command(app), history_command(app),
      token_command(app),   audit_command(app),
  };
  for (Command& command : remote_commands(app)) commands.push_back(std::move(command));
  check_values(app);
  return commands;
}

}  // namespace armloom
