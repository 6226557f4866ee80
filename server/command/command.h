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
inline constexpr int kExitFound = 1;        // negative result: a contact, a job that did not end
inline constexpr int kExitBadInput = 2;     // one sentence on stderr for each fault
inline constexpr int kExitNotWritten = 74;  // output not written completely (EX_IOERR)

struct ServeOptions {
  std::string cell_file;
  std::string listen = "127.0.0.1:8080";
  std::string data;  // empty: no recording, no stored jobs
  std::size_t keep_jobs = 100'000;
  std::size_t keep_days = 0;  // zero: unlimited
  // Limits of recordings in `data`, the running one included; zero: unlimited.
  std::size_t keep_recordings = 0;
  std::size_t keep_recording_days = 0;
  std::size_t keep_recording_mb = 0;
  double jog_lease_s = 0.5;  // seconds of wall time
  std::string log_format = "text";
  std::string log_requests = "none";
  std::string tokens;           // token file; empty: all requests are allowed
  std::string tls_certificate;  // both or neither
  std::string tls_key;
  bool record = false;
  double speed = 1.0;
  std::string web;                           // empty: searched next to the binary
  std::vector<std::string> allowed_origins;  // other sites whose pages may send requests
  std::vector<std::string> allowed_hosts;    // besides IP addresses and localhost
  std::string policy;                        // empty: the cell's
  // Limits per client; the limits for all clients are multiples (see --help).
  double requests_per_s = 5'000;
  double jobs_per_s = 1'000;
  std::size_t connections_per_client = 3'500;
};
int serve(const ServeOptions& options);

// Adds a token and prints it once, lists all tokens, or revokes one.
struct TokenOptions {
  enum class What { add, list, revoke };
  What what = What::list;
  std::string file;
  std::string name;
  std::string role;
};
int change_tokens(const TokenOptions& options);

int validate_cell(const std::string& cell_file);

// Prints the JSON schema of cell files, or the reference (config/README.md).
int print_cell_schema(bool markdown);
// Prints the OpenAPI document (/openapi.json).
int print_openapi();

// Writes a cell file from a robot's URDF and SRDF, to stdout or a file; notes and faults go to
// stderr. Exit 0 if the cell can be loaded.
struct ImportOptions {
  std::vector<std::string> urdf;
  std::vector<std::string> srdf;          // one per URDF
  std::vector<std::string> joint_limits;  // none, or one per URDF
  std::vector<std::string> robots;        // NAME or NAME:x=0.75,yaw_deg=180
  std::vector<std::string> packages;      // NAME=FOLDER
  std::string prefix;                     // for a single robot
  std::string name;  // name of the cell; empty: from --out, else from its robots
  std::string out;   // empty: stdout
};
int import_robots(const ImportOptions& options);

// Prints a Verdict as JSON for each job of the file, one per line.
struct CheckOptions {
  std::string cell_file;
  std::string jobs_file;
  std::string policy;
};
int check_jobs_file(const CheckOptions& options);

// Prints a job (a body of POST /jobs) that moves one arm to a goal, with all other arms at home, to
// stdout or a file; exit 0. If there is no plan, prints the reason as JSON on stdout; exit 1.
struct PlanOptions {
  std::string cell_file;
  std::string arm;
  std::vector<std::string> arms;  // instead: candidates; the fastest arm moves
  std::string to;                 // named state, or JSON (server/messages/plan_goal.h)
  std::string from;               // likewise, but no pose; empty: home
  std::uint64_t seed = 1;
  std::optional<int> budget = {};  // PlanQuestion::budget
  std::string out;                 // empty: stdout
};
int plan_way(const PlanOptions& options);

// Prints the share of a grid of tool poses that each arm reaches, and the overlap of the arms'
// reach, as tables or JSON on stdout; optionally writes a picture (SVG).
struct ReachOptions {
  std::string cell_file;
  double step_m = 0.2;
  std::string link;     // tool link, with or without prefix; empty: link of each arm's last joint
  std::string picture;  // empty: no picture
  bool json = false;
};
int show_reach(const ReachOptions& options);

struct SimulateOptions {
  std::string cell_file;
  std::string jobs_file;
  std::string policy;
  std::uint64_t seed = 1;
  std::string out;          // empty: no recording
  std::string faults_file;  // empty: none
};
int simulate_jobs(const SimulateOptions& options);

// Simulates the same jobs under several policies and prints a Markdown table. Exit 0 if every job
// ended under every policy, in any state.
struct CompareOptions {
  std::string cell_file;
  std::string jobs_file;
  std::string policies;  // comma-separated; empty: all of policy_names()
  std::uint64_t seed = 1;
  std::string out;  // folder of compare.csv and compare.svg; empty: no files
};
int compare_policies(const CompareOptions& options);

struct AuditOptions {
  std::string cell_file;
  std::string recording;
  double step_s = 0.001;
};
int audit_recording(const AuditOptions& options);

// Replays a recording of `serve --data` from its log of inputs. The last line of stdout is a JSON
// object. Exit 0 if the events are the same; 1 if they differ, with the first difference on stderr,
// or if no events were recorded.
struct ReplayOptions {
  std::string data;               // replays the newest recording in this folder ...
  std::string recording;          // ... or this recording
  std::optional<double> until_s;  // cell time; nullopt: the whole recording
  std::string out;                // folder for the replayed events; empty: not written
};
int replay_recording(const ReplayOptions& options);

// Prints the jobs of a data folder, oldest first, one per line, as JSON or CSV. Works while a
// server uses the folder.
struct HistoryOptions {
  std::string data;
  std::string state;  // empty: any
  std::string arm;    // likewise
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
// Reads the file and builds the cell. If there are problems, prints them and all warnings on stderr
// and returns nullopt.
[[nodiscard]] std::optional<LoadedCell> load_cell(const std::string& cell_file);
// Likewise, from a text that is or will be in `cell_file`.
[[nodiscard]] std::optional<LoadedCell> load_cell_text(std::string text,
                                                       const std::string& cell_file);
// Returns true if a server would run the cell: no collision at home, known policy and controllers.
// Prints on stderr the warnings, pairs that an SRDF disables without proof, and what is wrong.
[[nodiscard]] bool is_fit_to_run(const LoadedCell& loaded);

// Prints "armloom: config/x.json:/robots/0/urdf: ..." on stderr, one line per problem.
void complain(const std::string& file, const Problems& problems);
// Prints "armloom: warning: ..." likewise.
void warn(const std::string& file, const Problems& warnings);
// Prints the problems and returns kExitBadInput.
int refuse(const std::string& file, const Problems& problems);

// Returns the problems; those with this slug are placed at a command-line option such as "--out".
[[nodiscard]] Problems said_of_option(Problems problems, std::string_view slug,
                                      std::string_view option);

}  // namespace armloom
