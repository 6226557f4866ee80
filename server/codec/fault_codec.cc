#include "server/codec/fault_codec.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "server/codec/json_node.h"
#include "server/codec/json_text.h"
#include "server/codec/json_writer.h"

namespace armloom {
namespace {

using Kind = ArmFault::Kind;

constexpr double kTimeMax_s = 1e6;
constexpr std::size_t kFaultsFileMax = 10'000;

constexpr std::array<std::pair<std::string_view, Kind>, 4> kKinds{{{"stall", Kind::stall},
                                                                   {"slow", Kind::slow},
                                                                   {"late_start", Kind::late_start},
                                                                   {"fault", Kind::fault}}};
constexpr std::array<std::string_view, 7> kKindsToCome{
    "drop_feedback", "freeze_feedback", "drift", "reject", "runaway", "ignore_stop", "noise"};

std::string_view name_of(Kind kind) {
  return std::ranges::find(kKinds, kind, [](const auto& entry) { return entry.second; })->first;
}

bool read_kind(const JsonNode& node, Kind& kind) {
  std::string name;
  if (!node.read(name)) return false;
  const auto it = std::ranges::find(kKinds, name, [](const auto& entry) { return entry.first; });
  if (it != kKinds.end()) {
    kind = it->second;
  } else if (std::ranges::find(kKindsToCome, name) != kKindsToCome.end()) {
    node.invalid("unsupported-fault", "the simulated arms have no \"" + name +
                                          "\" yet; they have stall, slow, late_start, fault");
  } else {
    node.invalid("unknown-fault",
                 "no fault is called \"" + name + "\"; known are stall, slow, late_start, fault");
  }
  return it != kKinds.end();
}

void read_value(const JsonNode& node, FaultRequest& fault) {
  if (fault.kind == Kind::slow || fault.kind == Kind::late_start) {
    const double highest = fault.kind == Kind::slow ? 1.0 : kTimeMax_s;
    node.required("value", [&](const JsonNode& n) { n.read_within(fault.value, 0.0, highest); });
  } else {
    node.optional("value", [&](const JsonNode& n) {
      n.invalid("no-value", "a " + std::string(name_of(fault.kind)) + " has no value");
    });
  }
}

void read_duration(const JsonNode& node, FaultRequest& fault) {
  if (fault.kind == Kind::fault) {
    return node.invalid("no-duration", "a fault strikes once and has no duration");
  }
  double seconds = 0.0;
  if (node.read_within(seconds, 0.0, kTimeMax_s)) fault.lasting = from_seconds(seconds);
}

void read_fault(const JsonNode& node, bool in_file, FaultRequest& fault) {
  if (!node.object({"arm", "kind", "at_s", "for_s", "value"})) return;
  node.required("arm", [&](const JsonNode& n) { n.read(fault.arm); });
  bool known = false;
  node.required("kind", [&](const JsonNode& n) { known = read_kind(n, fault.kind); });
  const auto read_at = [&](const JsonNode& n) {
    double seconds = 0.0;
    if (n.read_within(seconds, 0.0, kTimeMax_s)) fault.at = at(from_seconds(seconds));
  };
  if (in_file) {
    node.required("at_s", read_at);
  } else {
    node.optional("at_s", read_at);
  }
  if (!known) return;  // what else it may have is its kind's
  node.optional("for_s", [&](const JsonNode& n) { read_duration(n, fault); });
  read_value(node, fault);
}

}  // namespace

Result<FaultRequest> read_fault_text(std::string_view text) {
  const auto body = parse_json(text, JsonComments::refused);
  if (!body) return failure(body.error());
  Problems faults;
  FaultRequest fault;
  read_fault(JsonNode(*body, "", faults), false, fault);
  if (!faults.empty()) return failure(std::move(faults));
  return fault;
}

Result<std::vector<FaultRequest>> read_faults_text(std::string_view text, const Cell& cell) {
  const auto file = parse_json(text, JsonComments::refused);
  if (!file) return failure(file.error());
  Problems faults;
  std::vector<FaultRequest> list;
  const JsonNode root(*file, "", faults);
  if (root.array() && root.raw().size() > kFaultsFileMax) {
    root.fault(ProblemKind::too_large, "too-many-faults",
               std::to_string(root.raw().size()) + " faults, at most " +
                   std::to_string(kFaultsFileMax) + " are read");
  } else if (root.raw().is_array()) {
    root.each([&](const JsonNode& node) {
      read_fault(node, true, list.emplace_back());
      node.optional("arm", [&](const JsonNode& n) {
        const std::string& arm = list.back().arm;
        if (!n.raw().is_string() || cell.find_arm(arm)) return;
        n.invalid("unknown-arm", "no arm of the cell is named \"" + arm + "\"");
      });
    });
  }
  if (!faults.empty()) return failure(std::move(faults));
  return list;
}

std::string fault_json(std::uint64_t id, const FaultRequest& fault) {
  JsonWriter out;
  out.begin_object().field("id", std::to_string(id)).field("arm", fault.arm);
  out.field("kind", name_of(fault.kind)).field("at_s", fault.at).field("for_s", fault.lasting);
  out.field("value", fault.value).end_object();
  return out.take();
}

Result<double> read_speed_text(std::string_view text) {
  const auto body = parse_json(text, JsonComments::refused);
  if (!body) return failure(body.error());
  Problems faults;
  double speed = 1.0;
  const JsonNode node(*body, "", faults);
  if (node.object({"speed"})) {
    node.required("speed", [&](const JsonNode& n) { n.read_within(speed, kSpeedMin, kSpeedMax); });
  }
  if (!faults.empty()) return failure(std::move(faults));
  return speed;
}

}  // namespace armloom
