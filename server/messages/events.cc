#include "server/messages/events.h"

#include <type_traits>
#include <variant>

#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/output_part.h"
#include "server/codec/read_text.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"
#include "server/messages/arm.h"
#include "server/messages/job.h"
#include "server/messages/scene.h"
#include "server/messages/signal.h"

namespace armloom {

using namespace formats;

namespace {

FormatPtr<MonitorEvent> monitor_event_format() {
  using Kind = MonitorFinding::Kind;
  using Told = MonitorEvent;
  const auto links = [](const Told& event) {
    return std::pair(event.finding.proximity.body_a, event.finding.proximity.body_b);
  };
  const auto of_pair = [](auto value) {
    return [value](const Told& event) {
      return is_about_pair(event.finding.kind) ? std::optional(value(event)) : std::nullopt;
    };
  };
  const auto of_premise = [](auto value) {
    return [value](const Told& event) {
      return is_about_pair(event.finding.kind) ? std::nullopt : std::optional(value(event));
    };
  };
  return named(
      "MonitorFinding",
      "`contact`, `clearance`: two bodies are too close. `approach`: two bodies will be too close "
      "unless an arm stops now. The other kinds report a violated premise of the certificates: an "
      "arm that is not where it should be, or feedback that is late, frozen or implausible.",
      object<Told>({
          output_only(
              "kind", [](const Told& event) { return event.finding.kind; }, choice<Kind>()),
          output_only("text", &Told::text, text(), "One sentence"),
          output_only("arms", &Told::arms, list(text()),
                      "Arms of the pair, or the arm that violates a premise"),
          output_if("links", of_pair(links), pair_of(text())),
          output_if("clearance_m",
                    of_pair([](const Told& event) { return event.finding.proximity.clearance_m; }),
                    number(kAnyNumber), "Clearance found"),
          output_if("limit_m", of_pair([](const Told& event) { return event.finding.limit_m; }),
                    number(kAnyNumber), "Clearance required"),
          output_if(
              "joint",
              [](const Told& event) {
                return event.joint.empty() ? std::nullopt : std::optional(event.joint);
              },
              text(), "Joint that exceeds the limit most"),
          output_if("value", of_premise([](const Told& event) { return event.finding.value; }),
                    number(kAnyNumber), "Measured value: rad or m with `joint`, else s"),
          output_if("limit", of_premise([](const Told& event) { return event.finding.limit; }),
                    number(kAnyNumber), "Largest permitted value"),
          output_only("stopped", &Told::stopped, list(text()), "Arms that the monitor stopped"),
      }));
}

FormatPtr<ProgressBox> progress_box_format() {
  using Box = ProgressBox;
  return named("ProgressBox", "A rectangle of two motions. Times are trajectory time.",
               object<Box>({
                   output_only("from_s", &Box::from_a, seconds(kAnyNumber),
                               "Interval of the arm's own motion"),
                   output_only("to_s", &Box::to_a, seconds(kAnyNumber)),
                   output_only("other_from_s", &Box::from_b, seconds(kAnyNumber),
                               "Interval of the other motion"),
                   output_only("other_to_s", &Box::to_b, seconds(kAnyNumber)),
               }));
}

FormatPtr<GuardEvent> guard_event_format() {
  using Told = GuardEvent;
  const auto asked = [](const Told& event) { return &event.refusal.asked; };
  const auto region = [](const Told& event) { return event.refusal.region; };
  return named(
      "GuardFinding",
      "The authority guard refused movement authority that the scheduler had granted. This is a "
      "defect of the scheduler; the arm has not moved.",
      object<Told>({
          output_only(
              "kind", [](const Told& event) { return event.refusal.why; },
              choice<GuardRefusal::Why>(),
              "Reason. `uncertified`: no certificate covers the authority; `region`: the authority "
              "enters a conflict region out of order; `busy`: the arm is on another motion; "
              "`out_of_step`: the arms of one motion are too far apart in progress"),
          output_only("arm", &Told::arm, text()),
          output_only("job", &Told::job, text()),
          output_only(
              "other_arm", &Told::other_arm, text(),
              "Other arm; empty if the refusal concerns the scene or only the arms of this motion"),
          output_only("other_job", &Told::other_job, text(), "Last job of the other arm, or empty"),
          output_only("asked", asked, progress_box_format(),
                      "Authority that was refused: from the present progress of both arms to their "
                      "authority"),
          output_if("region", region, progress_box_format(),
                    "First rectangle of the conflict region that `asked` overlaps"),
      }));
}

FormatPtr<Alert> alert_format() {
  using Level = Alert::Level;
  return named("Alert", "",
               object<Alert>({
                   output_only("level", &Alert::level, choice<Level>()),
                   output_only("text", &Alert::text, text()),
               }));
}

FormatPtr<SnapshotView> snapshot_format() {
  using View = SnapshotView;
  const auto gap = [](const View& view) { return view.gap ? std::optional(true) : std::nullopt; };
  return named(
      "Snapshot", "",
      object<View>({
          output_only(
              "cell", [](const View& view) { return view.cell->name; }, text()),
          output_only(
              "policy", [](const View& view) { return view.snapshot->queue.policy; }, text()),
          output_only("speed", &View::speed, number(kPositive)),
          output_only(
              "stopped", [](const View& view) { return view.snapshot->queue.stopped; }, flag()),
          output_if(
              "speed_override",
              [](const View& view) { return std::optional(view.snapshot->queue.speed_override); },
              number({0.0, 1.0}), "Speed override of the cell; absent in old recordings"),
          output_only(
              "arms", [](const View& view) { return &view.snapshot->arms; }, list(arm_format())),
          output_only(
              "jobs", [](const View& view) { return view.jobs; }, list(listed_job_format()),
              "All jobs that have not ended, and the 200 that ended last"),
          output_only(
              "queue", [](const View& view) { return &view.snapshot->queue; }, queue_ids_format()),
          output_only(
              "objects", [](const View& view) { return &view.snapshot->scene.objects(); },
              list(object_format())),
          output_if(
              "held",
              [](const View& view) {
                const auto& held = view.snapshot->scene.held;
                return held.empty() ? std::nullopt : std::optional(held);
              },
              list(held_format()), "Objects that arms hold, if there are any"),
          output_if(
              "io",
              [](const View& view) {
                const auto& signals = view.snapshot->signals;
                return signals.empty() ? std::nullopt : std::optional(signals);
              },
              list(signal_format()), "Inputs and outputs, if the cell has any"),
          output_if("gap", gap, flag(), "true if events before this snapshot were lost"),
      }));
}

struct EventHead {
  const std::string* stream;
  std::uint64_t seq;
  TimePoint time;
};
template <class T>
struct Envelope {
  EventHead head;
  const T* data;
};

// The member "at": wall time of the event. Not written if the writer does not know wall time.
class AtPart final : public AnyPart {
 public:
  void list_keys(std::vector<std::string_view>& keys) const override { keys.push_back("at"); }
  void read_any(const JsonNode&, void*) const override {}
  void write_any(JsonWriter& out, const void* head) const override {
    if (out.knows_wall_time()) {
      out.key("at").wall_time(static_cast<const EventHead*>(head)->time);
    }
  }
  void describe_any(Schema& object, const void*, Way way) const override {
    describe_member(object, {"at", "Wall time of the event", Need::required, {}},
                    {{"type", "string"}, {"format", "date-time"}}, std::nullopt, way);
  }
};

FormatPtr<std::string> stream_format() {
  return text(
      TextRule{[](std::string_view) { return true; }, "bad-stream", "", {{"format", "uuid"}}});
}

PartPtr<EventHead> head_part(const char* type) {
  using Head = EventHead;
  return parts<Head>({
      output_only(
          "stream", [](const Head& head) { return head.stream; }, stream_format(),
          "UUID of this server session"),
      output_only("seq", &Head::seq, count(), "Number of the event; consecutive within a stream"),
      constant<Head>("type", type),
      output_only("t_s", &Head::time, cell_time(), "Cell time of the event"),
      PartPtr<Head>(AnyPartPtr(new AtPart)),
  });
}

template <class T>
struct EventKind {
  const char* type;
  const char* name;
  FormatPtr<Envelope<T>> format;
};
template <class T>
EventKind<T> event_kind(const char* type, const char* name, const FormatPtr<T>& data) {
  using E = Envelope<T>;
  return {type, name,
          named(name, "",
                object<E>({
                    inlined(&E::head, head_part(type)),
                    output_only("data", &E::data, data),
                }))};
}

struct Kinds {
  EventKind<SnapshotView> snapshot = event_kind("snapshot", "SnapshotEvent", snapshot_format());
  EventKind<JobView> job = event_kind("job", "JobEvent", job_format());
  EventKind<ArmView> arm = event_kind("arm", "ArmEvent", arm_format());
  EventKind<QueueView> queue = event_kind("queue", "QueueEvent", queue_ids_format());
  EventKind<SceneView> scene = event_kind("scene", "SceneEvent", scene_format());
  EventKind<SignalView> io = event_kind("io", "IoEvent", signal_format());
  EventKind<MonitorEvent> monitor = event_kind("monitor", "MonitorEvent", monitor_event_format());
  EventKind<GuardEvent> guard = event_kind("guard", "GuardEvent", guard_event_format());
  EventKind<Alert> alert = event_kind("alert", "AlertEvent", alert_format());

