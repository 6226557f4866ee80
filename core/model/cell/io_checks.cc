#include <map>
#include <set>

#include "core/base/nearest_name.h"
#include "core/model/cell/cell_checks.h"
#include "core/model/endpoint.h"

namespace armloom {
namespace {

class IoCheck {
 public:
  IoCheck(const IoDescription& io, Diagnostics& diagnostics) : io_(io), diagnostics_(diagnostics) {}

  void devices() {
    for (std::size_t d = 0; d < io_.devices.size(); ++d) {
      const IoDeviceDescription& device = io_.devices[d];
      const std::string pointer = "/io/devices/" + std::to_string(d);
      check_name(device.name, "an I/O device", pointer + "/name", device_names_, diagnostics_);
      const auto endpoint = parse_endpoint(device.endpoint);
      if (!endpoint || endpoint->is_unix() || endpoint->port == "0") {
        diagnostics_.in_cell("bad-endpoint", pointer + "/endpoint",
                             "the endpoint of I/O device " + device.name +
                                 " must be tcp:HOST:PORT; Modbus devices listen on port 502",
                             device.endpoint);
      }
      const auto [first, is_new] =
          device_places_.emplace(std::pair(device.endpoint, device.unit), device.name);
      if (!is_new) {
        diagnostics_.in_cell("duplicate-endpoint", pointer + "/endpoint",
                             "I/O device " + device.name + " has the same endpoint and unit (" +
                                 std::to_string(device.unit) + ") as I/O device " + first->second +
                                 ": list its signals there, or correct the endpoint or unit",
                             device.endpoint);
      }
    }
  }

  void signals() {
    for (std::size_t s = 0; s < io_.signals.size(); ++s) {
      const SignalDescription& signal = io_.signals[s];
      const std::string pointer = "/io/signals/" + std::to_string(s);
      check_name(signal.name, "a signal", pointer + "/name", signal_names_, diagnostics_);
      if (signal.place) {
        check_place(signal, pointer);
      } else {
        refuse(signal.fail_state.has_value(), signal, pointer + "/fail_state", "not-used",
               "has no device, so it has no fail_state: set initial instead");
      }
      check_value(signal, signal.initial, pointer + "/initial");
      check_value(signal, signal.fail_state, pointer + "/fail_state");
    }
  }

 private:
  void refuse(bool fault, const SignalDescription& signal, const std::string& pointer,
              const char* slug, const std::string& why) {
    if (fault) diagnostics_.in_cell(slug, pointer, "signal " + signal.name + " " + why);
  }

  void check_place(const SignalDescription& signal, const std::string& pointer) {
    const auto& [device, table, address] = *signal.place;
    const bool is_output = signal.direction == SignalDirection::output;
    const bool is_writable = table == ModbusTable::coil || table == ModbusTable::holding_register;
    if (!device_names_.contains(device)) {
      diagnostics_.in_cell("unknown-device", pointer + "/modbus/device",
                           "signal " + signal.name + ": there is no I/O device " + device +
                               " in /io/devices" + meant(device),
                           device);
    }
    refuse(is_output && !is_writable, signal, pointer + "/modbus/table", "not-writable",
           std::string("is an output, but no client can write to ") + to_string(table) +
               ": use coil or holding_register, or make it an input");
    refuse(!is_output && signal.fail_state, signal, pointer + "/fail_state", "not-used",
           "is an input, so it has no fail_state: remove it");
    refuse(signal.initial.has_value(), signal, pointer + "/initial", "not-used",
           "belongs to a device, which decides its value: remove initial");
    refuse(signal.type.has_value(), signal, pointer + "/type", "not-used",
           "belongs to a device, and its table decides the type: remove type");
    const auto [first, is_new] = places_.emplace(std::tuple(device, table, address), signal.name);
    refuse(!is_new, signal, pointer + "/modbus/address", "duplicate-address",
           "has the same device, table and address as signal " + first->second);
  }

  [[nodiscard]] std::string meant(const std::string& device) const {
    const std::vector<std::string_view> names(device_names_.begin(), device_names_.end());
    const auto near = nearest_name(device, names);
    return near ? "; did you mean " + std::string(*near) + "?" : std::string();
  }

  void check_value(const SignalDescription& signal, const std::optional<SignalValue>& value,
                   const std::string& pointer) {
    if (!value || type_of(*value) == signal.value_type()) return;
    const bool is_flag = signal.value_type() == SignalType::boolean;
    diagnostics_.in_cell("wrong-type", pointer,
                         "signal " + signal.name + " has the type " +
                             to_string(signal.value_type()) + ", so this must be " +
                             (is_flag ? "true or false" : "a whole number from 0 to 65535"),
                         text_of(*value));
  }

  const IoDescription& io_;
  Diagnostics& diagnostics_;
  std::set<std::string> device_names_;
  std::map<std::pair<std::string, int>, std::string> device_places_;  // endpoint and unit
  std::set<std::string> signal_names_;
  std::map<std::tuple<std::string, ModbusTable, int>, std::string> places_;
};

}  // namespace

void check_io(const IoDescription& io, Diagnostics& diagnostics) {
  IoCheck check(io, diagnostics);
  check.devices();
  check.signals();
}

}  // namespace armloom
