#include "server/messages/signal.h"

#include "server/codec/io_format.h"
#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/output_part.h"
#include "server/codec/read_text.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"

namespace armloom {

using namespace formats;

FormatPtr<SignalView> signal_format() {
  using View = SignalView;
  static const auto format = named(
      "Signal", "An input or output of the cell.",
      object<View>({
          output_only("name", &View::name, text()),
          output_only("direction", &View::direction, choice<SignalDirection>(),
                      "As seen from the server"),
          output_only("type", &View::type, choice<SignalType>(), "bool, or integer: 0 to 65535"),
          output_only("device", &View::device, text_or_null(),
                      "Device of the signal; null: the signal is simulated"),
          output_only("value", &View::value, nullable(signal_value_format()),
                      "Present value; null: not known"),
          output_if(
              "commanded", [](const View& view) { return view.commanded; }, signal_value_format(),
              "Value that was sent to the device, until the device reports it"),
          output_only("is_connected", &View::is_connected, flag(),
                      "false while the server has no connection to the device, or while the "
                      "device refuses this signal"),
          output_only("detail", &View::detail, text_or_null(), "Why it is not connected"),
          output_only("changed_s", &View::changed_at, cell_time(),
                      "Cell time of the last change of the value"),
      }));
  return format;
}

FormatPtr<SignalList> signal_list_format() {
  static const auto format =
      named("SignalList", "",
            object<SignalList>({output_only("signals", &SignalList::signals, list(signal_format()),
                                            "In the order of the cell file")}));
  return format;
}

FormatPtr<SignalRequest> signal_request_format() {
  static const auto format =
      named("SignalRequest", "",
            object<SignalRequest>({required("value", &SignalRequest::value, signal_value_format(),
                                            "true or false, or a whole number from 0 to 65535")}));
  return format;
}

Result<SignalRequest> read_signal_request(std::string_view text) {
  return read_text(*signal_request_format(), text);
}

}  // namespace armloom