  template <class Each>
  void each(Each each) const {
    each(snapshot), each(job), each(arm), each(queue), each(scene), each(io), each(monitor),
        each(guard), each(alert);
  }
  const auto& of(const JobView&) const { return job; }
  const auto& of(const ArmView&) const { return arm; }
  const auto& of(const QueueView&) const { return queue; }
  const auto& of(const SceneView&) const { return scene; }
  const auto& of(const SignalView&) const { return io; }
  const auto& of(const MonitorEvent&) const { return monitor; }
  const auto& of(const GuardEvent&) const { return guard; }
  const auto& of(const Alert&) const { return alert; }
};
const Kinds& kinds() {
  static const Kinds kinds;
  return kinds;
}

// Writes numbers with 6 decimals, because poses are for display only.
class Rounded final : public CustomFormat<double> {
 public:
  void read(const JsonNode&, double&) const override {}
  void write(JsonWriter& out, const double& number) const override { out.rounded(number, 6); }
  Schema schema(Way) const override { return {{"type", "number"}}; }
};
FormatPtr<double> rounded() { return make_format<Rounded>(); }

struct NearView {
  const Proximity* proximity;
  const Cell* cell;
};
FormatPtr<NearView> near_format() {
  using View = NearView;
  const auto arms = [](const View& near) {
    std::vector<std::string> names;
    for (const auto& arm : {near.proximity->arm_a, near.proximity->arm_b}) {
      if (arm) names.push_back(near.cell->arm(*arm).name);
    }
    return names;
  };
  const auto links = [](const View& near) {
    return std::pair(near.proximity->body_a, near.proximity->body_b);
  };
  return object<View>({
      output_only("arms", arms, list(text(), {.fewest = 1, .most = 2}),
                  "Names of two arms; or of one arm, if the other body is an object or a link that "
                  "no arm moves"),
      output_only(
          "m", [](const View& near) { return near.proximity->clearance_m; }, rounded()),
      output_only("links", links, pair_of(text())),
  });
}

FormatPtr<ArmAuthority> authority_format() {
  using Told = ArmAuthority;
  return named(
      "ArmAuthority",
      "Progress and movement authority of an arm on its motion. Times are trajectory time.",
      object<Told>({
          output_only("arm", &Told::arm, text()),
          output_only("job", &Told::job, text()),
          output_only("progress_s", &Told::progress, seconds(kAnyNumber), "Measured progress"),
          output_only(
              "authority_s", &Told::authority, seconds({0.0}),
              "Movement authority: the arm stops at this time unless more authority is granted"),
      }));
}

struct FrameView {
  const StateFrame* frame;
  const Cell* cell;
  double speed;
};
// Writes {"<joint>": position} in the cell's joint order.
class PosesFormat final : public CustomFormat<FrameView> {
 public:
  void read(const JsonNode&, FrameView&) const override {}
  void write(JsonWriter& out, const FrameView& view) const override {
    out.begin_object();
    for (std::size_t i = 0; i < view.cell->joints.size(); ++i) {
      out.key(view.cell->joints[i].name);
      number_->write(out, view.frame->q[static_cast<Eigen::Index>(i)]);
    }
    out.end_object();
  }
  Schema schema(Way way) const override {
    return {{"type", "object"}, {"additionalProperties", number_->schema(way)}};
  }

