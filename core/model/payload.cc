#include "core/model/payload.h"

#include <algorithm>
#include <cstdio>

namespace armloom {
namespace {

constexpr double kRounding = 1e-9;

// Returns the pose of the object in the hand of this arm; null if the arm does not hold it.
const Eigen::Isometry3d* pose_in_hand(const Cell& cell, const Attachment& held, ArmId arm) {
  if (cell.link(held.link).arm == arm) return &held.X_LO;
  for (const Attachment::Other& other : held.others) {
    if (cell.link(other.link).arm == arm) return &other.X_LO;
  }
  return nullptr;
}

}  // namespace

double counted_mass(const Cell& cell, ArmId arm, std::span<const Attachment> held) {
  const auto& payload = cell.arm(arm).payload;
  double counted_kg = 0.0;
  for (const Attachment& one : held) {
    const Eigen::Isometry3d* X_LO = pose_in_hand(cell, one, arm);
    if (!payload || X_LO == nullptr) continue;
    const double lever_m = (*X_LO * one.object.mass.center).norm();
    counted_kg += one.object.mass.kg * std::max(1.0, lever_m / payload->lever_m);
  }
  return counted_kg;
}

double kept_brake(const Cell& cell, ArmId arm, std::span<const Attachment> held) {
  const auto& payload = cell.arm(arm).payload;
  if (!payload) return 1.0;
  const double share = std::min(1.0, counted_mass(cell, arm, held) / payload->max_kg);
  return 1.0 - share * (1.0 - payload->brake_at_max);
}

std::optional<Problem> find_overload(const Cell& cell, ArmId arm,
                                     std::span<const Attachment> held) {
  const Arm& carrier = cell.arm(arm);
  if (!carrier.payload) {
    const auto heavy = std::ranges::find_if(held, [&](const Attachment& one) {
      return pose_in_hand(cell, one, arm) != nullptr && one.object.mass.kg > 0.0;
    });
    if (heavy == held.end()) return std::nullopt;
    return Problem{ProblemKind::conflict, "payload-unknown", "",
                   heavy->object.name + " has a mass, and arm " + carrier.name +
                       " states no payload: add \"payload\" to the arm in the cell file, or leave "
                       "\"mass_kg\" out of the object",
                   heavy->object.mass.kg};
  }
  const double max_kg = carrier.payload->max_kg * (1.0 + kRounding);
  const double counted_kg = counted_mass(cell, arm, held);
  if (counted_kg <= max_kg) return std::nullopt;
  double mass_kg = 0.0;
  for (const Attachment& one : held) {
    if (pose_in_hand(cell, one, arm) != nullptr) mass_kg += one.object.mass.kg;
  }
  char text[200];
  if (mass_kg > max_kg) {
    std::snprintf(
        text, sizeof text,
        " would hold %.4g kg, its payload is %.4g kg: use a stronger arm or a lighter object",
        mass_kg, carrier.payload->max_kg);
  } else {
    std::snprintf(
        text, sizeof text,
        " would hold %.4g kg, which counts as %.4g kg because the center of mass is more "
        "than %.4g m from the hand; its payload is %.4g kg: hold the object nearer to its "
        "center of mass",
        mass_kg, counted_kg, carrier.payload->lever_m, carrier.payload->max_kg);
  }
  return Problem{ProblemKind::conflict, "too-heavy", "", "arm " + carrier.name + text, counted_kg};
}

}  // namespace armloom
