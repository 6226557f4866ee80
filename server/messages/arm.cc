#include "server/messages/arm.h"

#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/output_part.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"

namespace armloom {

using namespace formats;

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
            output_only("link", &ArmView::link, choice<ArmLink::State>(),
                        "Link to the arm's controller. connecting: no report yet. stale: reports "
                        "are late, and the arm gets no more authority. lost: the arm is stopped "
                        "until it is resumed"),
            output_only("link_detail", &ArmView::link_detail, text_or_null(),
                        "Why the link is not up; null if it is"),
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
                             output_only("not_resumed", &Stopped::not_resumed, list(text()),
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
