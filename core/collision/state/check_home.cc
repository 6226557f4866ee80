#include "core/collision/state/check_home.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/collision/scene/scene_bodies.h"
#include "core/collision/state/clearance_query.h"

namespace armloom {
namespace {

std::string home_pointer(const Cell& cell, ArmId arm) {
  const RobotId robot = cell.arm(arm).robot;
  const std::vector<ArmId>& arms = cell.robots[robot.index()].arms;
  const auto place = std::find(arms.begin(), arms.end(), arm) - arms.begin();
  return "/robots/" + std::to_string(robot.index()) + "/arms/" + std::to_string(place) + "/home";
}

// Returns the place in an SRDF that disables the pair without proof, or nullopt if no SRDF does.
std::optional<std::string> claim_of(const PlanningScene& scene, PairId pair) {
  const BodyPair& bodies = scene.bodies().pairs[pair.index()];
  const auto& a = scene.bodies().bodies[bodies.a].link;
  const auto& b = scene.bodies().bodies[bodies.b].link;
  if (!a || !b) return std::nullopt;
  const auto& claimed = scene.cell().allowed.claimed_pairs;
  const auto found = claimed.find(std::minmax(*a, *b));
  return found == claimed.end() ? std::nullopt : std::optional(found->second);
}

// Returns the remedies for two links of one arm.
std::string remedy_for_own_links(const Cell& cell, const Proximity& near) {
  std::array<char, 16> kept{};
  const double kept_m = std::floor(near.clearance_m * 1e4) / 1e4;
  std::snprintf(kept.data(), kept.size(), "%.4f", kept_m);
  return " (if these two are always so close, add to the SRDF " +
         disabling_element(cell, near.body_a, near.body_b) +
         (kept_m > 0.0 ? ", or lower the cell's \"self_clearance_m\" to " + std::string(kept.data())
                       : "") +
         "; else give another \"home\")";
}

}  // namespace

std::string disabling_element(const Cell& cell, const std::string& a, const std::string& b) {
  const auto in_srdf = [&](const std::string& name) {
    const auto link = cell.find_link(name);
    if (!link) return name;
    const Robot& robot = cell.robots[cell.link(*link).robot.index()];
    const std::string prefix = robot.prefix + robot.srdf_prefix;
    return name.starts_with(prefix) ? name.substr(prefix.size()) : name;
  };
  return "<disable_collisions link1=\"" + in_srdf(a) + "\" link2=\"" + in_srdf(b) +
         "\" reason=\"Never\"/>";
}

Problems check_home(const PlanningScenePtr& scene) {
  const Cell& cell = scene->cell();
  ClearanceQuery query(scene);
  Problems problems;
  for (const NearPair& pair : query.near_pairs(cell.home())) {
    const Proximity proximity = query.describe(pair);
    const bool self = query.is_self(pair.pair);
    const bool mount = query.is_mount(pair.pair) && cell.clearances.mount_clearance_m;
    char figures[120];
    const double m = proximity.clearance_m;
    std::snprintf(
        figures, sizeof figures,
        m < 0.0 ? ": overlap by %.4f m at home, %s is %.4f" : ": %.4f m apart at home, %s is %.4f",
        std::abs(m),
        self    ? "self_clearance_m"
        : mount ? "mount_clearance_m"
                : "clearance_m",
        proximity.limit_m);
    const std::string allow = "add [\"" + proximity.body_a + "\", \"" + proximity.body_b +
                              "\"] to the cell's \"allowed_collisions\"";
    const auto claim = claim_of(*scene, pair.pair);
    const std::string may_touch = "; if these two may touch, " + allow;
    std::string remedy =
        self ? remedy_for_own_links(cell, proximity)
             : " (give another \"home\" or move one of them" +
                   (proximity.arm_b && !claim ? "" : may_touch) +
                   (claim ? "; " + *claim + " disables the pair without proof, so it is checked"
                          : "") +
                   ")";
    if (query.is_mount(pair.pair) && proximity.clearance_m > 0.0) {
      remedy = " (" + proximity.body_b + " carries the arm: if only this link is so close " +
               "to it, " + allow + "; if the whole arm passes it so closely by design, and it " +
               "is not a table, add \"mount_clearance_m\": " +
               text_of(std::floor(proximity.clearance_m * 1000.0) / 1000.0) + " to the cell)";
    }
    problems.push_back({ProblemKind::invalid, "home-conflict", home_pointer(cell, *proximity.arm_a),
                        proximity.body_a + " and " + proximity.body_b + figures + remedy,
                        proximity.clearance_m});
  }
  return problems;
}

}  // namespace armloom
