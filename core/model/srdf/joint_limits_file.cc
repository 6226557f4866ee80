#include "core/model/srdf/joint_limits_file.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <string_view>

#include "core/base/nearest_name.h"
#include "core/model/xml/xml_numbers.h"

namespace armloom {
namespace {

std::string at_line(const std::string& file, const YAML::Mark& mark) {
  return file + ":" + std::to_string(mark.line + 1);
}

void report(const std::string& place, const std::string& slug, const std::string& sentence,
            decltype(Problem::value) value, Diagnostics& diagnostics) {
  diagnostics.add({ProblemKind::invalid, slug, place, place + ": " + sentence, std::move(value)});
}

void warn(const std::string& place, const std::string& slug, const std::string& sentence,
          const std::string& value, Diagnostics& diagnostics) {
  diagnostics.warn({ProblemKind::invalid, slug, place, place + ": " + sentence, value});
}

std::string scalar_of(const YAML::Node& node) {
  return node.IsScalar() ? node.Scalar() : node.IsNull() ? "nothing" : "no single value";
}

// Reads the keys of one joint. Reports duplicate keys, because the YAML library silently uses the
// first.
class JointReader {
 public:
  JointReader(const YAML::Node& node, const std::string& file, const std::string& name,
              LimitsFile::Joint& joint)
      : node_(node), file_(file), name_(name), joint_(joint) {}

  void read() {
    if (node_.IsNull()) return;
    if (!node_.IsMap()) {
      return report(joint_.place, "wrong-type", "limits are expected, as keys and values",
                    scalar_of(node_), joint_.faults);
    }
    check_keys();
    JointLimitsDescription& limits = joint_.limits;
    const auto positions = has("has_position_limits");
    if (counts(positions, "min_position"))
      limits.lower = number("min_position", "has_position_limits");
    if (counts(positions, "max_position"))
      limits.upper = number("max_position", "has_position_limits");
    if (limits.lower && limits.upper && *limits.lower > *limits.upper) {
      report(joint_.place, "limits-crossed",
             "min_position " + text_of(*limits.lower) + " is above max_position " +
                 text_of(*limits.upper),
             *limits.lower, joint_.faults);
      limits.lower = limits.upper = std::nullopt;
    }
    limits.velocity = rate("has_velocity_limits", "max_velocity");
    limits.acceleration = rate("has_acceleration_limits", "max_acceleration");
    limits.jerk = rate("has_jerk_limits", "max_jerk");
    if (counts(has("has_deceleration_limits"), "max_deceleration")) limits.brake = deceleration();
  }

 private:
  static constexpr std::array<std::string_view, 16> kKnown{"has_position_limits",
                                                           "min_position",
                                                           "max_position",
                                                           "has_velocity_limits",
                                                           "min_velocity",
                                                           "max_velocity",
                                                           "max_acceleration",
                                                           "min_acceleration",
                                                           "max_jerk",
                                                           "has_jerk_limits",
                                                           "max_deceleration",
                                                           "has_effort_limits",
                                                           "max_effort",
                                                           "has_acceleration_limits",
                                                           "angle_wraparound",
                                                           "has_deceleration_limits"};

  void check_keys() {
    std::set<std::string> seen;
    for (const auto& member : node_) {
      const std::string key = scalar_of(member.first);
      const std::string place = place_of(member.first.Mark());
      if (!seen.insert(key).second) {
        report(place, "duplicate", key + " is given twice", key, joint_.faults);
      } else if (std::find(kKnown.begin(), kKnown.end(), key) == kKnown.end()) {
        unknown(place, key);
      }
    }
  }

  // Reports an unknown key. If it resembles a known key, it was probably meant as a limit, so it is
  // a fault; otherwise it is a warning.
  void unknown(const std::string& place, const std::string& key) {
    const auto meant = nearest_name(key, kKnown);
    if (meant) {
      report(place, "unknown-key",
             key + " is not known here, so it would limit nothing; did you mean " +
                 std::string(*meant) + "?",
             key, joint_.faults);
    } else {
      warn(place, "unknown-key", key + " is not known here and is left out", key, joint_.faults);
    }
  }

  [[nodiscard]] std::string place_of(const YAML::Mark& mark) const {
    return at_line(file_, mark) + ": joint " + name_;
  }

  // Returns true if the limit applies: has_... is true, or has_... is missing and the limit is
  // present.
  [[nodiscard]] bool counts(const std::optional<bool>& has, const char* limit) const {
    return has ? *has : static_cast<bool>(node_[limit]);
  }

  std::optional<double> rate(const char* has_key, const char* key) {
    return counts(has(has_key), key) ? positive(key, has_key) : std::nullopt;
  }

  std::optional<bool> has(const char* key) {
    const YAML::Node value = node_[key];
    if (!value) return std::nullopt;
    bool set = false;
    if (value.IsScalar() && YAML::convert<bool>::decode(value, set)) return set;
    report(place_of(value.Mark()), "wrong-type",
           std::string(key) + " is '" + scalar_of(value) + "', not true or false", scalar_of(value),
           joint_.faults);
    return true;  // so that its number is checked, too
  }

