#include "server/messages/control.h"

#include <nlohmann/json.hpp>

#include "server/codec/object_format.h"
#include "server/codec/read_text.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/told_part.h"
#include "server/codec/value_formats.h"
#include "server/messages/job.h"
#include "server/messages/job_request.h"
#include "server/messages/plan_goal.h"
#include "server/messages/who.h"

namespace armloom {

using namespace formats;

FormatPtr<ControlRequest> control_request_format() {
  using Asked = ControlRequest;
  static const auto format =
      named("ControlRequest", "",
            object<Asked>({
                field("who", &Asked::who, who_format(),
                      "Whoever asks; where tokens are asked for, the token's name counts instead"),
                field("take", &Asked::take, flag(),
                      "From whoever holds it: what they hold to run brakes on its path"),
            }));
  return format;
}

Result<ControlRequest> read_control_request(std::string_view text) {
  return read_text(*control_request_format(), text);
}

namespace {

FormatPtr<ControlView::Holder> holder_format() {
  using Holder = ControlView::Holder;
  static const auto format =
      named("ControlHolder", "",
            object<Holder>({
                told("who", &Holder::who, text()),
                told("since_at", &Holder::since_at, text(), "RFC 3339, UTC"),
                told("arm", &Holder::arm, nullable(text()), "That they moved by hand last"),
                told("job", &Holder::job, nullable(job_id_format()), "By this job"),
            }));
  return format;
}

}  // namespace

FormatPtr<ControlView> control_format() {
  static const auto format =
      named("Control", "Who may move arms by hand.",
            object<ControlView>({
                told("holder", &ControlView::holder, nullable(holder_format()), "null: nobody"),
            }));
  return format;
}

FormatPtr<ControlView> control_taken_format() {
  static const auto format =
      named("ControlTaken", "",
            object<ControlView>({
                told("holder", &ControlView::holder, nullable(holder_format())),
                told_if("key", &ControlView::key, text(),
                        "To be shown with every move by hand; told this once"),
            }));
  return format;
}

FormatPtr<ControlKey> control_key_format() {
  static const auto format =
      named("ControlKey", "",
            object<ControlKey>({required("control", &ControlKey::control, name(),
                                         "The key that POST /control answered")}));
  return format;
}

Result<ControlKey> read_control_key(std::string_view text) {
  return read_text(*control_key_format(), text);
}

FormatPtr<HoldRequest> hold_request_format() {
  using Hold = HoldRequest;
  static const auto format =
      named("HoldRequest", "",
            object<Hold>({
                required("control", &Hold::control, name(), "The key that POST /control answered"),
                required("to", &Hold::to, plan_goal_format(), "Where the arm is to go"),
                field("velocity_scaling_factor", &Hold::speed, number({0.001, kHoldSpeedMax}),
                      "The share of its speed at which it goes"),
            }));
  return format;
}

Result<HoldRequest> read_hold_request(std::string_view text) {
  return read_text(*hold_request_format(), text);
}

std::string job_text_of(const HoldRequest& hold, const std::string& arm) {
  return nlohmann::json{{"arm", arm},
                        {"move_to", nlohmann::json::parse(text_of(*plan_goal_format(), hold.to))},
                        {"velocity_scaling_factor", hold.speed},
                        {"name", arm + " by hand"}}
      .dump();
}

FormatPtr<HoldView> hold_format() {
  static const auto format =
      named("Hold", "A move by hand, as it is now.",
            object<HoldView>({
                told("job", &HoldView::job, job_format()),
                told("lease_s", &HoldView::lease_s, number(kPositive),
                     "The arm brakes when it is not renewed for so long, in wall time"),
            }));
  return format;
}

}  // namespace armloom
