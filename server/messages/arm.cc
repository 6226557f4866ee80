#include "server/messages/arm.h"

#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/told_part.h"
#include "server/codec/value_formats.h"

namespace armloom {

using namespace formats;

FormatPtr<ArmView> arm_format() {
  static const auto format = [] {
    const auto state = named("ArmState", "", choice<ArmState>());
    return named("Arm", "",
                 object<ArmView>({
                     told("name", &ArmView::name, text()),
                     told("robot", &ArmView::robot, text()),
                     told("state", &ArmView::state, state),
                     told("job", &ArmView::job, text_or_null(),
                          "Id of the job that the arm executes, moving or paused; null if none"),
                     told("progress", &ArmView::progress, number({0.0, 1.0})),
                     told("joints", &ArmView::joints, list(text())),
                     told("q", &ArmView::q, number_list(),
                          "Measured joint positions in the order of `joints`: rad or m"),
                     told("home", &ArmView::home, number_list()),
                     told("deviation_rad", &ArmView::deviation_rad, number({0.0}),
                          "Measured deviation of the worst joint from the path"),
                 }));
  }();
  return format;
}

FormatPtr<std::vector<ArmView>> arm_list_format() {
  using List = std::vector<ArmView>;
  static const auto format =
      named("ArmList", "",
            object<List>({told(
                "arms", [](const List& arms) { return &arms; }, list(arm_format()))}));
  return format;
}

FormatPtr<Stopped> stopped_format() {
  static const auto format =
      named("Stopped", "", object<Stopped>({told("stopped", &Stopped::stopped, flag())}));
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
                           told("t_s", &Ready::now, cell_time(), "Present cell time")}));
  return format;
}

}  // namespace armloom
