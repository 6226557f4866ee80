#include "test/faults/listed_faults.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
using Kind = ArmFault::Kind;

FaultRequest one(Kind kind, double value = 0.0, std::optional<Duration> lasting = {}) {
  return {.arm = "", .kind = kind, .at = {}, .lasting = lasting, .value = value};
}

std::vector<ListedFault> all() {
  const std::string costs_time = "costs time only: no arm is stopped";
  const std::string waits = "the arm rests within its authority; others wait, and go on";
  const std::string stale = "no authority is added while reports are late; no arm is stopped";
  const std::string lost =
      "the arm is stopped as lost, within its authority, until the link is up and it is resumed";
  const std::string fails = "the job fails with `arm_fault`; the arm can be used after a resume";
  const std::string off_path =
      "the monitor stops the arm at `tracking_error_rad`, and others that it may hit";
  const std::string away =
      "the monitor stops the arm when it can no longer come to rest at its authority";
  const std::string tolerated = "no stop: the promises hold";
  return {
      {"stall 0.5 s", {one(Kind::stall, 0, 500ms)}, waits},
      {"stall 5 s", {one(Kind::stall, 0, 5s)}, waits},
      {"stall", {one(Kind::stall)}, "the job ends with `overrun`, or goes on after the fault"},
      {"slow 0.5", {one(Kind::slow, 0.5, 10s)}, costs_time},
      {"slow 0.1", {one(Kind::slow, 0.1, 10s)}, costs_time},
      {"late_start 0.5 s", {one(Kind::late_start, 0.5, 10s)}, costs_time},
      {"late_start 3 s", {one(Kind::late_start, 3.0, 10s)}, costs_time},
      {"fault", {one(Kind::fault)}, fails},
      {"reject", {one(Kind::reject)}, fails},
      {"drop_feedback 0.04 s", {one(Kind::drop_feedback, 0, 40ms)}, stale},
      {"drop_feedback 0.5 s", {one(Kind::drop_feedback, 0, 500ms)}, lost},
      {"drop_feedback", {one(Kind::drop_feedback)}, lost},
      {"freeze_feedback 0.04 s", {one(Kind::freeze_feedback, 0, 40ms)}, waits},
      {"freeze_feedback 0.5 s", {one(Kind::freeze_feedback, 0, 500ms)}, waits},
      {"freeze_feedback",
       {one(Kind::freeze_feedback)},
       "the arm stays within its authority; its job ends with `overrun`, or it is stopped"},
      {"drift 0.02 rad/s", {one(Kind::drift, 0.02)}, off_path},
      {"drift -0.02 rad/s", {one(Kind::drift, -0.02)}, off_path},
      {"drift 0.2 rad/s", {one(Kind::drift, 0.2)}, off_path},
      {"drift -0.2 rad/s", {one(Kind::drift, -0.2)}, off_path},
      {"drift 1 rad/s", {one(Kind::drift, 1.0)}, off_path},
      {"drift 0.2 rad/s for 0.1 s", {one(Kind::drift, 0.2, 100ms)}, off_path},
      {"runaway", {one(Kind::runaway)}, away},
      {"runaway 0.5 s", {one(Kind::runaway, 0, 500ms)}, away},
      {"ignore_stop",
       {one(Kind::ignore_stop)},
       "the arm rests at its authority instead of where it should brake"},
      {"noise 0.0001 rad", {one(Kind::noise, 0.0001)}, tolerated},
      {"noise 0.002 rad", {one(Kind::noise, 0.002)}, off_path},
      {"noise 0.05 rad", {one(Kind::noise, 0.05)}, off_path},
      {"delay 0.01 s", {one(Kind::delay, 0.01)}, tolerated},
      {"delay 0.04 s", {one(Kind::delay, 0.04)}, stale},
      {"delay 0.2 s", {one(Kind::delay, 0.2)}, lost},
      {"jitter 0.02 s", {one(Kind::jitter, 0.02)}, tolerated},
      {"jitter 0.3 s", {one(Kind::jitter, 0.3)}, lost},
      {"loss 0.1", {one(Kind::loss, 0.1)}, tolerated},
      {"loss 0.5", {one(Kind::loss, 0.5)}, "commands are repeated; no arm is stopped"},
      {"loss 0.95", {one(Kind::loss, 0.95)}, lost},
      {"reorder 0.2", {one(Kind::reorder, 0.2)}, "old reports are ignored, commands repeated"},
      {"cut 0.02 s",
       {one(Kind::cut, 0, 20ms)},
       "the arm brakes by itself and is stopped as lost, until it is resumed"},
      {"cut 1 s", {one(Kind::cut, 0, 1s)}, lost},
      {"cut", {one(Kind::cut)}, lost},
      {"restart 0.5 s",
       {one(Kind::restart, 0, 500ms)},
       "the job fails, as the controller has lost its motion; nothing moves before a resume"},
      {"restart", {one(Kind::restart)}, "as `restart 0.5 s`"},
      {"clock_drift 0.0005", {one(Kind::clock_drift, 0.0005)}, tolerated},
      {"clock_drift -0.0005", {one(Kind::clock_drift, -0.0005)}, tolerated},
      {"clock_drift -0.02",
       {one(Kind::clock_drift, -0.02)},
       "reports seem to grow old: the arm is stopped as lost"},
      {"drift 0.2 rad/s + drop_feedback 0.5 s",
       {one(Kind::drift, 0.2), one(Kind::drop_feedback, 0, 500ms)},
       "the arm is stopped as lost; found off its path when reports return; may touch",
       true},
      {"runaway + delay 0.04 s",
       {one(Kind::runaway), one(Kind::delay, 0.04)},
       "the monitor stops the arm and others near it, later by the delay; may touch",
       true},
      {"slow 0.3 + loss 0.3 + reorder 0.2 + jitter 0.01 s",
       {one(Kind::slow, 0.3), one(Kind::loss, 0.3), one(Kind::reorder, 0.2),
        one(Kind::jitter, 0.01)},
       costs_time},
      {"cut 0.5 s + fault", {one(Kind::cut, 0, 500ms), one(Kind::fault)}, lost},
      {"stall 3 s + freeze_feedback 1 s",
       {one(Kind::stall, 0, 3s), one(Kind::freeze_feedback, 0, 1s)},
       waits},
  };
}

}  // namespace

const std::vector<ListedFault>& listed_faults() {
  static const std::vector<ListedFault> faults = all();
  return faults;
}

std::string table_of_faults() {
  std::string table = "| fault | expected outcome |\n|---|---|\n";
  for (const ListedFault& fault : listed_faults()) {
    table += "| " + fault.name + " | " + fault.expected + " |\n";
  }
  return table;
}

}  // namespace armloom
