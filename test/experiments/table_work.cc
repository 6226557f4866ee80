#include "test/experiments/table_work.h"

#include <stdexcept>

namespace armloom::experiments {
namespace {

constexpr double kLow_m = 0.17;    // tool height over the world's floor: 7 cm above the table
constexpr double kAbove_m = 0.29;  // height before and after going down
constexpr int kTries = 2000;

std::optional<Spot> spot(const JobMaker& maker, ArmId arm, double x_m, double y_m) {
  auto low = maker.tool_at(arm, {x_m, y_m, kLow_m});
  auto above = maker.tool_at(arm, {x_m, y_m, kAbove_m});
  if (!low || !above) return std::nullopt;
  return Spot{*std::move(low), *std::move(above)};
}

}  // namespace

std::optional<Spot> spot_in(JobMaker& maker, ArmId arm, const Box2& box_W) {
  const double x_m = maker.draw(box_W.x0, box_W.x1);
  return spot(maker, arm, x_m, maker.draw(box_W.y0, box_W.y1));
}

std::optional<Spot> spot_in_tray(JobMaker& maker, ArmId arm, const Box2& box_B) {
  const double x_m = maker.draw(box_B.x0, box_B.x1);
  const Eigen::Vector3d p_WT = maker.from_base(arm, {x_m, maker.draw(box_B.y0, box_B.y1), 0.0});
  return spot(maker, arm, p_WT.x(), p_WT.y());
}

bool fill_time(const Cell& cell, ArmId arm, const Eigen::VectorXd& start, const WantedTime& wanted,
               std::vector<Leg>& legs) {
  const std::size_t leg = wanted.slowed;
  const std::vector<WaypointRequest> points = way(cell, arm, start, legs).points;
  const double spare_s = wanted.whole_s - points.back().time_from_start_s;
  if (spare_s < 0.0) return false;
  const double fastest_s = line_time_s(cell, arm, leg == 0 ? start : legs[leg - 1].q, legs[leg].q);
  legs[leg].speed = fastest_s / (whole_10_ms(fastest_s) + spare_s);
  return true;
}

void until_taken(const std::function<bool()>& task) {
  for (int i = 0; i < kTries; ++i) {
    if (task()) return;
  }
  throw std::runtime_error("no open task found");
}

}  // namespace armloom::experiments
