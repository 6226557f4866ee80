#include "server/messages/arm.h"

#include <optional>
#include <string>

#include "core/executive/executive.h"
#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/output_part.h"
#include "server/codec/read_text.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"

namespace armloom {

using namespace formats;

namespace {

// 0, or SpeedOverride::kSmallestShare to 1.
class ShareFormat final : public CustomFormat<double> {
 public:
  void read(const JsonNode& node, double& out) const override {
    double share = 0.0;
    if (!node.read(share)) return;
    if (SpeedOverride::is_valid(share)) return void(out = share);
    node.invalid("out-of-range", "a speed override is 0, or from " + smallest() + " to 1");
  }
  void write(JsonWriter& out, const double& share) const override { out.value(share); }
  Schema schema(Way) const override {
    const Schema moving{
        {"type", "number"}, {"minimum", SpeedOverride::kSmallestShare}, {"maximum", 1.0}};
    return {{"anyOf", {Schema{{"const", 0}}, moving}}};
  }

 private:
  static std::string smallest() { return Schema(SpeedOverride::kSmallestShare).dump(); }
};

PartPtr<ArmView> arm_speed_part() {
  const auto own = [](const ArmView& arm) { return std::optional(arm.speed_override); };
  const auto effective = [](const ArmView& arm) {
    return std::optional(arm.effective_speed_override);
  };
  return parts<ArmView>({
      output_if("speed_override", own, number({0.0, 1.0}),
                "Speed override of this arm: largest share of the planned speed; absent in old "
                "recordings"),
      output_if("effective_speed_override", effective, number({0.0, 1.0}),
                "Override at which the arm moves: cell's override x this arm's x what its payload "
                "leaves. The arms of one motion all move at the smallest of theirs"),
  });
}

}  // namespace

FormatPtr<SpeedShare> speed_override_format() {
  static const auto format = named(
      "SpeedOverride", "",
      object<SpeedShare>({required(
          "speed_override", &SpeedShare::share, FormatPtr<double>(make_format<ShareFormat>()),
          "Largest share of the planned speed: 0, or 0.001 to 1. At 0 the arms come to rest on "
          "their paths until it is raised")}));
  return format;
}

Result<SpeedShare> read_speed_override(std::string_view text) {
  return read_text(*speed_override_format(), text);
}

FormatPtr<ArmView> arm_speed_format() {
  static const auto format =
      named("ArmSpeedOverride", "",
            object<ArmView>({output_only("name", &ArmView::name, text()), arm_speed_part()}));
  return format;
}

FormatPtr<ArmView> arm_format() {
  static const auto format = [] {
    const auto state = named("ArmState", "", choice<ArmState>());
    return named(
        "Arm", "",
        object<ArmView>({
            output_only("name", &ArmView::name, text()),
            output_only("robot", &ArmView::robot, text()),
            output_only("state", &ArmView::state, state),
            output_only("job", &ArmView::job, text_or_null(),
                        "Id of the job that the arm executes, moving or paused; null if none"),
            output_only("progress", &ArmView::progress, number({0.0, 1.0})),
            output_only("joints", &ArmView::joints, list(text())),
            output_only("q", &ArmView::q, number_list(),
                        "Measured joint positions in the order of `joints`: rad or m"),
            output_only("home", &ArmView::home, number_list()),
            output_only("deviation_rad", &ArmView::deviation_rad, number({0.0}),
                        "Largest measured deviation of a joint from the path"),
            output_only("deviation_max_rad", &ArmView::deviation_max_rad, number({0.0}),
                        "Largest `deviation_rad` since the session began"),
            output_only("link", &ArmView::link, choice<ArmLink::State>(),
                        "Link to the arm's controller. connecting: no report yet. stale: reports "
                        "are late, and the arm gets no more authority. lost: the arm is stopped "
                        "until it is resumed"),
            output_only("link_detail", &ArmView::link_detail, text_or_null(),
                        "Why the link is not up; null if it is"),
            output_only("drives_on", &ArmView::drives_on, flag(),
                        "False after a stop of category 0 or 1, until the arm's next motion"),
            output_only("stop_cause", &ArmView::stop_cause, text_or_null(),
                        "Why the arm is stopped until it is resumed; null if it is not stopped"),
            arm_speed_part(),
        }));
  }();
  return format;
}

FormatPtr<std::vector<ArmView>> arm_list_format() {
  using List = std::vector<ArmView>;
  static const auto format =
      named("ArmList", "",
            object<List>({output_only(
                "arms", [](const List& arms) { return &arms; }, list(arm_format()))}));
  return format;
}

FormatPtr<Stopped> stopped_format() {
  static const auto format =
      named("Stopped", "",
            object<Stopped>({output_only("stopped", &Stopped::stopped, flag()),
                             output_if(
                                 "category", [](const Stopped& now) { return now.category; },
                                 integer(0, 2), "Stop category; only in the answer to a stop"),
                             output_if(
                                 "not_resumed",
                                 [](const Stopped& now) {
                                   return now.not_resumed.empty() ? std::nullopt
                                                                  : std::optional(now.not_resumed);
                                 },
                                 list(text()),
                                 "Arms that stay stopped, because the link to their "
                                 "controller is not up")}));
  return format;
}

FormatPtr<Health> health_format() {
  static const auto format =
      named("Health", "", object<Health>({constant<Health>("status", "ok")}));
  return format;
}

FormatPtr<Ready> ready_format() {
  static const auto format =
      named("Ready", "",
            object<Ready>({constant<Ready>("ready", true),
                           output_only("t_s", &Ready::now, cell_time(), "Present cell time")}));
  return format;
}

}  // namespace armloom