  std::optional<double> number(const char* key, const char* because) {
    const YAML::Node value = node_[key];
    if (!value) {
      report(joint_.place, "missing", std::string(key) + " is missing, but " + because + " is true",
             {}, joint_.faults);
      return std::nullopt;
    }
    const auto read = value.IsScalar() ? parse_number(value.Scalar()) : std::nullopt;
    if (!read) {
      report(place_of(value.Mark()), "not-a-number",
             std::string(key) + " is '" + scalar_of(value) + "', not a finite number",
             scalar_of(value), joint_.faults);
      return std::nullopt;
    }
    return in_radians(key, value, *read);
  }

  // Returns the value in radians. ROS marks angles in degrees with a tag: !degrees 90.
  std::optional<double> in_radians(const char* key, const YAML::Node& value, double read) {
    const std::string& tag = value.Tag();
    if (tag == "!degrees") return read * std::numbers::pi / 180.0;
    if (!tag.starts_with('!') || tag == "!" || tag == "!radians") return read;
    report(place_of(value.Mark()), "unknown-tag",
           std::string(key) + " has the unknown tag " + tag + "; use !degrees or !radians", tag,
           joint_.faults);
    return std::nullopt;
  }

  std::optional<double> positive(const char* key, const char* because) {
    const auto read = number(key, because);
    if (!read || *read > 0.0) return read;
    report(place_of(node_[key].Mark()), "not-positive",
           std::string(key) + " is " + text_of(*read) + ", it must be greater than 0", *read,
           joint_.faults);
    return std::nullopt;
  }

  // Returns the deceleration as a positive number. MoveIt's Pilz planner uses negative numbers.
  std::optional<double> deceleration() {
    const auto read = number("max_deceleration", "has_deceleration_limits");
    if (!read || *read != 0.0) return read ? std::optional(std::abs(*read)) : std::nullopt;
    report(place_of(node_["max_deceleration"].Mark()), "not-positive",
           "max_deceleration is 0, so the joint could never stop", 0.0, joint_.faults);
    return std::nullopt;
  }

  const YAML::Node& node_;
  const std::string& file_;
  const std::string& name_;
  LimitsFile::Joint& joint_;
};

void check_scaling(const YAML::Node& root, const std::string& file, Diagnostics& diagnostics) {
  for (const char* key :
       {"default_velocity_scaling_factor", "default_acceleration_scaling_factor"}) {
    const YAML::Node value = root[key];
    if (!value) continue;
    const auto read = value.IsScalar() ? parse_number(value.Scalar()) : std::nullopt;
    if (read && *read > 0.0 && *read <= 1.0) continue;
    warn(at_line(file, value.Mark()), "not-a-number",
         std::string(key) + " is '" + scalar_of(value) +
             "', but must be above 0 and at most 1; ignored, because it affects planning only",
         scalar_of(value), diagnostics);
  }
}

// Returns the YAML map that contains `joint_limits`: the root, or a map nested as in ROS 2's
// parameter files.
YAML::Node holder_of_limits(YAML::Node node) {
  for (const char* key : {"/**", "move_group", "ros__parameters", "robot_description_planning"}) {
    if (node.IsMap() && !node["joint_limits"] && node[key]) node.reset(YAML::Node(node[key]));
  }
  return node;
}

std::optional<LimitsFile> read_document(const YAML::Node& document, const std::string& file,
                                        const std::string& prefix, Diagnostics& diagnostics) {
  const YAML::Node holder = holder_of_limits(document);
  const YAML::Node joints = holder.IsMap() ? holder["joint_limits"] : YAML::Node();
  if (!holder.IsMap() || !joints || !(joints.IsMap() || joints.IsNull())) {
    report(
        file, "missing",
        "there is no joint_limits with joints in it; it must contain joint_limits: and below it, "
        "indented, each joint: with its has_velocity_limits: true, max_velocity: 1 etc.",
        {}, diagnostics);
    return std::nullopt;
  }
  check_scaling(holder, file, diagnostics);
  LimitsFile limits{.file = file, .joints = {}};
  for (const auto& member : joints) {
    const std::string name = prefix + scalar_of(member.first);
    const std::string place = at_line(file, member.first.Mark()) + ": joint " + name;
    const auto [entry, first] = limits.joints.emplace(name, LimitsFile::Joint{place, {}, {}});
    if (first) {
      JointReader(member.second, file, name, entry->second).read();
      continue;
    }
    LimitsFile::Joint again{place, {}, {}};
    JointReader(member.second, file, name, again).read();
    report(place, "duplicate-name", "more than one joint has this name", name, again.faults);
    entry->second.faults.merge(std::move(again.faults));
  }
  return limits;
}

}  // namespace

std::optional<LimitsFile> read_limits_file(const std::string& text,
                                           const std::filesystem::path& path,
                                           const std::string& prefix, Diagnostics& diagnostics) {
  const std::string file = path.filename().string();
  try {
    return read_document(YAML::Load(text), file, prefix, diagnostics);
  } catch (const YAML::Exception& error) {
    diagnostics.add({ProblemKind::malformed,
                     "yaml-malformed",
                     at_line(file, error.mark),
                     at_line(file, error.mark) + ": the YAML is malformed (" + error.msg + ")",
                     {}});
    return std::nullopt;
  }
}

}  // namespace armloom
