#include "server/messages/measured_states.h"

#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/output_part.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"

namespace armloom {

using namespace formats;

namespace {

// Writes positions with 6 decimals, because they are for display only.
class RoundedPositions final : public CustomFormat<Configuration> {
 public:
  void read(const JsonNode&, Configuration&) const override {}
  void write(JsonWriter& out, const Configuration& q) const override {
    out.begin_array();
    for (const double position : q) out.rounded(position, 6);
    out.end_array();
  }
  Schema schema(Way) const override { return {{"type", "array"}, {"items", {{"type", "number"}}}}; }
};

}  // namespace

FormatPtr<MeasuredStates> measured_states_format() {
  static const auto format =
      named("MeasuredStates", "",
            object<MeasuredStates>({
                output_only("stream", &MeasuredStates::stream, text(),
                            "UUID of the server session, as in events"),
                output_only("joints", &MeasuredStates::joints, list(text()),
                            "Names of all joints of the cell"),
                output_only("t_s", &MeasuredStates::times, list(cell_time()),
                            "Cell times of the samples, ascending"),
                output_only("q", &MeasuredStates::q, list(make_format<RoundedPositions>()),
                            "Positions at each time, in the order of `joints`: rad or m"),
            }));
  return format;
}

}  // namespace armloom
