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
inline constexpr int kExitFound =
    1;  // ran, and the answer is no: a contact, a job that did not end
inline constexpr int kExitBadInput = 2;     // one sentence on stderr for each fault
inline constexpr int kExitNotWritten = 74;  // ran, but what it was to keep is not whole (EX_IOERR)

struct ServeOptions {
  std::string cell_file;
  std::string listen = "127.0.0.1:8080";
  std::string data;  // empty: nothing is recorded or stored
  std::size_t keep_jobs = 100'000;
  std::size_t keep_days = 0;  // zero: for ever
  // Of recordings in `data`, the running one included; zero: all.
  std::size_t keep_recordings = 0;
  std::size_t keep_recording_days = 0;
  std::size_t keep_recording_mb = 0;
  double jog_lease_s = 0.5;  // of wall time
  std::string log_format = "text";
  std::string log_requests = "none";
  std::string tokens;           // file; empty: everybody may everything
  std::string tls_certificate;  // both or neither
  std::string tls_key;
  bool record = false;
  double speed = 1.0;
  std::string web;                           // empty: looked for beside the binary
  std::vector<std::string> allowed_origins;  // pages of other sites that may command
  std::vector<std::string> allowed_hosts;    // besides IP addresses and localhost
  std::string policy;                        // empty: the cell's
  // Of each client; of all together more: see --help.
  double requests_per_s = 5'000;
  double jobs_per_s = 1'000;
  std::size_t connections_per_client = 3'500;
};
int serve(const ServeOptions& options);

// The tokens of a server: a new one, which is printed this once, all of them, or one less.
struct TokenOptions {
  enum class What { add, list, revoke };
  What what = What::list;
  std::string file;
  std::string name;
  std::string role;
};
int change_tokens(const TokenOptions& options);

int validate_cell(const std::string& cell_file);

// What a cell file may hold: its JSON schema, or the reference for people (config/README.md).
int print_cell_schema(bool markdown);
// The description of the HTTP interface (/openapi.json).
int print_openapi();

// A cell file from a robot's URDF and SRDF, on stdout or in a file; what was chosen and what is
// wrong with it on stderr. Exit 0: it loads.
struct ImportOptions {
  std::vector<std::string> urdf;
  std::vector<std::string> srdf;          // one for each URDF
  std::vector<std::string> joint_limits;  // none, or one for each URDF
  std::vector<std::string> robots;        // NAME or NAME:x=0.75,yaw_deg=180
  std::vector<std::string> packages;      // NAME=FOLDER
  std::string prefix;                     // of a single robot
  std::string name;                       // of the cell; empty: of its robots
  std::string out;                        // empty: stdout
};
int import_robots(const ImportOptions& options);

// A Verdict as JSON for each job of the file, one a line.
struct CheckOptions {
  std::string cell_file;
  std::string jobs_file;
  std::string policy;
};
int check_jobs_file(const CheckOptions& options);

// A job that brings one arm from where it stands to a goal, all others at home: the body of
// POST /jobs, on stdout or in a file; exit 0. Or why there is none, as JSON on stdout; exit 1.
struct PlanOptions {
  std::string cell_file;
  std::string arm;
  std::vector<std::string> arms;  // instead: whichever of these is there first
  std::string to;                 // a named state, or JSON (server/messages/plan_goal.h)
  std::string from;               // the same without poses; empty: home
  std::uint64_t seed = 1;
  std::optional<int> budget = {};  // PlanQuestion::budget
  std::string out;                 // empty: stdout
};
int plan_way(const PlanOptions& options);

// What share of a grid of tool poses each arm reaches, and where the arms' reach overlaps: tables
// on stdout, or JSON; a picture (SVG) in a file.
struct ReachOptions {
  std::string cell_file;
  double step_m = 0.2;
  std::string link;     // the tool, with or without prefix; empty: that of each arm's last joint
  std::string picture;  // empty: none
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

// The same jobs under several policies: one Markdown table on stdout. Exit 0: every job ended under
// every policy, whatever its end.
struct CompareOptions {
  std::string cell_file;
  std::string jobs_file;
  std::string policies;  // comma between names; empty: all of policy_names()
  std::uint64_t seed = 1;
  std::string out;  // empty: no files; else the folder of compare.csv and compare.svg
};
int compare_policies(const CompareOptions& options);

struct AuditOptions {
  std::string cell_file;
  std::string recording;
  double step_s = 0.001;
};
int audit_recording(const AuditOptions& options);

// Runs a recording of `serve --data` again from the log of its inputs. The last line of stdout is a
// JSON object. Exit 0: it came to the same events; 1: it did not, and the first that differs is
// told.
struct ReplayOptions {
  std::string data;               // the newest recording in it; ...
  std::string recording;          // ... or this one
  std::optional<double> until_s;  // cell time; else all of it
  std::string out;                // folder for the events of the replay; empty: none
};
int replay_recording(const ReplayOptions& options);

// The jobs of a data folder, also while a server uses it: oldest first, on stdout, one a line, as
// JSON or as CSV.
struct HistoryOptions {
  std::string data;
  std::string state;  // empty: any
  std::string arm;    // likewise
  bool csv = false;
};
int print_history(const HistoryOptions& options);

// ---- What they share ----

struct LoadedCell {
  CellPtr cell;
  CellDescription description;
  std::filesystem::path file;
  std::string text;  // of the cell file
  Problems warnings;
};
// Reads the file and builds the cell; on problems says each on stderr, and all warnings, and
// returns nothing.
[[nodiscard]] std::optional<LoadedCell> load_cell(const std::string& cell_file);
// The same of a text that stands in `cell_file`, or is going to.
[[nodiscard]] std::optional<LoadedCell> load_cell_text(std::string text,
                                                       const std::string& cell_file);
// Returns true if a server would run the cell: homes free, policy and controllers known. Says on
// stderr the warnings, what became of pairs that an SRDF disables without proof, and what is wrong.
[[nodiscard]] bool is_fit_to_run(const LoadedCell& loaded);

// "armloom: config/x.json:/robots/0/urdf: ..." on stderr, one line for each problem.
void complain(const std::string& file, const Problems& problems);
// "armloom: warning: ...", alike.
void warn(const std::string& file, const Problems& warnings);
// Problems, as an answer: kExitBadInput.
int refuse(const std::string& file, const Problems& problems);

// The problems, with those of this slug said to be at an option of the command line: "--out".
[[nodiscard]] Problems said_of_option(Problems problems, std::string_view slug,
                                      std::string_view option);

}  // namespace armloom
