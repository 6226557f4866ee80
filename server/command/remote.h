#pragma once

#include <optional>
#include <string>
#include <vector>

namespace armloom {

// Commands for a running server. They print the server's answer as text, or with `json` as it is.

struct RemoteOptions {
  std::string url = "http://127.0.0.1:8080";
  std::string token;
  bool json = false;
};

struct JobsOptions {
  RemoteOptions server;
  std::string state;  // default: any
  std::string arm;
  std::size_t limit = 100;
};
int list_remote_jobs(const JobsOptions& options);

// Options of `why` and `cancel`.
struct OneJobOptions {
  RemoteOptions server;
  std::string job;
};
int explain_job(const OneJobOptions& options);
int cancel_remote_job(const OneJobOptions& options);

struct ArmsOptions {
  RemoteOptions server;
  std::vector<std::string> arms;  // default: all
  std::string category = "2";     // of a stop; the server stops, and refuses a bad one
};
// Stop or resume each of the arms, even if an earlier request fails. Exit 2 if an arm is not
// resumed.
int stop_remote_arms(const ArmsOptions& options);
int resume_remote_arms(const ArmsOptions& options);

struct SpeedOptions {
  RemoteOptions server;
  std::optional<double> share;    // default: print the present override
  std::vector<std::string> arms;  // default: the cell
};
// Sets or prints the speed override of the cell, or of each of the arms.
int speed_of_remote_arms(const SpeedOptions& options);

struct FaultsOptions {
  enum class What { list, add, remove };
  RemoteOptions server;
  What what = What::list;
  // Of the fault to add; the server gives the defaults.
  std::string arm;
  std::string kind;
  std::optional<double> value;
  std::optional<double> at_s;
  std::optional<double> for_s;
  std::vector<std::string> ids;  // to remove
};
// Lists or adds faults of simulated arms, or removes each of the faults, even if an earlier request
// fails.
int change_remote_faults(const FaultsOptions& options);

struct EventsOptions {
  RemoteOptions server;
  std::size_t count = 0;  // ends after so many events; zero: never
};
// Prints events as they come, one per line, until the server ends.
int print_events(const EventsOptions& options);

}  // namespace armloom
