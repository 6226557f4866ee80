#include "test/experiments/short_beside_long.h"

#include "test/experiments/table_work.h"

namespace armloom::experiments {
namespace {

// Adds a task: carry a part from the tray to the middle, then move down to the next part.
bool short_task(JobMaker& maker, ArmId arm, Spot& part) {
  const double speed = maker.draw(0.9, 1.0);
  const auto place = spot_in(maker, arm, kMiddle_W);
  const auto next = spot_in_tray(maker, arm, kTray_B);
  if (!place || !next) return false;
  if (!maker.add(arm, TimePoint{},
                 {{"short",
                   {{part.above, speed},
                    {place->above, speed},
                    {place->low, speed, kGrip_s},
                    {place->above, speed},
                    {next->above, speed},
                    {next->low, speed, kGrip_s}}}})) {
    return false;
  }
  part = *next;
  return true;
}
bool first_part(JobMaker& maker, ArmId arm, Spot& part) {
  const auto first = spot_in_tray(maker, arm, kTray_B);
  if (!first ||
      !maker.add(arm, TimePoint{}, {{"ready", {{first->above}, {first->low, 1.0, kGrip_s}}}})) {
    return false;
  }
  part = *first;
  return true;
}

// Adds a task: move slowly along a seam, once down in the middle, then down to the next seam.
bool long_task(JobMaker& maker, ArmId arm, double wanted_s, Spot& seam) {
  const auto end = spot_in_tray(maker, arm, kTray_B);
  const auto next = spot_in_tray(maker, arm, kTray_B);
  const auto place = spot_in(maker, arm, kMiddle_W);
  if (!end || !next || !place) return false;
  std::vector<Leg> legs = {
      {end->low},     {end->above},  {place->above},           {place->low, 1.0, kGrip_s},
      {place->above}, {next->above}, {next->low, 1.0, kGrip_s}};
  if (!fill_time(maker.cell(), arm, seam.low, {wanted_s, 0}, legs)) return false;
  if (!maker.add(arm, TimePoint{}, {{"long", legs}})) return false;
  seam = *next;
  return true;
}

}  // namespace

std::vector<PlannedJob> short_beside_long(const CellPtr& two_pandas, std::uint64_t seed) {
  JobMaker maker(two_pandas, seed);
  const ArmId quick(seed % 2 == 1 ? 0U : 1U);
  const ArmId slow(seed % 2 == 1 ? 1U : 0U);
  constexpr int kLong = 4;
  Spot part;
  until_taken([&] { return first_part(maker, quick, part); });
  for (int task = 0; task < 3 * kLong; ++task) {
    until_taken([&] { return short_task(maker, quick, part); });
  }
  Spot seam;
  until_taken([&] { return first_part(maker, slow, seam); });
  const std::vector<PlannedJob>& shorts = maker.jobs_of(quick);
  for (std::size_t task = 0; task < kLong; ++task) {
    Duration work{};
    for (std::size_t i = 0; i < 3; ++i) work += shorts[1 + 3 * task + i].trajectory->duration();
    until_taken([&] { return long_task(maker, slow, to_seconds(work), seam); });
  }
  return maker.take();
}

}  // namespace armloom::experiments
