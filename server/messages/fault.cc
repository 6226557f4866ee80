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
constexpr std::size_t kFaultsFileMax = 10'000;

constexpr NumberRange kFaultSpeed{-10.0, 10.0};  // rad/s, m/s
constexpr NumberRange kFaultDelay_s{0.0, 10.0};

// The value of a kind of fault.
struct ValueRule {
  const char* meaning;  // with its unit
  NumberRange range;
  std::optional<double> by_default = {};  // nullopt: the value is required
};
struct KindRule {
  FaultKind kind;
  const char* name;
  const char* effect;  // a sentence
  std::optional<ValueRule> value = {};
  bool lasts = true;  // may have `for_s`
};
const std::array kKinds{
    KindRule{FaultKind::stall, "stall", "the arm stays where it is on its path"},
    KindRule{FaultKind::slow, "slow", "the arm follows its path at a share of its speed",
             ValueRule{"share of the speed", {0.0, 1.0}}},
    KindRule{FaultKind::late_start, "late_start", "the arm begins each motion late",
             ValueRule{"delay in s", {0.0, kFaultTimeMax_s}}},
    KindRule{.kind = FaultKind::fault,
             .name = "fault",
             .effect = "the controller fails once, from `at_s` on: during the present motion, or "
                       "else as soon as the next motion moves",
             .lasts = false},
    KindRule{FaultKind::drop_feedback, "drop_feedback", "no report of the arm arrives"},
    KindRule{FaultKind::freeze_feedback, "freeze_feedback",
             "reports arrive with new numbers and times, but with old content"},
    KindRule{FaultKind::drift, "drift",
             "the first joint leaves its path, or the position where it rests, until the arm is "
             "braked. The joint stays off its path until the next motion",
             ValueRule{"rad/s or m/s", kFaultSpeed, 0.1}},
    KindRule{.kind = FaultKind::reject,
             .name = "reject",
             .effect = "the controller rejects the next motion, once",
             .lasts = false},
    KindRule{FaultKind::runaway, "runaway",
             "the arm passes its authority and goes on to the end of its trajectory: it may hit "
             "other arms"},
    KindRule{FaultKind::ignore_stop, "ignore_stop",
             "the controller acknowledges brakes, but carries them out only when the fault ends. "
             "Only a stop of category 0 works"},
    KindRule{FaultKind::noise, "noise", "measured positions have Gaussian noise",
             ValueRule{"standard deviation in rad or m", {0.0, 1.0}, 0.01}},
    KindRule{FaultKind::delay, "delay", "commands and reports arrive late",
             ValueRule{"delay of each message in s", kFaultDelay_s, 0.05}},
    KindRule{FaultKind::jitter, "jitter", "commands and reports arrive late by random times",
             ValueRule{"largest delay of a message in s", kFaultDelay_s, 0.02}},
    KindRule{FaultKind::loss, "loss", "commands and reports are lost at random",
             ValueRule{"probability for each message", {0.0, 1.0}, 0.1}},
    KindRule{FaultKind::reorder, "reorder",
             "commands and reports are overtaken by later ones at random",
             ValueRule{"probability for each message", {0.0, 1.0}, 0.1}},
    KindRule{FaultKind::cut, "cut",
             "the connection is down, and messages under way are lost. The arm brakes by itself"},
    KindRule{FaultKind::restart, "restart",
             "the controller is down, and forgets its motion. The arm brakes by itself"},
    KindRule{FaultKind::clock_drift, "clock_drift",
             "the controller's clock is too fast, or too slow if the value is negative",
             ValueRule{"seconds gained in each second", {-0.1, 0.1}, 0.0005}},
};

const KindRule& rule_of(FaultKind kind) {
  return *std::ranges::find(kKinds, kind, &KindRule::kind);
}

// "`delay`: delay of each message in s, at least 0 and at most 10, default 0.05"
std::string described(const KindRule& rule) {
  std::string text = std::string("`") + rule.name + "`: " + rule.value->meaning + ", " +
                     in_words(rule.value->range);
  if (!rule.value->by_default) return text;
  JsonWriter number;
  number.value(*rule.value->by_default);
  return text + ", default " + number.take();
}

// Joins what `words` returns for each kind, except empty texts.
template <class Words>
std::string for_each_kind(const char* between, const Words& words) {
  std::string all;
  for (const KindRule& rule : kKinds) {
    const std::string text = words(rule);
    if (!text.empty()) all += (all.empty() ? "" : between) + text;
  }
  return all;
}

