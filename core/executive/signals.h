#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/executive/events.h"
#include "core/model/io_description.h"

namespace armloom {

struct ExecutiveInput;

// The report of an I/O device: its connection, and all values that the server read.
struct IoReport {
  std::string device;
  bool is_up = false;
  std::string detail = {};                         // why it is not up
  std::map<std::string, SignalValue> values = {};  // by signal; of the signals of the device
  std::map<std::string, std::string> faults = {};  // by signal: why the device refuses it
};

// Returns what is wrong with a value for this signal: the cell has no such signal (`unknown`, with
// the pointer `name_at`), or it has another type (pointer `value_at`).
[[nodiscard]] std::optional<Problem> find_bad_value(const IoDescription& io,
                                                    const std::string& name,
                                                    const SignalValue& value, ProblemKind unknown,
                                                    const std::string& name_at,
                                                    const std::string& value_at);

// The inputs and outputs of the cell. Used on the strand.
//
// A simulated signal takes a value at once. A signal of a device has the value that the device
// reported last: an output takes a new value when the device reports it. While there is no
// connection, an input has no value, and an output has its fail_state (SignalDescription). After a
// connection was lost, no value from before it is written again. A signal that its device refuses
// has no value and counts as not connected; the others of the device go on.
class Signals {
 public:
  // Sends a value to a device. Null: all signals are simulated.
  using Write = std::function<void(SignalId signal, const SignalValue& value)>;
  struct Told {
    // Called with each request, also an invalid one. Returns the present time.
    std::function<TimePoint(const ExecutiveInput&)> asked;
    std::function<void(SignalId)> changed;  // called after a change of the signal's view
    std::function<TimePoint()> now;
    // Called when a device is lost or back, and when it refuses a signal.
    std::function<void(Alert)> alert;
  };
  Signals(const IoDescription& io, Write write, Told told);

  [[nodiscard]] const std::vector<SignalView>& views() const { return views_; }  // by SignalId

  // Sets an output, or a simulated input. Problems: an unknown signal; a value of another type; an
  // input of a device (conflict); an output of a device that is not connected (unavailable).
  [[nodiscard]] Result<SignalView> set(const std::string& name, const SignalValue& value);
  // Does the same as set() for a step of a job, which is not an external input.
  [[nodiscard]] Result<SignalView> command(const std::string& name, const SignalValue& value);
  // Takes the report of a device. Ignores reports of unknown devices.
  void report(const IoReport& report);

 private:
  [[nodiscard]] Result<SignalView> take(const std::string& name, const SignalValue& value,
                                        TimePoint now);
  void tell_device(const IoReport& report);
  void tell_refusal(const IoReport& report, const std::string& signal, const std::string& why);
  // A signal in a report.
  struct Seen {
    std::optional<SignalValue> value;
    bool is_connected;
    std::string detail;
  };
  void see(SignalId signal, Seen seen, TimePoint now);

  const IoDescription& io_;
  Write write_;
  Told told_;
  std::vector<SignalView> views_;
  std::set<std::string> lost_;                        // devices whose loss was told
  std::map<std::string, std::string> told_refusals_;  // by signal
};

}  // namespace armloom
