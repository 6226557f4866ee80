#include "server/messages/control.h"

#include <nlohmann/json.hpp>

#include "server/codec/object_format.h"
#include "server/codec/output_part.h"
#include "server/codec/read_text.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"
#include "server/messages/job.h"
#include "server/messages/job_request.h"
#include "server/messages/plan_goal.h"
#include "server/messages/who.h"

namespace armloom {

using namespace formats;

FormatPtr<ControlRequest> control_request_format() {
  using Asked = ControlRequest;
  static const auto format = named(
      "ControlRequest", "",
      object<Asked>({
          field("who", &Asked::who, who_format(),
                "Name shown for the caller; with tokens, the token's name applies instead"),
          field("take", &Asked::take, flag(),
                "Take control from its present holder, whose jog motion then brakes on its path"),
      }));
  return format;
}

Result<ControlRequest> read_control_request(std::string_view text) {
  return read_text(*control_request_format(), text);
}

namespace {

FormatPtr<ControlView::Holder> holder_format() {
  using Holder = ControlView::Holder;
  static const auto format = named(
      "ControlHolder", "",
      object<Holder>({
          output_only("who", &Holder::who, text()),
          output_only("since_at", &Holder::since_at, text(), "RFC 3339, UTC"),
          output_only("arm", &Holder::arm, nullable(text()), "The arm that the holder jogged last"),
          output_only("job", &Holder::job, nullable(job_id_format()), "The job of that jog"),
      }));
  return format;
}

}  // namespace

FormatPtr<ControlView> control_format() {
  static const auto format =
      named("Control", "The client that may jog arms; one client at a time.",
            object<ControlView>({
                output_only("holder", &ControlView::holder, nullable(holder_format()),
                            "null if no client has control"),
            }));
  return format;
}

FormatPtr<ControlView> control_taken_format() {
  static const auto format =
      named("ControlTaken", "",
            object<ControlView>({
                output_only("holder", &ControlView::holder, nullable(holder_format())),
                output_if("key", &ControlView::key, text(),
                          "Secret, required by every jog request; returned only here"),
            }));
  return format;
}

FormatPtr<ControlKey> control_key_format() {
  static const auto format =
      named("ControlKey", "",
            object<ControlKey>({required("control", &ControlKey::control, name(),
                                         "The key that POST /control returned")}));
  return format;
}

Result<ControlKey> read_control_key(std::string_view text) {
  return read_text(*control_key_format(), text);
}

FormatPtr<JogRequest> jog_request_format() {
  using Jog = JogRequest;
  static const auto format =
      named("JogRequest", "",
            object<Jog>({
                required("control", &Jog::control, name(), "The key that POST /control returned"),
                required("to", &Jog::to, plan_goal_format(), "The goal of the motion"),
                field("velocity_scaling_factor", &Jog::speed, number({0.001, kJogSpeedMax}),
                      "Share of the joints' speed limits"),
            }));
  return format;
}

Result<JogRequest> read_jog_request(std::string_view text) {
  return read_text(*jog_request_format(), text);
}

std::string job_text_of(const JogRequest& jog, const std::string& arm) {
  return nlohmann::json{{"arm", arm},
                        {"move_to", nlohmann::json::parse(text_of(*plan_goal_format(), jog.to))},
                        {"velocity_scaling_factor", jog.speed},
                        {"name", "jog " + arm}}
      .dump();
}

FormatPtr<JogView> jog_format() {
  static const auto format =
      named("Jog", "A jog motion in its present state.",
            object<JogView>({
                output_only("job", &JogView::job, job_format()),
                output_only("lease_s", &JogView::lease_s, number(kPositive),
                            "The arm brakes if no renewal arrives for this long (wall time)"),
            }));
  return format;
}

}  // namespace armloom
