#include "server/messages/fault.h"

#include <algorithm>
#include <array>
#include <utility>

#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/read_text.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/told_part.h"
#include "server/codec/value_formats.h"

namespace armloom {

using namespace formats;

namespace {

using FaultKind = ArmFault::Kind;

constexpr double kFaultTimeMax_s = 1e6;
constexpr std::size_t kFaultsFileMax = 10'000;

// The one table of kinds: what they are called, and the highest value that they may have.
struct KindRule {
  FaultKind kind;
  const char* name;
  double value_max;  // zero: it has no value
  bool lasts;        // and may have a duration
};
constexpr std::array<KindRule, 5> kKinds{
    {{FaultKind::stall, "stall", 0.0, true},
     {FaultKind::slow, "slow", 1.0, true},
     {FaultKind::late_start, "late_start", kFaultTimeMax_s, true},
     {FaultKind::drop_feedback, "drop_feedback", 0.0, true},
     {FaultKind::fault, "fault", 0.0, false}}};
constexpr std::array<const char*, 6> kKindsToCome{"freeze_feedback", "drift",       "reject",
                                                  "runaway",         "ignore_stop", "noise"};

const KindRule& rule_of(FaultKind kind) {
  return *std::ranges::find(kKinds, kind, &KindRule::kind);
}

class KindFormat final : public CustomFormat<FaultKind> {
 public:
  void read(const JsonNode& node, FaultKind& kind) const override {
    std::string name;
    if (!node.read(name)) return;
    for (const KindRule& rule : kKinds) {
      if (name == rule.name) return void(kind = rule.kind);
    }
    const bool to_come = std::ranges::find(kKindsToCome, name) != kKindsToCome.end();
    std::string known;
    for (const KindRule& rule : kKinds)
      known += (known.empty() ? "" : ", ") + std::string(rule.name);
    if (to_come) {
      node.invalid("unsupported-fault",
                   "the simulated arms have no \"" + name + "\" yet; they have " + known);
    } else {
      node.invalid("unknown-fault", "no fault is called \"" + name + "\"; known are " + known);
    }
  }
  void write(JsonWriter& out, const FaultKind& kind) const override {
    out.value(rule_of(kind).name);
  }
  Schema schema(Way) const override {
    Schema schema{{"type", "string"}, {"enum", Schema::array()}};
    for (const KindRule& rule : kKinds) schema["enum"].push_back(rule.name);
    return schema;
  }
};

FormatPtr<FaultKind> kind_format() { return make_format<KindFormat>(); }

bool has_known_kind(const JsonNode& fault) {
  if (!fault.has("kind") || !fault.raw()["kind"].is_string()) return false;
  const auto name = fault.raw()["kind"].get<std::string>();
  return std::ranges::any_of(kKinds, [&](const KindRule& rule) { return name == rule.name; });
}

// "for_s" and "value", which are as the kind has them: read after it, if it is known.
class KindsOwn final : public CustomPart<FaultRequest> {
 public:
  void list_keys(std::vector<std::string_view>& keys) const override {
    keys.insert(keys.end(), {"for_s", "value"});
  }
  void read(const JsonNode& object, FaultRequest& fault) const override {
    if (!has_known_kind(object)) return;
    const KindRule& rule = rule_of(fault.kind);
    object.optional("for_s", [&](const JsonNode& node) {
      if (rule.lasts) return seconds({0.0, kFaultTimeMax_s})->read(node, fault.lasting.emplace());
      node.invalid("no-duration", "a fault strikes once and has no duration");
    });
    if (rule.value_max > 0.0) {
      object.required("value", [&](const JsonNode& node) {
        number({0.0, rule.value_max})->read(node, fault.value);
      });
    } else {
      object.optional("value", [&](const JsonNode& node) {
        node.invalid("no-value", std::string("a ") + rule.name + " has no value");
      });
    }
  }
  void describe(Schema& object, const FaultRequest&, Way way) const override {
    describe_member(
        object,
        {"for_s", "Default: until removed. Not with fault, which strikes once", Need::optional, {}},
        seconds({0.0, kFaultTimeMax_s})->schema(way), std::nullopt, way);
    describe_member(object,
                    {"value",
                     "slow: share of the speed, 0..1; late_start: seconds; not with the "
                     "others",
                     Need::optional,
                     {}},
                    number({0.0, kFaultTimeMax_s})->schema(way), std::nullopt, way);
    for (const KindRule& rule : kKinds) {
      Schema then = Schema::object();
      if (!rule.lasts) then["properties"]["for_s"] = false;
      if (rule.value_max > 0.0) {
        then["properties"]["value"] = number({0.0, rule.value_max})->schema(way);
        then["required"] = {"value"};
      } else {
        then["properties"]["value"] = false;
      }
      object["allOf"].push_back(
          {{"if", {{"properties", {{"kind", {{"const", rule.name}}}}}}}, {"then", then}});
    }
  }
};

// What is told of a value, or of an end, is as the kind has it.
class WithinKind final : public CustomPart<FaultRequest> {
 public:
  void read(const JsonNode& object, FaultRequest& fault) const override {
    const KindRule& rule = rule_of(fault.kind);
    if (fault.value < 0.0 || fault.value > rule.value_max || (fault.lasting && !rule.lasts)) {
      object.invalid("out-of-range", std::string("a ") + rule.name + " has no such value or end");
    }
  }
  void describe(Schema&, const FaultRequest&, Way) const override {}
};

// A fault as it is told: all members, always.
PartPtr<FaultRequest> told_members(FormatPtr<TimePoint> at, FormatPtr<Duration> lasting) {
  using Fault = FaultRequest;
  return parts<Fault>({
      always("arm", &Fault::arm, text()),
      always("kind", &Fault::kind, kind_format()),
      always("at_s", &Fault::at, nullable(std::move(at)), "Cell time; null: at once"),
      always("for_s", &Fault::lasting, nullable(std::move(lasting)),
             "null: until removed; of a fault: until it has struck"),
      always("value", &Fault::value, number(kAnyNumber)),
      make_part<WithinKind>(),
  });
}

FormatPtr<FaultRequest> make_fault_format(Need time_needed) {
  using Fault = FaultRequest;
  return object<Fault>({
      required("arm", &Fault::arm, text(), "Whose"),
      required("kind", &Fault::kind, kind_format(), "What goes wrong"),
      member({"at_s", "Cell time; default: now", time_needed, {}}, &Fault::at,
             cell_time(kFaultTimeMax_s)),
      make_part<KindsOwn>(),
  });
}

}  // namespace

FormatPtr<FaultRequest> fault_request_format() {
  static const auto format = named(
      "FaultRequest",
      "A fault of a simulated arm. stall: it stays where it is on its path; slow: it follows it at "
      "a share of its speed; late_start: each motion begins late; drop_feedback: what it told last "
      "is told again; fault: the controller gives up, once, from at_s on: in the motion that moves "
      "then, else as soon as the next one moves.",
      make_fault_format(Need::optional));
  return format;
}

Result<FaultRequest> read_fault_text(std::string_view text) {
  return read_text(*fault_request_format(), text);
}

Result<std::vector<FaultRequest>> read_faults_text(std::string_view text, const Cell& cell) {
  const auto file = parse_json(text, JsonComments::refused);
  if (!file) return failure(file.error());
  Problems faults;
  std::vector<FaultRequest> read;
  const JsonNode root(*file, "", faults);
  const ListSize size{.most = kFaultsFileMax, .noun = "faults"};
  list(make_fault_format(Need::required), size)->read(root, read);
  auto fault = read.begin();
  if (!read.empty()) {
    root.each([&](const JsonNode& node) {
      node.optional("arm", [&](const JsonNode& n) {
        if (!n.raw().is_string() || cell.find_arm(fault->arm)) return;
        n.invalid("unknown-arm", "no arm of the cell is named \"" + fault->arm + "\"");
      });
      ++fault;
    });
  }
  if (!faults.empty()) return failure(std::move(faults));
  return read;
}

FormatPtr<FaultView> fault_format() {
  using View = FaultView;
  static const auto format =
      named("Fault", "",
            object<View>({
                told(
                    "id", [](const View& view) { return std::to_string(view.id); }, text()),
                inlined(&View::fault, told_members(cell_time(), seconds(kAnyNumber))),
            }));
  return format;
}

FormatPtr<FaultRequest> logged_fault_format() {
  static const auto format = object<FaultRequest>({
      constant<FaultRequest>("id", "0"),
      told_members(cell_time(kFaultTimeMax_s), seconds({0.0, kFaultTimeMax_s})),
  });
  return format;
}

FormatPtr<SimulationSpeed> speed_format() {
  using Speed = SimulationSpeed;
  static const auto format =
      named("Speed", "",
            object<Speed>({required("speed", &Speed::speed, number({Speed::kMin, Speed::kMax}),
                                    "Cell seconds per wall second")}));
  return format;
}

}  // namespace armloom
