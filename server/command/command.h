#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "core/base/problem.h"
#include "core/model/cell.h"

namespace armloom {

// Exit codes of every command.
inline constexpr int kExitDone = 0;
inline constexpr int kExitFound = 1;         // negative result, for example a contact
inline constexpr int kExitBadInput = 2;      // one sentence on stderr for each fault
inline constexpr int kExitUnavailable = 69;  // the server cannot be reached (EX_UNAVAILABLE)
inline constexpr int kExitNotWritten = 74;   // output not written completely (EX_IOERR)

struct ServeOptions {
  std::string cell_file;
  std::string listen = "127.0.0.1:8080";
  std::string data;  // default: no recording, no stored jobs
  std::size_t keep_jobs = 100'000;
  std::size_t keep_days = 0;  // zero: unlimited
  // Limits of the recordings in `data`, the running one included. Zero: unlimited.
  std::size_t keep_recordings = 0;
  std::size_t keep_recording_days = 0;
  std::size_t keep_recording_mb = 0;
  double jog_lease_s = 0.5;  // seconds of wall time
  std::string log_format = "text";
  std::string log_requests = "none";
  std::string tokens;           // default: all requests are allowed
  std::string tls_certificate;  // required with tls_key, and vice versa
  std::string tls_key;
  bool record = false;
  double speed = 1.0;
  std::string web;  // default: next to the binary
  std::vector<std::string> allowed_origins;
  std::vector<std::string> allowed_hosts;  // besides IP addresses and localhost
  std::string policy;                      // default: the cell's
  // Limits of one client. `serve --help` gives the limits of all clients together.
  double requests_per_s = 5'000;
  double jobs_per_s = 1'000;
  std::size_t connections_per_client = 3'500;
};
int serve(const ServeOptions& options);

// Runs the simulated arms of one robot as a process of their own, until SIGINT or SIGTERM.
// Refuses a robot that the cell file does not give to a process of its own. Precondition: either
// `listen` or `hello` is given.
struct ArmOptions {
  std::string cell_file;
  std::string robot;
  std::string listen;      // see parse_endpoint()
  bool physics = false;    // masses, drives and contacts (server/physics)
  std::string payload;     // LINK=KG, with physics
  bool hello = false;      // prints the server's hello instead, for tests of drivers
  std::uint64_t seed = 1;  // of the noise
};
int run_arm(const ArmOptions& options);

// Adds, lists or revokes tokens; prints a new token once.
struct TokenOptions {
  enum class What { add, list, revoke };
  What what = What::list;
  std::string file;
  std::string name;
  std::string role;
};
int change_tokens(const TokenOptions& options);

// `verbose`: prints every warning, not one line for each kind.
int validate_cell(const std::string& cell_file, bool verbose = false);

int print_cell_schema(bool markdown);
int print_openapi();

// Writes a cell file to stdout or to a file. Notes and faults go to stderr. Exit 0 if the cell can
// be loaded.
struct ImportOptions {
  std::vector<std::string> urdf;
  std::vector<std::string> srdf;                   // one per URDF
  std::vector<std::string> joint_limits;           // none, or one per URDF
  std::vector<std::string> robots;                 // NAME or NAME:x=0.75,yaw_deg=180
  std::vector<std::string> packages;               // NAME=FOLDER
  std::vector<std::string> srdf_prefixes;          // none, or one per URDF
  std::vector<std::string> joint_limits_prefixes;  // none, or one per URDF
  std::string prefix;                              // for a single robot
  std::string name;      // default: name of `out`, else names of the robots
  std::string out;       // default: stdout
  bool verbose = false;  // every warning, not one line for each kind
};
int import_robots(const ImportOptions& options);

// Prints one Verdict (JSON) per job.
struct CheckOptions {
  std::string cell_file;
  std::string jobs_file;
  std::string policy;
};
int check_jobs_file(const CheckOptions& options);

// Plans a job that moves an arm to a goal, with all other arms at home. Prints the job (a body of
// POST /jobs); exit 0. If there is no plan, prints the reason as JSON; exit 1.
struct PlanOptions {
  std::string cell_file;
  std::string arm;
  std::vector<std::string> arms;  // candidates; the fastest arm moves
  std::string to;                 // see server/messages/plan_goal.h
  std::string from;               // named state or joints; default: home
  std::uint64_t seed = 1;
  std::optional<int> budget = {};  // PlanQuestion::budget
  std::string out;                 // default: stdout
};
int plan_way(const PlanOptions& options);

// Prints the share of a grid of tool poses that each arm reaches, and where the reach of arms
// overlaps. Can also draw an SVG.
struct ReachOptions {
  std::string cell_file;
  double step_m = 0.2;
  std::string link;     // with or without prefix; default: link of the last joint
  std::string picture;  // default: no picture
  bool json = false;
};
int show_reach(const ReachOptions& options);

struct SimulateOptions {
  std::string cell_file;
  std::string jobs_file;
  std::string policy;
  std::uint64_t seed = 1;
  std::string out;          // default: no recording
  std::string faults_file;  // default: none
};
int simulate_jobs(const SimulateOptions& options);

// Prints a Markdown table. Exit 0 if no job was refused and every job ended, under every policy.
struct CompareOptions {
  std::string cell_file;
  std::string jobs_file;
  std::string policies;  // comma-separated; default: all
  std::uint64_t seed = 1;
  std::string out;  // folder of compare.csv and compare.svg
};
int compare_policies(const CompareOptions& options);

struct AuditOptions {
  std::string cell_file;
  std::string recording;
  double step_s = 0.001;
};
int audit_recording(const AuditOptions& options);

// Replays a recording of `serve --data`. The last line on stdout is JSON. Exit 0 if the events are
// the same. Exit 1 if they differ (the first difference is on stderr), or if no events were
// recorded.
struct ReplayOptions {
  std::string data;               // replays the newest recording in this folder
  std::string recording;          // replays this recording instead
  std::optional<double> until_s;  // cell time
  std::string out;                // folder for the replayed events
};
int replay_recording(const ReplayOptions& options);

// Prints the jobs of a data folder, oldest first, even while a server uses it.
struct HistoryOptions {
  std::string data;
  std::string state;  // default: any
  std::string arm;
  bool csv = false;
};
int print_history(const HistoryOptions& options);

// ---- Shared by the commands ----

struct LoadedCell {
  CellPtr cell;
  CellDescription description;
  std::filesystem::path file;
  std::string text;  // text of the cell file
  Problems warnings;
};
// Which problems and warnings of a cell are printed.
enum class Detail { one_of_each_kind, all };
// Prints problems and warnings on stderr and returns nullopt if the cell cannot be built.
[[nodiscard]] std::optional<LoadedCell> load_cell(const std::string& cell_file,
                                                  Detail detail = Detail::one_of_each_kind);
// Loads a cell from a text, which is or will be the content of `cell_file`.
[[nodiscard]] std::optional<LoadedCell> load_cell_text(std::string text,
                                                       const std::string& cell_file,
                                                       Detail detail = Detail::one_of_each_kind);
// Returns true if a server would run the cell. Prints on stderr: warnings, pairs of links that the
// SRDF disables without proof, and faults.
[[nodiscard]] bool is_fit_to_run(const LoadedCell& loaded,
                                 Detail detail = Detail::one_of_each_kind);

// Prints "armloom: config/x.json:/robots/0/urdf: ..." on stderr. With `one_of_each_kind`, prints
// three problems of one kind, because each may need its own remedy, and the number of others.
void complain(const std::string& file, const Problems& problems, Detail detail = Detail::all);
// Prints "armloom: warning: ...", one line with a count for each kind. Hazards (is_hazard()) come
// first: "armloom: warning: hazard: ...".
void warn(const std::string& file, const Problems& warnings,
          Detail detail = Detail::one_of_each_kind);
// Prints the problems and returns kExitBadInput.
int refuse(const std::string& file, const Problems& problems, Detail detail = Detail::all);

// Returns the problems. Those with this slug get the option ("--out") as their place.
[[nodiscard]] Problems said_of_option(Problems problems, std::string_view slug,
                                      std::string_view option);

}  // namespace armloom
