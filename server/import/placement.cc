#include "server/import/placement.h"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

namespace armloom {
namespace {

tl::unexpected<Problems> bad_robot(const std::string& text, const std::string& faults) {
  return failure(Problem{ProblemKind::invalid,
                         "bad-robot",
                         "--robot",
                         "in \"" + text + "\": " + faults +
                             "; expected NAME or NAME:x=0.75,yaw_deg=180 with x, y, z (m), "
                             "roll_deg, pitch_deg, yaw_deg",
                         {}});
}

std::optional<double> number_of(std::string_view text) {
  double number = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || stop != end || !std::isfinite(number)) return std::nullopt;
  return number;
}

double* member_of(PoseWords& base, std::string_view key) {
  const std::array<std::pair<std::string_view, double*>, 6> members{
      {{"x", &base.xyz_m[0]},
       {"y", &base.xyz_m[1]},
       {"z", &base.xyz_m[2]},
       {"roll_deg", &base.rpy_rad[0]},
       {"pitch_deg", &base.rpy_rad[1]},
       {"yaw_deg", &base.rpy_rad[2]}}};
  for (const auto& [name, member] : members) {
    if (name == key) return member;
  }
  return nullptr;
}

// Reads one KEY=NUMBER. Returns the fault, or "".
std::string read_member(std::string_view one, PoseWords& base) {
  const std::size_t equals = one.find('=');
  const std::string_view key = one.substr(0, equals);
  double* member = member_of(base, key);
  if (member == nullptr) return "\"" + std::string(key) + "\" is an unknown key";
  const auto number = equals == one.npos ? std::nullopt : number_of(one.substr(equals + 1));
  if (!number) return "\"" + std::string(one) + "\" is not KEY=NUMBER";
  *member = key.ends_with("_deg") ? *number * std::numbers::pi / 180.0 : *number;
  return {};
}

}  // namespace

Result<Placement> read_placement(const std::string& text) {
  const std::size_t colon = text.find(':');
  Placement placement{.name = text.substr(0, colon), .base = {}};
  std::string faults = placement.name.empty() ? "the name is missing" : "";
  std::string_view rest(text);
  rest.remove_prefix(colon == text.npos ? text.size() : colon + 1);
  while (!rest.empty()) {
    const std::string_view one = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(rest.size(), one.size() + 1));
    const std::string fault = read_member(one, placement.base);
    if (!fault.empty()) faults += (faults.empty() ? "" : "; ") + fault;
  }
  if (!faults.empty()) return bad_robot(text, faults);
  return placement;
}

}  // namespace armloom
