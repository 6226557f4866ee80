#include "server/messages/fault.h"

#include <algorithm>
#include <array>
#include <utility>

#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/output_part.h"
#include "server/codec/read_text.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"

namespace armloom {

using namespace formats;

namespace {

using FaultKind = ArmFault::Kind;

constexpr double kFaultTimeMax_s = 1e6;
constexpr double kDriftMax = 10.0;  // rad/s, m/s
constexpr std::size_t kFaultsFileMax = 10'000;

struct KindRule {
  FaultKind kind;
  const char* name;
  double value_max;  // highest `value`; zero if the kind has none
  bool lasts;        // may have `for_s`
};
constexpr std::array<KindRule, 6> kKinds{
    {{FaultKind::stall, "stall", 0.0, true},
     {FaultKind::slow, "slow", 1.0, true},
     {FaultKind::late_start, "late_start", kFaultTimeMax_s, true},
     {FaultKind::drop_feedback, "drop_feedback", 0.0, true},
     {FaultKind::fault, "fault", 0.0, false},
     {FaultKind::drift, "drift", kDriftMax, true}}};
constexpr std::array<const char*, 5> kKindsToCome{"freeze_feedback", "reject", "runaway",
                                                  "ignore_stop", "noise"};

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
      node.invalid(
          "unsupported-fault",
          "fault \"" + name + "\" is not implemented by simulated arms; available: " + known);
    } else {
      node.invalid("unknown-fault", "unknown fault \"" + name + "\"; available: " + known);
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

// Members "for_s" and "value". They depend on the kind of fault, so they are read after "kind".
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
      node.invalid("no-duration",
                   "a fault of kind \"fault\" occurs once and has no duration: remove for_s");
    });
    if (rule.value_max > 0.0) {
      object.required("value", [&](const JsonNode& node) {
        number({0.0, rule.value_max})->read(node, fault.value);
      });
    } else {
      object.optional("value", [&](const JsonNode& node) {
        node.invalid("no-value",
                     std::string("a fault of kind \"") + rule.name + "\" has no value: remove it");
      });
    }
  }
  void describe(Schema& object, const FaultRequest&, Way way) const override {
    describe_member(object,
                    {"for_s",
                     "Duration; by default, the fault lasts until it is removed. Not allowed for "
                     "`fault`, which occurs once",
                     Need::optional,
                     {}},
                    seconds({0.0, kFaultTimeMax_s})->schema(way), std::nullopt, way);
    describe_member(object,
                    {"value",
                     "`slow`: share of the speed, 0 to 1; `late_start`: delay in seconds; "
                     "`drift`: rad/s or m/s, up to 10; not allowed for other kinds",
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

// Checks that the value and the duration of a logged fault are allowed for its kind.
class WithinKind final : public CustomPart<FaultRequest> {
 public:
  void read(const JsonNode& object, FaultRequest& fault) const override {
    const KindRule& rule = rule_of(fault.kind);
    if (fault.value < 0.0 || fault.value > rule.value_max || (fault.lasting && !rule.lasts)) {
      object.invalid("out-of-range",
                     std::string("value or duration not allowed for \"") + rule.name + "\"");
    }
  }
  void describe(Schema&, const FaultRequest&, Way) const override {}
};

// Describes all members, as the server returns them.
PartPtr<FaultRequest> told_members(FormatPtr<TimePoint> at, FormatPtr<Duration> lasting) {
  using Fault = FaultRequest;
  return parts<Fault>({
      always("arm", &Fault::arm, text()),
      always("kind", &Fault::kind, kind_format()),
      always("at_s", &Fault::at, nullable(std::move(at)),
             "Start in cell time; null if the fault begins at once"),
      always(
          "for_s", &Fault::lasting, nullable(std::move(lasting)),
          "Duration; null if the fault lasts until it is removed (`fault`: until it has occurred)"),
      always("value", &Fault::value, number(kAnyNumber)),
      make_part<WithinKind>(),
  });
}

FormatPtr<FaultRequest> make_fault_format(Need time_needed) {
  using Fault = FaultRequest;
  return object<Fault>({
      required("arm", &Fault::arm, text(), "Arm that gets the fault"),
      required("kind", &Fault::kind, kind_format(), "Kind of fault"),
      member({"at_s", "Start in cell time; default: now", time_needed, {}}, &Fault::at,
             cell_time(kFaultTimeMax_s)),
      make_part<KindsOwn>(),
  });
}

}  // namespace

FormatPtr<FaultRequest> fault_request_format() {
  static const auto format = named(
      "FaultRequest",
      "A fault of a simulated arm. `stall`: the arm stays where it is on its path. `slow`: the arm "
      "follows its path at a share of its speed. `late_start`: the arm begins each motion late. "
      "`drop_feedback`: no report of the arm arrives. `fault`: the controller fails once, "
      "from `at_s` on: during the present motion, or else as soon as the next motion moves. "
      "`drift`: the arm's first joint leaves its path, or the position where it rests, until the "
      "arm is braked or the fault ends; the deviation remains.",
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
        n.invalid("unknown-arm", "the cell has no arm \"" + fault->arm + "\"");
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
                output_only(
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
                                    "Seconds of cell time per second of wall time")}));
  return format;
}

}  // namespace armloom