class KindFormat final : public CustomFormat<FaultKind> {
 public:
  void read(const JsonNode& node, FaultKind& kind) const override {
    std::string name;
    if (!node.read(name)) return;
    for (const KindRule& rule : kKinds) {
      if (name == rule.name) return void(kind = rule.kind);
    }
    node.invalid("unknown-fault",
                 "unknown fault \"" + name + "\"; available: " +
                     for_each_kind(", ", [](const KindRule& rule) { return rule.name; }));
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
      node.invalid("no-duration", std::string("a fault of kind \"") + rule.name +
                                      "\" occurs once and has no duration: remove for_s");
    });
    if (!rule.value) {
      object.optional("value", [&](const JsonNode& node) {
        node.invalid("no-value",
                     std::string("a fault of kind \"") + rule.name + "\" has no value: remove it");
      });
      return;
    }
    const auto read = [&](const JsonNode& node) {
      number(rule.value->range)->read(node, fault.value);
    };
    fault.value = rule.value->by_default.value_or(0.0);
    if (rule.value->by_default) return object.optional("value", read);
    object.required("value", read,
                    std::string(rule.value->meaning) + ", " + in_words(rule.value->range));
  }
  void describe(Schema& object, const FaultRequest&, Way way) const override {
    describe_member(object,
                    {"for_s",
                     "Duration; by default, the fault lasts until it is removed. Not allowed for "
                     "`fault` and `reject`, which occur once",
                     Need::optional,
                     {}},
                    seconds({0.0, kFaultTimeMax_s})->schema(way), std::nullopt, way);
    describe_member(object,
                    {"value",
                     for_each_kind("; ",
                                   [](const KindRule& rule) {
                                     return rule.value ? described(rule) : std::string();
                                   }) +
                         ". Not allowed for other kinds",
                     Need::optional,
                     {}},
                    number({-kFaultTimeMax_s, kFaultTimeMax_s})->schema(way), std::nullopt, way);
    for (const KindRule& rule : kKinds) {
      Schema then = Schema::object();
      if (!rule.lasts) then["properties"]["for_s"] = false;
      then["properties"]["value"] =
          rule.value ? number(rule.value->range)->schema(way) : Schema(false);
      if (rule.value && !rule.value->by_default) then["required"] = {"value"};
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
    const bool fits = rule.value ? rule.value->range.holds(fault.value) : fault.value == 0.0;
    if (!fits || (fault.lasting && !rule.lasts)) {
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
          "Duration; null if the fault lasts until it is removed (`fault` and `reject`: until it "
          "has occurred)"),
      always("value", &Fault::value, number(kAnyNumber)),
      make_part<WithinKind>(),
  });
}

PartPtr<FaultView> view_part() {
  return parts<FaultView>({
      output_only(
          "id", [](const FaultView& view) { return std::to_string(view.id); }, text()),
      inlined(&FaultView::fault, told_members(cell_time(), seconds(kAnyNumber))),
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

bool has_value(std::string_view kind) {
  const auto rule = std::ranges::find(kKinds, kind, &KindRule::name);
  return rule != kKinds.end() && rule->value;
}

FormatPtr<FaultRequest> fault_request_format() {
  static const auto format =
      named("FaultRequest",
            "A fault of a simulated arm, or of the link to its controller. " +
                for_each_kind(". ",
                              [](const KindRule& rule) {
                                return std::string("`") + rule.name + "`: " + rule.effect;
                              }) +
                ".",
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
  static const auto format = named("Fault", "", object<FaultView>({view_part()}));
  return format;
}

FormatPtr<FaultListing> fault_list_format() {
  static const auto present =
      named("PresentFault", "A fault that is not over.",
            object<FaultView>({
                view_part(),
                output_only("remaining_s", &FaultView::remaining, nullable(seconds(kAnyNumber)),
                            "Time for which the fault will still act; null if it lasts until it is "
                            "removed (`fault` and `reject`: until it has occurred)"),
            }));
  static const auto format =
      named("FaultList", "",
            object<FaultListing>({
                output_only("t_s", &FaultListing::now, cell_time(), "Present cell time"),
                output_only("faults", &FaultListing::faults, list(present), "In order of ids"),
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
