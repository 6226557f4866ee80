// Prints values for every format that clients may send, with the reader's verdict on each value.
// reader_and_schema.test.mjs compares the verdicts with the schemas. Values are generated from the
// schemas; then one place of each is changed. Deterministic; one JSON object on stdout.
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "server/api/route.h"
#include "server/codec/cell_format.h"
#include "server/codec/json_text.h"
#include "server/codec/schema_names.h"
#include "server/messages/alert.h"
#include "server/messages/arm.h"
#include "server/messages/cell.h"
#include "server/messages/comparison.h"
#include "server/messages/control.h"
#include "server/messages/fault.h"
#include "server/messages/job_amendment.h"
#include "server/messages/job_request.h"
#include "server/messages/plan_goal.h"
#include "server/messages/scene.h"
#include "server/messages/session.h"
#include "server/messages/signal.h"
#include "server/messages/steps_plan.h"
#include "server/messages/task_request.h"

namespace armloom {
namespace {

using nlohmann::json;
using Random = std::mt19937_64;

constexpr int kWhole = 4000;   // valid values of each format
constexpr int kSpoilt = 2500;  // values with one fault

std::size_t below(Random& random, std::size_t count) { return random() % count; }

// A format that clients may send, with its schema and reader.
struct Incoming {
  std::string name;
  Schema schema;
  std::function<void(const JsonNode&, Problems&)> read;
};

template <class T>
Incoming incoming(std::string name, const Format<T>& format) {
  return {std::move(name), format.schema(Way::in), [format](const JsonNode& node, Problems&) {
            T value{};
            format.read(node, value);
          }};
}

// Reads a batch. A non-atomic batch accepts its jobs one by one, so their refusals are added to
// `faults`.
void read_batch(const JsonNode& node, Problems& faults) {
  BatchRequest batch;
  batch_request_format()->read(node, batch);
  for (const auto& entry : batch.jobs) {
    if (!entry.job) faults.push_back(entry.job.error().front());
  }
}

std::vector<Incoming> all_incoming() {
  return {incoming("StepRequest", *step_request_format()),
          incoming("JobRequest", *job_request_format()),
          {"BatchRequest", batch_request_format()->schema(Way::in), read_batch},
          incoming("ObjectRequest", *object_request_format()),
          incoming("NamedObjectRequest", *named_object_request_format()),
          incoming("FaultRequest", *fault_request_format()),
          incoming("SceneRequest", *scene_request_format()),
          incoming("SignalRequest", *signal_request_format()),
          incoming("Speed", *speed_format()),
          incoming("SpeedOverride", *speed_override_format()),
          incoming("Goal", *plan_goal_format()),
          incoming("cell file", cell_format()),
          incoming("PlanRequest", *plan_body_format()),
          incoming("LogIn", *log_in_format()),
          incoming("JobAmendment", *job_amendment_format()),
          incoming("AlertsSeen", *alerts_seen_format()),
          incoming("PolicyChoice", *policy_choice_format()),
          incoming("ComparisonRequest", *comparison_inquiry_format()),
          incoming("ControlRequest", *control_request_format()),
          incoming("ControlKey", *control_key_format()),
          incoming("JogRequest", *jog_request_format())};
}

// Throws if a route's body is not among the formats.
void expect_every_body(const std::vector<Incoming>& all) {
  for (const Route& route : all_routes()) {
    if (!route.reads) continue;
    const auto is_it = [&](const Incoming& one) { return one.schema == route.reads->schema; };
    if (std::ranges::none_of(all, is_it)) throw std::logic_error("not compared: " + route.id);
  }
}

json number_of(const Schema& schema, Random& random) {
  const bool whole = schema["type"] == "integer";
  const double lowest = schema.value("minimum", schema.value("exclusiveMinimum", -3.0));
  const double highest = schema.value("maximum", std::max(lowest, 0.0) + 4.0);
  const double inside = lowest + (highest - lowest) * static_cast<double>(1 + below(random, 7)) / 8;
  return whole ? json(static_cast<std::int64_t>(inside)) : json(inside);
}

json value_of(const Schema& schema, Random& random);

json object_of(const Schema& schema, Random& random) {
  json object = json::object();
  const Schema needed = schema.value("required", Schema::array());
  const Schema members = schema.value("properties", Schema::object());
  for (const auto& [key, member] : members.items()) {
    const bool is_needed = std::ranges::find(needed, Schema(key)) != needed.end();
    if (member.is_object() && (is_needed || below(random, 3) == 0))
      object[key] = value_of(member, random);
  }
  const bool is_dictionary =
      schema.contains("additionalProperties") && schema["additionalProperties"].is_object();
  if (is_dictionary && below(random, 2) == 0)
    object["joint_1"] = value_of(schema["additionalProperties"], random);
  return object;
}

// Returns a value that fits the schema, except that it may break rules over several members.
json value_of(const Schema& schema, Random& random) {
  if (schema.contains("$of")) return value_of(schema["$of"], random);
  if (schema.contains("const")) return json::parse(schema["const"].dump());
  if (schema.contains("enum"))
    return json::parse(schema["enum"][below(random, schema["enum"].size())].dump());
  for (const char* some : {"oneOf", "anyOf"}) {
    if (schema.contains(some))
      return value_of(schema[some][below(random, schema[some].size())], random);
  }
  const std::string type = schema.value("type", "null");
  if (type == "object") return object_of(schema, random);
  if (type == "array") {
    json list = json::array();
    const std::size_t fewest = schema.value("minItems", std::size_t{0});
    const std::size_t most = schema.value("maxItems", fewest + 2);
    const std::size_t size = fewest + below(random, std::min(most - fewest, std::size_t{2}) + 1);
    while (list.size() < size) list.push_back(value_of(schema["items"], random));
    return list;
  }
  if (type == "number" || type == "integer") return number_of(schema, random);
  if (type == "boolean") return below(random, 2) == 0;
  if (type == "string") return "left_arm-" + std::to_string(below(random, 3));
  return nullptr;
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

// Replacement values: limits of our formats and values beyond them, spellings of numbers, and texts
// that rules mention.
std::vector<json> odd_values() {
  std::vector<json> odd{nullptr,       true,           false,
                        json::array(), json::object(), json::array({1, 2, 3})};
  for (const double number :
       {0.0, 0.5, 1.0, 2.0, 6.3, 32.0, 100.0, 1000.0, 3600.0, 1e6, 1e18, 1e19}) {
    for (const double sign : {-1.0, 1.0}) {
      for (const double to : {-1e300, 0.0, 1e300}) {
        odd.push_back(to == 0.0 ? sign * number : std::nextafter(sign * number, to));
      }
      odd.push_back(sign * number + 1.0);
    }
  }
  for (const std::int64_t whole : {-1'000'001L, -1'000'000L, -1L, 0L, 1L, 32L, 33L, 999'999'999L,
                                   1'000'000'000L, 2'147'483'648L, -2'147'483'649L}) {
    odd.push_back(whole);
  }
  odd.push_back(std::numeric_limits<std::uint64_t>::max());
  for (const char* text : {"", ".", "..", "...", "a/b", "a\\b", "a\nb", "\t", "\x7f", "\xc2\x85",
                           " ", "\xc2\xa0\xe3\x80\x80 ", " \xe2\x80\x83", "a b", "a\n", "ready",
                           "left", "panda.v1_-", "\xc3\xa9"}) {
    odd.push_back(text);
  }
  for (const int size : {128, 129, 256, 257}) {
    for (const char* text : {"n", "\xc3\xa9", "\xf0\x9f\x98\x80"}) {
      odd.push_back(repeated(text, size));
    }
  }
  return odd;
}

void list_places(const json& value, const json::json_pointer& at,
                 std::vector<json::json_pointer>& places) {
  places.push_back(at);
  if (value.is_object()) {
    for (const auto& [key, member] : value.items()) list_places(member, at / key, places);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) list_places(value[i], at / i, places);
  }
}

void spoil(json& value, Random& random) {
  static const std::vector<json> odd = odd_values();
  std::vector<json::json_pointer> places;
  list_places(value, json::json_pointer(), places);
  json& place = value[places[below(random, places.size())]];
  const std::size_t how = below(random, 5);
  if (how == 0 && place.is_object() && !place.empty()) {
    place.erase(std::next(place.begin(), static_cast<std::ptrdiff_t>(below(random, place.size()))));
  } else if (how == 1 && place.is_object()) {
    place[below(random, 2) == 0 ? "no such member" : "mesh"] = odd[below(random, odd.size())];
  } else if (how == 2 && place.is_array() && !place.empty()) {
    place.push_back(json(place.front()));
  } else if (how == 3 && place.is_array() && !place.empty()) {
    place.erase(place.size() - 1);
  } else {
    place = odd[below(random, odd.size())];
  }
}

// The reader and the schema get the same text, so that 1.0 stays 1.0.
json judged(const Incoming& format, const json& value) {
  const std::string text = value.dump();
  const auto parsed = parse_json(text, JsonComments::refused);
  if (!parsed) throw std::logic_error("no JSON: " + text);
  Problems faults;
  format.read(JsonNode(*parsed, "", faults), faults);
  if (faults.empty()) return {{"text", text}, {"fault", nullptr}};
  return {{"text", text}, {"fault", faults.front().pointer + ": " + faults.front().detail}};
}

json cases_of(const Incoming& format) {
  Random random(7);
  json cases = json::array();
  for (int i = 0; i < kWhole; ++i) cases.push_back(judged(format, value_of(format.schema, random)));
  for (int i = 0; i < kSpoilt; ++i) {
    json value = value_of(format.schema, random);
    for (int tries = 0; tries < 20 && !judged(format, value)["fault"].is_null(); ++tries) {
      value = value_of(format.schema, random);  // the changed place must be the only fault
    }
    spoil(value, random);
    cases.push_back(judged(format, value));
  }
  return cases;
}

json all_cases() {
  const std::vector<Incoming> all = all_incoming();
  expect_every_body(all);
  json formats = json::object();
  for (const Incoming& format : all) {
    Schema parts = Schema::object();
    Schema schema = refer_to_names(format.schema, "#/$defs/", parts);
    schema["$defs"] = std::move(parts);
    formats[format.name] = {{"schema", json::parse(schema.dump())}, {"cases", cases_of(format)}};
  }
  return formats;
}

}  // namespace
}  // namespace armloom

int main() {
  std::cout << armloom::all_cases().dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)
            << '\n';
}
