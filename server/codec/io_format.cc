#include "server/codec/io_format.h"

#include <cstdint>
#include <limits>

#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"

namespace armloom {

using namespace formats;

namespace {

constexpr int kRegisterMax = std::numeric_limits<std::uint16_t>::max();

class SignalValueFormat final : public CustomFormat<SignalValue> {
 public:
  void read(const JsonNode& node, SignalValue& out) const override {
    if (node.raw().is_boolean()) {
      out = node.raw().get<bool>();
    } else if (node.raw().is_number()) {
      int number = 0;
      number_->read(node, number);
      out = static_cast<std::uint16_t>(number);
    } else {
      node.fault(ProblemKind::malformed, "wrong-type",
                 std::string("expected true, false or a whole number from 0 to 65535, found ") +
                     node.raw().type_name());
    }
  }
  void write(JsonWriter& out, const SignalValue& value) const override {
    std::visit([&out](auto plain) { out.value(plain); }, value);
  }
  Schema schema(Way way) const override {
    return {{"anyOf", Schema::array({flag()->schema(way), number_->schema(way)})}};
  }

 private:
  FormatPtr<int> number_ = integer(0, kRegisterMax);
};

FormatPtr<IoDeviceDescription> device_format() {
  using Device = IoDeviceDescription;
  return object<Device>({
      required("name", &Device::name, name(), "Name of the device; unique among the devices."),
      required("endpoint", &Device::endpoint, name(),
               "Address of a Modbus TCP device: tcp:HOST:PORT, usually with port 502."),
      field("unit", &Device::unit, integer(Device::unit_range), "Modbus unit identifier."),
      field("poll_period_s", &Device::poll_period, seconds(Device::poll_period_range),
            "Time between two readings of all its signals."),
      field("timeout_s", &Device::timeout, seconds(Device::timeout_range),
            "Time after which the device counts as lost if it does not answer."),
  });
}

FormatPtr<SignalDescription::Place> place_format() {
  using Place = SignalDescription::Place;
  return object<Place>({
      required("device", &Place::device, name(), "Device that has the signal."),
      required("table", &Place::table, choice<ModbusTable>(),
               "Coils and discrete inputs are bool, registers are integers."),
      required("address", &Place::address, integer(SignalDescription::address_range),
               "Address as it is sent, counted from 0: the register that some manuals call 40001 "
               "has the address 0."),
  });
}

FormatPtr<SignalDescription> signal_format() {
  using Signal = SignalDescription;
  return object<Signal>({
      required("name", &Signal::name, name(),
               "Name of the signal, which jobs and the API use; unique among the signals."),
      required("direction", &Signal::direction, choice<SignalDirection>(),
               "input: the server reads it. output: the server sets it."),
      field("modbus", &Signal::place, place_format(),
            "Place of the signal in a device. Without it, the signal is simulated: PUT /io/{name} "
            "sets it, also an input."),
      field("type", &Signal::type, choice<SignalType>(),
            "Type of a simulated signal; default: bool. integer: 0 to 65535."),
      field("initial", &Signal::initial, signal_value_format(),
            "Value of a simulated signal at the start; default: false or 0."),
      field("fail_state", &Signal::fail_state, signal_value_format(),
            "For an output of a device: value that the server writes when it connects and when it "
            "ends. While there is no connection, the device must set this value by itself. "
            "Default: the server writes nothing then."),
  });
}

}  // namespace

FormatPtr<SignalValue> signal_value_format() { return make_format<SignalValueFormat>(); }

FormatPtr<IoDescription> io_format() {
  using Io = IoDescription;
  return object<Io>({
      field("devices", &Io::devices, list(device_format()), "Modbus TCP devices."),
      field("signals", &Io::signals, list(signal_format()), "Inputs and outputs."),
  });
}

}  // namespace armloom
