#include "server/drivers/io_devices.h"

#include <utility>

namespace armloom {

void IoDevices::start(const ModbusDevice::Report& report) {
  const std::scoped_lock lock(mutex_);
  for (std::uint32_t d = 0; d < cell_->io.devices.size(); ++d) {
    devices_.push_back(std::make_unique<ModbusDevice>(cell_->io, IoDeviceId{d}, report));
  }
}

void IoDevices::end() {
  std::vector<std::unique_ptr<ModbusDevice>> ended;
  const std::scoped_lock lock(mutex_);
  std::swap(ended, devices_);
}

void IoDevices::write(SignalId signal, const SignalValue& value) {
  const auto device = cell_->io.device_of(signal);
  const std::scoped_lock lock(mutex_);
  if (device && device->index() < devices_.size()) devices_[device->index()]->write(signal, value);
}

}  // namespace armloom
