#include "core/model/urdf/urdf_copy.h"

#include <tinyxml2.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace armloom {
namespace {

using tinyxml2::XMLElement;

constexpr double kRobotEnds_m = 10.0;  // larger than any robot in meters

}  // namespace

void warn_if_far(double length_m, const std::string& what, const XmlPlace& place) {
  if (length_m <= kRobotEnds_m) return;
  place.warn("far-away",
             what + " is " + text_of(length_m) +
                 " m, probably a unit error (millimeters?); its links are checked at that distance",
             length_m);
}

std::optional<std::vector<double>> copy_numbers(const XMLElement& from,
                                                const NumbersAttribute& attribute,
                                                const XmlPlace& place, XMLElement& to) {
  auto numbers = place.numbers(from, attribute.name, attribute.size, attribute.presence);
  if (!numbers) return std::nullopt;
  std::string text;
  for (const double number : *numbers) text += (text.empty() ? "" : " ") + text_of(number);
  to.SetAttribute(attribute.name, text.c_str());
  return numbers;
}

bool copy_if_there(const XMLElement& from, const char* attribute, std::size_t size,
                   const XmlPlace& place, XMLElement& to) {
  return from.Attribute(attribute) == nullptr ||
         copy_numbers(from, {attribute, size, Presence::optional}, place, to);
}

double norm_of(const std::vector<double>& v) { return Eigen::Vector3d(v[0], v[1], v[2]).norm(); }

void warn_if_degrees(const std::vector<double>& rpy, const XmlPlace& place) {
  constexpr double kTurn = 6.3;  // rad
  const auto far = std::ranges::find_if(rpy, [](double angle) { return std::abs(angle) > kTurn; });
  if (far == rpy.end()) return;
  place.warn("degrees",
             "origin rpy holds " + text_of(*far) +
                 ", more than a full turn: angles are in rad (degrees?), and this one is "
                 "used as rad",
             *far);
}

bool copy_origin(const XMLElement& parent, const XmlPlace& place, XMLElement& to) {
  const auto* origin = place.only_child(parent, "origin", Presence::optional);
  if (origin == nullptr) return true;
  if (origin->Attribute("quat_xyzw") != nullptr)
    place.at(*origin).report("unsupported",
                             "origin quat_xyzw is not read here; give the rotation as rpy",
                             std::string(origin->Attribute("quat_xyzw")), ProblemKind::unsupported);
  else
    place.only_attributes(*origin, {"xyz", "rpy"});
  XMLElement& copy = *to.InsertNewChildElement("origin");
  const auto xyz = copy_numbers(*origin, {"xyz", 3, Presence::optional}, place, copy);
  const auto rpy = copy_numbers(*origin, {"rpy", 3, Presence::optional}, place, copy);
  if (rpy) warn_if_degrees(*rpy, place.at(*origin));
  if ((!rpy && origin->Attribute("rpy") != nullptr) ||
      (!xyz && origin->Attribute("xyz") != nullptr))
    return false;
  if (xyz) warn_if_far(norm_of(*xyz), "origin xyz", place.at(*origin));
  return true;
}

}  // namespace armloom
