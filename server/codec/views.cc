#include "server/codec/views.h"

#include <cstdio>
#include <random>
#include <type_traits>
#include <variant>

#include "server/codec/cell_codec.h"

namespace armloom {
namespace {

void write_name_or_null(JsonWriter& out, std::string_view key, const std::string& name) {
  out.key(key);
  if (name.empty()) {
    out.value(nullptr);
  } else {
    out.value(name);
  }
}

// "started_s": cell time or null, "started_at": wall time or null (absent without a clock).
void write_time(JsonWriter& out, const std::string& what, std::optional<TimePoint> time,
                const WallClock* clock) {
  out.field(what + "_s", time);
  if (clock == nullptr) return;
  out.key(what + "_at");
  if (time) {
    out.value(clock->at(*time));
  } else {
    out.value(nullptr);
  }
}

void write_wait(JsonWriter& out, const WaitView& wait) {
  out.begin_object().field("kind", to_string(wait.kind));
  write_name_or_null(out, "id", wait.job);
  write_name_or_null(out, "arm", wait.arm);
  out.field("links", wait.links).field("own_time_s", wait.own_time_s);
  out.field("other_time_s", wait.other_time_s).field("clearance_m", wait.clearance_m);
  if (!wait.detail.empty()) out.field("detail", wait.detail);
  out.end_object();
}

const char* type_of(const JobView&) { return "job"; }
const char* type_of(const ArmView&) { return "arm"; }
const char* type_of(const QueueView&) { return "queue"; }
const char* type_of(const SceneView&) { return "scene"; }
const char* type_of(const MonitorEvent&) { return "monitor"; }
const char* type_of(const Alert&) { return "alert"; }

void write(JsonWriter& out, const QueueView& queue) {
  out.begin_object().field("stopped", queue.stopped).field("queued", queue.queued);
  out.field("backlog", queue.backlog).field("scheduled", queue.scheduled);
  out.field("running", queue.running).end_object();
}

void write(JsonWriter& out, const SceneView& scene) {
  out.begin_object().field("version", static_cast<std::int64_t>(scene.version)).key("objects");
  write_objects(out, scene.objects);
  out.end_object();
}

void write(JsonWriter& out, const MonitorEvent& event) {
  const MonitorFinding& finding = event.finding;
  const bool contact = finding.kind == MonitorFinding::Kind::contact;
  out.begin_object().field("kind", contact ? "contact" : "clearance").field("arms", event.arms);
  out.key("links").begin_array().value(finding.proximity.body_a).value(finding.proximity.body_b);
  out.end_array().field("clearance_m", finding.proximity.clearance_m);
  out.field("limit_m", finding.limit_m).field("stopped", event.stopped).end_object();
}

void write(JsonWriter& out, const Alert& alert) {
  const char* level = alert.level == Alert::Level::info      ? "info"
                      : alert.level == Alert::Level::warning ? "warning"
                                                             : "error";
  out.begin_object().field("level", level).field("text", alert.text).end_object();
}

void begin_envelope(JsonWriter& out, const std::string& stream, std::uint64_t seq, const char* type,
                    TimePoint time, const WallClock* clock) {
  out.begin_object().field("stream", stream).field("seq", seq).field("type", type);
  out.field("t_s", time);
  if (clock != nullptr) out.field("at", clock->at(time));
  out.key("data");
}

void write(JsonWriter& out, const DiagramView::Side& side) {
  out.begin_object().field("id", side.job).field("state", to_string(side.state));
  out.field("duration_s", side.duration).field("progress_s", side.progress).end_object();
}

void write(JsonWriter& out, const DiagramCell& cell) {
  const char* state = cell.state == DiagramCell::State::free       ? "free"
                      : cell.state == DiagramCell::State::conflict ? "conflict"
                                                                   : "undecided";
  out.begin_object().field("state", state);
  out.key("a_s").begin_array().value(cell.from_a).value(cell.to_a).end_array();
  out.key("b_s").begin_array().value(cell.from_b).value(cell.to_b).end_array().end_object();
}

std::string uuid(std::uint64_t high, std::uint64_t low, unsigned version) {
  high = (high & ~0xF000ULL) | (static_cast<std::uint64_t>(version) << 12U);
  low = (low & 0x3FFF'FFFF'FFFF'FFFFULL) | 0x8000'0000'0000'0000ULL;  // RFC 9562 variant
  char text[40];
  std::snprintf(text, sizeof text, "%08x-%04x-%04x-%04x-%012llx",
                static_cast<unsigned>(high >> 32U), static_cast<unsigned>((high >> 16U) & 0xFFFFU),
                static_cast<unsigned>(high & 0xFFFFU), static_cast<unsigned>(low >> 48U),
                static_cast<unsigned long long>(low & 0xFFFF'FFFF'FFFFULL));
  return text;
}

}  // namespace

void write(JsonWriter& out, const JobView& job, const WallClock* clock) {
  out.begin_object().field("id", job.key).field("name", job.name);
  out.field("state", to_string(job.state)).field("arms", job.arms).field("priority", job.priority);
  write_time(out, "submitted", job.submitted_at, clock);
  write_time(out, "scheduled", job.scheduled_at, clock);
  write_time(out, "started", job.started_at, clock);
  write_time(out, "ended", job.ended_at, clock);
  out.field("progress", job.progress).field("duration_s", job.duration);
  out.field("stopping", job.stopping).key("waits_on").begin_array();
  for (const WaitView& wait : job.waits_on) write_wait(out, wait);
  out.end_array().field("ring", job.ring).key("result");
  if (job.reason) {
    out.begin_object().field("reason", to_string(*job.reason)).field("detail", job.detail);
    out.end_object();
  } else {
    out.value(nullptr);
  }
  out.end_object();
}

void write(JsonWriter& out, const ArmView& arm) {
  out.begin_object().field("name", arm.name).field("robot", arm.robot);
  out.field("state", to_string(arm.state));
  write_name_or_null(out, "job", arm.job);
  out.field("progress", arm.progress).field("joints", arm.joints).field("q", arm.q);
  out.field("home", arm.home).field("deviation_rad", arm.deviation_rad).end_object();
}

void write_fields(JsonWriter& out, const CheckView& verdict) {
  const char* kind = verdict.kind == Verdict::Kind::free       ? "free"
                     : verdict.kind == Verdict::Kind::conflict ? "conflict"
                                                               : "undecided";
  out.field("verdict", kind).field("earliest_start_s", verdict.earliest_start_s);
  out.field("clearance_bound_m", verdict.clearance_bound_m).key("conflicts").begin_array();
  for (const WaitView& wait : verdict.conflicts) write_wait(out, wait);
  out.end_array().field("evaluations", verdict.evaluations);
  out.field("scene_version", verdict.scene_version);
}

void write(JsonWriter& out, const CheckView& verdict) {
  out.begin_object();
  write_fields(out, verdict);
  out.end_object();
}

void write(JsonWriter& out, const DiagramView& diagram) {
  out.begin_object().field("t_s", diagram.time).key("a");
  write(out, diagram.a);
  out.key("b");
  write(out, diagram.b);
  out.key("layers").begin_array();
  for (const DiagramView::Layer& layer : diagram.layers) {
    out.begin_object().key("arms").begin_array().value(layer.arm_a).value(layer.arm_b).end_array();
    out.key("cells").begin_array();
    for (const DiagramCell& cell : layer.cells) write(out, cell);
    out.end_array().end_object();
  }
  out.end_array().field("evaluations", diagram.evaluations);
  out.field("scene_version", diagram.scene_version).end_object();
}

std::string event_json(const Event& event, const std::string& stream, const WallClock* clock) {
  JsonWriter out;
  const char* type = std::visit([](const auto& body) { return type_of(body); }, event.body);
  begin_envelope(out, stream, event.seq, type, event.time, clock);
  std::visit(
      [&](const auto& body) {
        if constexpr (std::is_same_v<std::decay_t<decltype(body)>, JobView>) {
          write(out, body, clock);
        } else {
          write(out, body);
        }
      },
      event.body);
  out.end_object();
  return out.take();
}

std::string snapshot_json(const Snapshot& snapshot, const Cell& cell, const std::string& stream,
                          double speed, const WallClock& clock, bool gap) {
  JsonWriter out;
  begin_envelope(out, stream, snapshot.seq, "snapshot", snapshot.time, &clock);
  out.begin_object().field("cell", cell.name).field("policy", snapshot.queue.policy);
  out.field("speed", speed).field("stopped", snapshot.queue.stopped);
  out.key("arms").begin_array();
  for (const ArmView& arm : snapshot.arms) write(out, arm);
  out.end_array().key("jobs").begin_array();
  for (const JobView& job : snapshot.jobs) write(out, job, &clock);
  out.end_array().key("queue");
  write(out, snapshot.queue);
  out.key("objects");
  write_objects(out, snapshot.scene.objects);
  if (gap) out.field("gap", true);
  out.end_object().end_object();
  return out.take();
}

std::string state_json(const StateFrame& frame, const Cell& cell) {
  constexpr int kDecimals = 6;
  JsonWriter out;
  out.begin_object().field("type", "state").field("t_s", frame.time);
  out.key("q").begin_object();
  for (std::size_t i = 0; i < cell.joints.size(); ++i) {
    out.key(cell.joints[i].name).rounded(frame.q[static_cast<Eigen::Index>(i)], kDecimals);
  }
  out.end_object().key("clearance").begin_array();
  for (const Proximity& near : frame.clearance) {
    out.begin_object().key("arms").begin_array();
    if (near.arm_a) out.value(cell.arm(*near.arm_a).name);
    if (near.arm_b) out.value(cell.arm(*near.arm_b).name);
    out.end_array().key("m").rounded(near.clearance_m, kDecimals);
    out.key("links").begin_array().value(near.body_a).value(near.body_b).end_array().end_object();
  }
  out.end_array().end_object();
  return out.take();
}

std::string stream_of_seed(std::uint64_t seed) {
  // splitmix64 (Steele, Lea, Flood 2014): two well mixed words from one seed.
  const auto next = [&seed] {
    std::uint64_t z = (seed += 0x9E37'79B9'7F4A'7C15ULL);
    z = (z ^ (z >> 30U)) * 0xBF58'476D'1CE4'E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D0'49BB'1331'11EBULL;
    return z ^ (z >> 31U);
  };
  const std::uint64_t high = next();
  return uuid(high, next(), 8);
}

std::string random_stream() {
  std::random_device device;
  const auto word = [&] { return (static_cast<std::uint64_t>(device()) << 32U) | device(); };
  const std::uint64_t high = word();
  return uuid(high, word(), 4);
}

}  // namespace armloom
