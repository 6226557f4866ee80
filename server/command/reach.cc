#include <cstdio>
#include <fstream>
#include <iostream>

#include "core/planning/tool_reach.h"
#include "server/codec/json_writer.h"
#include "server/command/command.h"
#include "server/command/progress.h"
#include "server/command/reach_picture.h"

namespace armloom {
namespace {

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

struct Extent {
  Eigen::Vector3d lower, upper;
};
// Returns the bounding box of the reached positions; zero if there are none.
Extent extent_of(const ToolReach& reach, const ArmReach& arm) {
  Extent extent{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  bool any = false;
  for (std::size_t place = 0; place < arm.directions.size(); ++place) {
    if (arm.directions[place] == 0) continue;
    const Eigen::Vector3d p = reach.grid.at(place);
    extent.lower = any ? extent.lower.cwiseMin(p).eval() : p;
    extent.upper = any ? extent.upper.cwiseMax(p).eval() : p;
    any = true;
  }
  return extent;
}

std::size_t by_either(const ToolReach& reach, const ArmReach& a, const ArmReach& b) {
  return reach.places(a) + reach.places(b) - reach.shared(a, b);
}

void print_table(const ToolReach& reach, const Cell& cell) {
  const std::size_t places = reach.grid.places();
  std::printf("%d x %d x %d positions, %g m apart, %zu tool directions at each\n\n",
              reach.grid.count[0], reach.grid.count[1], reach.grid.count[2], reach.grid.step_m,
              kReachDirections);
  std::printf(
      "| arm | tool | poses reached | positions reached | x, m | y, m | z, m "
      "|\n|---|---|--:|--:|--:|--:|--:|\n");
  for (const ArmReach& arm : reach.arms) {
    const auto [lower, upper] = extent_of(reach, arm);
    std::printf("| %s | %s | %.1f %% | %.1f %% |", cell.arm(arm.arm).name.c_str(),
                cell.link(arm.tool).name.c_str(),
                100 * share(reach.poses(arm), places * kReachDirections),
                100 * share(reach.places(arm), places));
    for (int i = 0; i < 3; ++i) std::printf(" %.2f to %.2f |", lower[i] + 0.0, upper[i] + 0.0);
    std::printf("\n");
  }
  if (reach.arms.size() < 2) return;
  std::printf("\n| both arms | positions | share of what either reaches |\n|---|--:|--:|\n");
  for (std::size_t a = 0; a < reach.arms.size(); ++a) {
    for (std::size_t b = a + 1; b < reach.arms.size(); ++b) {
      const ArmReach &one = reach.arms[a], &other = reach.arms[b];
      std::printf("| %s, %s | %zu | %.1f %% |\n", cell.arm(one.arm).name.c_str(),
                  cell.arm(other.arm).name.c_str(), reach.shared(one, other),
                  100 * share(reach.shared(one, other), by_either(reach, one, other)));
    }
  }
}

void print_json(const ToolReach& reach, const Cell& cell) {
  JsonWriter out;
  const auto list = [&out](const char* key, const Eigen::Vector3d& p) {
    out.key(key).begin_array();
    for (int i = 0; i < 3; ++i) out.value(p[i]);
    out.end_array();
  };
  out.begin_object().field("step_m", reach.grid.step_m);
  out.field("places", std::uint64_t{reach.grid.places()});
  out.field("directions", std::uint64_t{kReachDirections});
  out.key("arms").begin_array();
  for (const ArmReach& arm : reach.arms) {
    const auto [lower, upper] = extent_of(reach, arm);
    out.begin_object().field("arm", cell.arm(arm.arm).name).field("tool", cell.link(arm.tool).name);
    out.field("poses", std::uint64_t{reach.poses(arm)});
    out.field("places", std::uint64_t{reach.places(arm)});
    list("lower", lower);
    list("upper", upper);
    out.end_object();
  }
  out.end_array().key("overlaps").begin_array();
  for (std::size_t a = 0; a < reach.arms.size(); ++a) {
    for (std::size_t b = a + 1; b < reach.arms.size(); ++b) {
      const ArmReach &one = reach.arms[a], &other = reach.arms[b];
      out.begin_object().key("arms").begin_array();
      out.value(cell.arm(one.arm).name).value(cell.arm(other.arm).name).end_array();
      out.field("places", std::uint64_t{reach.shared(one, other)});
      out.field("by_either", std::uint64_t{by_either(reach, one, other)}).end_object();
    }
  }
  out.end_array().end_object();
  std::cout << out.text() << '\n';
}

}  // namespace

int show_reach(const ReachOptions& options) {
  const auto loaded = load_cell(options.cell_file);
  if (!loaded) return kExitBadInput;
  const auto scene = PlanningScene::build(loaded->cell);
  if (!scene) return refuse(options.cell_file, scene.error());
  ReachQuestion question{.step_m = options.step_m};
  if (!options.link.empty()) question.link = options.link;
  const auto reach = [&] {
    Progress progress("reach");
    question.on_progress = [&progress](double done) { progress.share(done); };
    return tool_reach(*scene, question);
  }();
  if (!reach) return refuse("reach", reach.error());
  options.json ? print_json(*reach, *loaded->cell) : print_table(*reach, *loaded->cell);
  if (options.picture.empty()) return kExitDone;
  std::ofstream file(options.picture);
  file << reach_picture(*reach, *loaded->cell);
  if (!file.flush()) {
    return refuse("reach", {Problem{ProblemKind::invalid, "cannot-write", "--picture",
                                    "cannot write " + options.picture, options.picture}});
  }
  return kExitDone;
}

}  // namespace armloom
