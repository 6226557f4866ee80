#include "core/executive/claimed_pairs.h"

#include <algorithm>
#include <utility>

#include "core/collision/scene/scene_bodies.h"

namespace armloom {

Result<ClaimedPairsReport> report_claimed_pairs(CellPtr cell) {
  ClaimedPairsReport report;
  const AllowedCollisions& allowed = cell->allowed;
  if (allowed.claimed_pairs.empty()) return report;
  const auto scene = PlanningScene::build(cell);
  if (!scene) return failure(scene.error());
  for (const auto& [pair, place] : allowed.claimed_pairs) {
    if (allowed.allows(pair.first, pair.second)) {
      ++report.cell_file;
    } else if ((*scene)->bodies().out_of_reach->contains(pair)) {
      ++report.out_of_reach;
    } else {
      report.checked.push_back({cell->link(pair.first).name, cell->link(pair.second).name, place});
    }
  }
  return report;
}

std::string to_text(const ClaimedPairsReport& report) {
  constexpr std::size_t kTold = 3;
  const std::size_t count = report.out_of_reach + report.cell_file + report.checked.size();
  if (count == 0) return {};
  std::string text = "the SRDF disables " + std::to_string(count) +
                     (count == 1 ? " pair" : " pairs") +
                     " of links of different arms, or of an arm and its surroundings: " +
                     std::to_string(report.out_of_reach) + " proven out of reach and skipped, " +
                     std::to_string(report.cell_file) + " allowed by the cell file, " +
                     std::to_string(report.checked.size()) + " checked nevertheless";
  if (report.checked.empty()) return text;
  std::string pairs;
  for (std::size_t i = 0; i < std::min(kTold, report.checked.size()); ++i) {
    const ClaimedPairsReport::Pair& pair = report.checked[i];
    pairs += (i == 0 ? "" : ", ") + pair.link_a + " and " + pair.link_b + " at " + pair.place;
  }
  if (report.checked.size() > kTold) pairs += ", ...";
  return text + " (" + pairs + "); add a pair to the cell's \"allowed_collisions\" to skip it, too";
}

}  // namespace armloom
