#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/executive/signals.h"
#include "core/model/cell.h"

struct _modbus;

namespace armloom {

// The connection to one Modbus TCP device. A thread of its own connects, writes outputs, reads all
// signals in each poll period, and connects again after a fault. If the device refuses an address
// or a value, only this signal is reported as faulty; the others go on. The public functions are
// thread-safe.
class ModbusDevice {
 public:
  // Called on the device's thread after the connection or a value has changed.
  using Report = std::function<void(IoReport)>;
  ModbusDevice(const IoDescription& io, IoDeviceId device, Report report);
  // If there is a connection, writes the fail states. Takes at most the device's timeout for each
  // output.
  ~ModbusDevice();

  // Sends a value to an output, in the order of the calls. Never blocks. Drops the value if there
  // is no connection, or if it ends before the value is written.
  void write(SignalId signal, const SignalValue& value);

 private:
  using Output = std::pair<SignalId, SignalValue>;
  using Connection = std::unique_ptr<_modbus, void (*)(_modbus*)>;
  // A block of addresses of one table that are read in one request.
  struct Block {
    ModbusTable table;
    int first;
    std::vector<SignalId> signals;  // one for each address, from `first` on
  };
  // Why a request has failed; the text is empty if it has not.
  struct Fault {
    std::string text;
    bool is_refused = false;  // the device answers, but refuses the address, table or value
  };
  // A connection, and what the device refused since it was made.
  struct Session {
    _modbus* to;
    std::vector<Block> blocks;
    struct Refusal {
      std::string text;
      std::chrono::steady_clock::time_point until;
    };
    std::map<SignalId, Refusal> writes = {};
  };

  static std::vector<Block> blocks_of(const IoDescription& io, IoDeviceId device);
  void run(const std::stop_token& stop);
  std::string serve(const std::stop_token& stop);
  [[nodiscard]] Connection connect(std::string& fault) const;
  // These return why the connection must end; else "".
  [[nodiscard]] std::string write_out(Session& session, const Output& output) const;
  [[nodiscard]] std::string write_fail_states(Session& session) const;
  [[nodiscard]] std::string read_all(Session& session, IoReport& report) const;
  [[nodiscard]] Fault read_in(_modbus* from, const Block& block,
                              std::map<std::string, SignalValue>& values) const;
  [[nodiscard]] Fault fault_at(const char* doing, ModbusTable table, int address) const;
  [[nodiscard]] std::deque<Output> wait(const std::stop_token& stop,
                                        std::chrono::steady_clock::time_point until);

  const IoDescription& io_;
  const IoDeviceDescription& device_;
  const std::vector<SignalId> signals_;
  const std::vector<Block> blocks_;
  Report report_;

  std::mutex mutex_;
  std::condition_variable_any wakes_;
  std::deque<Output> outputs_;  // to be written
  bool is_up_ = false;
  std::jthread thread_;  // the last: it ends first
};

}  // namespace armloom
