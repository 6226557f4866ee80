#include "server/command/command_line.h"

#include <charconv>
#include <memory>
#include <string>

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
  command.add_option("--policy", policy, "instead of the cell's");
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

Command validate_command(CLI::App& app) {
  const auto file = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("validate", "say what a cell holds, or its faults");
  add_cell(*command, *file);
  return {command, [file] { return validate_cell(*file); }};
}

Command schema_command(CLI::App& app) {
  struct What {
    bool markdown = false;
    bool openapi = false;
  };
  const auto what = std::make_shared<What>();
  CLI::App* command =
      app.add_subcommand("schema", "print the JSON schema of cell files, as editors use it");
  command->add_flag("--markdown", what->markdown, "the reference for people instead");
  command->add_flag("--openapi", what->openapi, "the description of the HTTP interface instead")
      ->excludes("--markdown");
  return {command,
          [what] { return what->openapi ? print_openapi() : print_cell_schema(what->markdown); }};
}

Command import_command(CLI::App& app) {
  const auto options = std::make_shared<ImportOptions>();
  CLI::App* command =
      app.add_subcommand("import", "write a cell file from a robot's URDF and SRDF");
  command->add_option("--urdf", options->urdf, "URDF; repeated for several: one for each --robot")
      ->required()
      ->allow_extra_args(false);
  command
      ->add_option("--srdf", options->srdf,
                   "SRDF; repeated, the first for the first URDF, and so on")
      ->required()
      ->allow_extra_args(false);
  command
      ->add_option("--joint-limits", options->joint_limits,
                   "MoveIt's joint_limits.yaml; repeated as --urdf is")
      ->allow_extra_args(false);
  command
      ->add_option("--robot", options->robots,
                   "a robot and where it stands, as left:x=-0.75,yaw_deg=90 (x, y, z in m; "
                   "roll_deg, pitch_deg, yaw_deg); may be repeated")
      ->type_name("NAME[:...]")
      ->allow_extra_args(false);
  command
      ->add_option("--package", options->packages,
                   "where package://NAME/ is; else it is looked for above the URDF")
      ->type_name("NAME=FOLDER")
      ->allow_extra_args(false);
  command->add_option("--prefix", options->prefix,
                      "of joints and links; several robots have their names as prefixes");
  command->add_option("--name", options->name, "of the cell (that of --out)");
  command->add_option("--out", options->out,
                      "cell file, with paths relative to it (stdout, with absolute ones)");
  return {command, [options] { return import_robots(*options); }};
}

Command check_command(CLI::App& app) {
  const auto options = std::make_shared<CheckOptions>();
  CLI::App* command =
      app.add_subcommand("check", "judge jobs against each other without running them");
  add_cell(*command, options->cell_file);
  add_jobs(*command, options->jobs_file);
  add_policy(*command, options->policy);
  return {command, [options] { return check_jobs_file(*options); }};
}

Command plan_command(CLI::App& app) {
  const auto options = std::make_shared<PlanOptions>();
  CLI::App* command =
      app.add_subcommand("plan", "a job that brings an arm to a goal, all others at home");
  add_cell(*command, options->cell_file);
  auto* which = command->add_option_group("who goes there");
  which->add_option("--arm", options->arm, "which one");
  which->add_option("--arms", options->arms, "whichever of these, as left,right, is there first")
      ->delimiter(',');
  which->require_option(1);
  command
      ->add_option("--to", options->to,
                   "a named state, or JSON: {\"joints\": [...]}, {\"pose\": {\"link\", "
                   "\"xyz\", \"rpy\"}}")
      ->required();
  command->add_option("--from", options->from, "where it stands: a named state or joints (home)");
  add_seed(*command, options->seed, "of the search");
  command
      ->add_option("--budget", options->budget,
                   "evaluations that the search may take, for each arm (400000)")
      ->check(CLI::Range(1, kPlanBudgetMax));
  command->add_option("--out", options->out, "file of the job, a body of POST /jobs (stdout)");
  return {command, [options] { return plan_way(*options); }};
}

Command reach_command(CLI::App& app) {
  const auto options = std::make_shared<ReachOptions>();
  CLI::App* command = app.add_subcommand(
      "reach", "what each arm's tool reaches, and where the arms' reach overlaps");
  add_cell(*command, options->cell_file);
  command->add_option("--step", options->step_m, "between places of the grid, m")
      ->check(CLI::Range(0.01, 1.0))
      ->capture_default_str();
  command->add_option("--link", options->link,
                      "the tool, with or without prefix (the link of the last joint)");
  command->add_option("--picture", options->picture,
                      "SVG file: what is reached, from above and from the side");
  command->add_flag("--json", options->json, "instead of tables");
  return {command, [options] { return show_reach(*options); }};
}