 private:
  FormatPtr<double> number_ = rounded();
};

FormatPtr<FrameView> frame_format() {
  using View = FrameView;
  const auto near = [](const View& view) {
    std::vector<NearView> all;
    for (const Proximity& proximity : view.frame->clearance) all.push_back({&proximity, view.cell});
    return all;
  };
  static const auto format = named(
      "StateFrame", "Measured positions at about 30 Hz of wall time; dropped for slow subscribers.",
      object<View>({
          constant<View>("type", "state"),
          output_only(
              "t_s", [](const View& view) { return view.frame->time; }, cell_time()),
          output_only(
              "q", [](const View& view) { return &view; }, make_format<PosesFormat>(),
              "Position of every joint of the cell, by name: rad or m"),
          output_only("clearance", near, list(near_format())),
          output_only(
              "motions", [](const View& view) { return &view.frame->motions; },
              list(authority_format()), "One entry for each arm that has a motion"),
          output_only("speed", &View::speed, number(kPositive),
                      "Seconds of cell time per second of wall time"),
      }));
  return format;
}

}  // namespace

std::string event_json(const Event& event, const std::string& stream, const WallClock* clock) {
  return std::visit(
      [&](const auto& body) {
        return text_of(*kinds().of(body).format, {{&stream, event.seq, event.time}, &body}, clock);
      },
      event.body);
}

std::string snapshot_json(const SnapshotView& view, const std::string& stream,
                          const WallClock& clock) {
  const Snapshot& snapshot = *view.snapshot;
  return text_of(*kinds().snapshot.format, {{&stream, snapshot.seq, snapshot.time}, &view}, &clock);
}

std::string state_json(const StateFrame& frame, const Cell& cell, double speed) {
  return text_of(*frame_format(), {&frame, &cell, speed});
}

std::vector<std::pair<std::string, std::string>> message_types() {
  std::vector<std::pair<std::string, std::string>> types;
  kinds().each([&](const auto& kind) { types.emplace_back(kind.type, kind.name); });
  types.emplace_back("state", "StateFrame");
  return types;
}

Schema message_schema() {
  Schema all = Schema::array();
  kinds().each([&](const auto& kind) { all.push_back(kind.format->schema(Way::out)); });
  all.push_back(frame_format()->schema(Way::out));
  return named_schema("Message", "A message on WebSocket or SSE.", {{"oneOf", std::move(all)}});
}

}  // namespace armloom
