#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/ids.h"
#include "core/base/number_range.h"
#include "core/base/time.h"

namespace armloom {

// Inputs and outputs of a cell (I/O), as in the cell file. A signal without a device is simulated.

// A switch, or the value of a 16-bit register.
using SignalValue = std::variant<bool, std::uint16_t>;
enum class SignalType { boolean, integer };  // as numbered in SignalValue
[[nodiscard]] constexpr const char* to_string(SignalType type) {
  switch (type) {
    case SignalType::boolean:
      return "bool";
    case SignalType::integer:
      return "integer";
  }
  return nullptr;
}
[[nodiscard]] inline SignalType type_of(const SignalValue& value) {
  return static_cast<SignalType>(value.index());
}
// Returns "true", "false" or the number.
[[nodiscard]] inline std::string text_of(const SignalValue& value) {
  if (const bool* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  return std::to_string(std::get<std::uint16_t>(value));
}

enum class SignalDirection { input, output };  // as seen from the server
[[nodiscard]] constexpr const char* to_string(SignalDirection direction) {
  switch (direction) {
    case SignalDirection::input:
      return "input";
    case SignalDirection::output:
      return "output";
  }
  return nullptr;
}

// The tables of a Modbus device. Only coils and holding registers can be written.
enum class ModbusTable { coil, discrete_input, holding_register, input_register };
[[nodiscard]] constexpr const char* to_string(ModbusTable table) {
  switch (table) {
    case ModbusTable::coil:
      return "coil";
    case ModbusTable::discrete_input:
      return "discrete_input";
    case ModbusTable::holding_register:
      return "holding_register";
    case ModbusTable::input_register:
      return "input_register";
  }
  return nullptr;
}
[[nodiscard]] constexpr bool is_of_bits(ModbusTable table) {
  return table == ModbusTable::coil || table == ModbusTable::discrete_input;
}

// A Modbus TCP device, such as a PLC or an I/O module.
struct IoDeviceDescription {
  inline static constexpr NumberRange unit_range{0, 255};
  inline static constexpr NumberRange poll_period_range{0.001, 10.0};
  inline static constexpr NumberRange timeout_range{0.01, 10.0};

  std::string name;      // unique among the devices
  std::string endpoint;  // "tcp:HOST:PORT"
  int unit = 1;          // Modbus unit identifier
  Duration poll_period = std::chrono::milliseconds(20);
  Duration timeout = std::chrono::milliseconds(500);  // for a connection, and for each answer
};

struct SignalDescription {
  inline static constexpr NumberRange address_range{0, 65535};

  // The signal's place in a device.
  struct Place {
    std::string device;
    ModbusTable table = ModbusTable::coil;
    int address = 0;  // as sent to the device, from 0 on
  };

  std::string name;  // unique among the signals
  SignalDirection direction = SignalDirection::input;
  std::optional<SignalType> type = {};  // of a simulated signal; nullopt: bool
  std::optional<Place> place = {};      // nullopt: simulated
  // A simulated signal has this value at the start; nullopt: false, or 0.
  std::optional<SignalValue> initial = {};
  // The server writes this value to an output of a device when it connects and when it ends, and
  // takes it for the output's value while there is no connection. Nullopt: the device decides.
  std::optional<SignalValue> fail_state = {};

  [[nodiscard]] SignalType value_type() const {
    if (!place) return type.value_or(SignalType::boolean);
    return is_of_bits(place->table) ? SignalType::boolean : SignalType::integer;
  }
};

struct IoDescription {
  std::vector<IoDeviceDescription> devices = {};  // indexed by IoDeviceId
  std::vector<SignalDescription> signals = {};    // indexed by SignalId

  [[nodiscard]] const SignalDescription& signal(SignalId id) const { return signals[id.index()]; }
  [[nodiscard]] std::optional<SignalId> find_signal(const std::string& name) const {
    const auto found = std::ranges::find(signals, name, &SignalDescription::name);
    if (found == signals.end()) return std::nullopt;
    return SignalId(static_cast<std::uint32_t>(found - signals.begin()));
  }
  // Returns the device of the signal; nullopt if the signal is simulated.
  [[nodiscard]] std::optional<IoDeviceId> device_of(SignalId id) const {
    const auto& place = signal(id).place;
    if (!place) return std::nullopt;
    const auto found = std::ranges::find(devices, place->device, &IoDeviceDescription::name);
    return IoDeviceId(static_cast<std::uint32_t>(found - devices.begin()));
  }
  // Returns the device's signals in order.
  [[nodiscard]] std::vector<SignalId> signals_of(IoDeviceId device) const {
    std::vector<SignalId> of_it;
    for (std::uint32_t s = 0; s < signals.size(); ++s) {
      if (device_of(SignalId{s}) == device) of_it.push_back(SignalId{s});
    }
    return of_it;
  }
};

}  // namespace armloom