Command simulate_command(CLI::App& app) {
  const auto options = std::make_shared<SimulateOptions>();
  CLI::App* command = app.add_subcommand("simulate", "run jobs on simulated time");
  add_cell(*command, options->cell_file);
  add_jobs(*command, options->jobs_file);
  add_policy(*command, options->policy);
  add_seed(*command, options->seed);
  command->add_option("--out", options->out, "folder for the recording");
  command->add_option("--faults", options->faults_file, "faults file (JSON)");
  return {command, [options] { return simulate_jobs(*options); }};
}

Command compare_command(CLI::App& app) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* command =
      app.add_subcommand("compare", "run the same jobs under several policies: a table");
  add_cell(*command, options->cell_file);
  add_jobs(*command, options->jobs_file);
  command->add_option("--policies", options->policies, "names, a comma between (all)");
  add_seed(*command, options->seed);
  command->add_option("--out", options->out, "folder for compare.csv and compare.svg");
  return {command, [options] { return compare_policies(*options); }};
}

Command replay_command(CLI::App& app) {
  const auto options = std::make_shared<ReplayOptions>();
  CLI::App* command = app.add_subcommand(
      "replay", "run a recording of `serve --data` again, and compare its events");
  auto* replayed_data =
      command->add_option("--data", options->data, "data folder: the newest run in it");
  auto* replayed_folder =
      command->add_option("--recording", options->recording, "this one instead: its folder");
  replayed_data->excludes(replayed_folder);
  command->require_option(1, 0);
  command->add_option("--until", options->until_s, "so far, in seconds of cell time (all)")
      ->check(CLI::Range(0.0, 1e9));
  command->add_option("--out", options->out, "folder for the events of the replay");
  return {command, [options] { return replay_recording(*options); }};
}

std::vector<std::string> job_states() {
  std::vector<std::string> names;
  for (const JobState state : kValues<JobState>) names.emplace_back(to_string(state));
  return names;
}

Command history_command(CLI::App& app) {
  const auto options = std::make_shared<HistoryOptions>();
  CLI::App* command = app.add_subcommand("history", "print the jobs of a data folder, one a line");
  command->add_option("--data", options->data, "folder of `serve --data`")->required();
  command->add_option("--state", options->state, "only those in this state")
      ->check(CLI::IsMember(job_states()));
  command->add_option("--arm", options->arm, "only those that move this arm");
  command->add_flag("--csv", options->csv, "as CSV instead of JSON lines");
  return {command, [options] { return print_history(*options); }};
}

Command token_command(CLI::App& app) {
  const auto options = std::make_shared<TokenOptions>();
  CLI::App* command = app.add_subcommand("token", "who may use a server that asks for tokens");
  command->require_subcommand(1);
  const auto add = [&](TokenOptions::What what, const char* name, const char* text) {
    CLI::App* one = command->add_subcommand(name, text);
    one->add_option("--tokens", options->file, "file of `serve --tokens`")->required();
    if (what != TokenOptions::What::list) {
      one->add_option("--name", options->name, "of whom or what has it")->required();
    }
    if (what == TokenOptions::What::add) {
      one->add_option("--role", options->role, "viewer, operator or admin")->required();
    }
    one->callback([options, what] { options->what = what; });
  };
  add(TokenOptions::What::add, "add", "make one, which is printed this once");
  add(TokenOptions::What::list, "list", "names and roles");
  add(TokenOptions::What::revoke, "revoke", "it is worth nothing from now on");
  return {command, [options] { return change_tokens(*options); }};
}

Command audit_command(CLI::App& app) {
  const auto options = std::make_shared<AuditOptions>();
  CLI::App* command = app.add_subcommand("audit", "re-check a recording for contacts");
  add_cell(*command, options->cell_file);
  command->add_option("--recording", options->recording, "folder with states.csv")->required();
  command->add_option("--step", options->step_s, "largest step between states, in seconds")
      ->check(CLI::Range(1e-6, 10.0))
      ->capture_default_str();
  return {command, [options] { return audit_recording(*options); }};
}

// What a variable that is not set leaves behind is no value: without its tokens a server would let
// everybody in.
void refuse_empty_values(CLI::App& command) {
  for (CLI::Option* option : command.get_options()) {
    if (option->get_items_expected_max() == 0) continue;  // a flag
    option->check([](const std::string& value) {
      return value.empty() ? std::string("is empty: give it a value, or leave the option out")
                           : std::string();
    });
  }
  for (CLI::App* below : command.get_subcommands({})) refuse_empty_values(*below);
}

}  // namespace

std::vector<Command> add_commands(CLI::App& app) {
  std::vector<Command> commands{
      serve_command(app),   validate_command(app), schema_command(app),  import_command(app),
      check_command(app),   plan_command(app),     reach_command(app),   simulate_command(app),
      compare_command(app), replay_command(app),   history_command(app), token_command(app),
      audit_command(app),
  };
  refuse_empty_values(app);
  return commands;
}

}  // namespace armloom
