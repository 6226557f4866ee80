#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "core/executive/signals.h"
#include "core/model/cell.h"
#include "server/drivers/modbus_device.h"

namespace armloom {

// The connections to all I/O devices of a cell. start() and end() are called on one thread, write()
// on another.
class IoDevices {
 public:
  explicit IoDevices(CellPtr cell) : cell_(std::move(cell)) {}

  // `report` is called on the devices' threads until end() returns.
  void start(const ModbusDevice::Report& report);
  // Writes the fail states and ends the connections. Later values are dropped.
  void end();
  void write(SignalId signal, const SignalValue& value);

 private:
  CellPtr cell_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<ModbusDevice>> devices_;  // by IoDeviceId; empty before and after
};

}  // namespace armloom
