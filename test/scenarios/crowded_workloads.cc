#include "test/scenarios/crowded_workloads.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "test/scenarios/disc_room.h"
#include "test/source_dir.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
// Builds one workload; returns nullopt if a random choice leads to a dead end.
class Maker : private DiscRoom {
 public:
  Maker(Crowd crowd, std::uint64_t seed) : DiscRoom(seed) {
    made_.crowd = crowd;
    made_.seed = seed;
  }

  std::optional<CrowdedWorkload> make() {
    bool found = false;
    switch (made_.crowd) {
      case Crowd::swap:
        found = exchange(2);
        break;
      case Crowd::ring3:
        found = exchange(3);
        break;
      case Crowd::ring4:
        found = exchange(4);
        break;
      case Crowd::queues:
        found = queues();
        break;
      case Crowd::parked:
        found = parked();
        break;
    }
    if (!found) return std::nullopt;
    submit();
    if (smallest_kept_m(made_) < kKeptOneByOne_m) return std::nullopt;
    return made_;
  }

 private:
  bool go(std::size_t arm, const Place& to, bool of_a_client = true) {
    auto found = way(arm, to);
    if (!found) return false;
    made_.solution.push_back({disc_motion(arm, std::move(*found), random_.uniform(0.25, 0.7))});
    made_.solution.back().back().of_a_client = of_a_client;
    stands_[arm] = to;
    return true;
  }

  // Moves each of `count` discs to the next disc's place, once or twice. They move one after the
  // other, with one disc waiting elsewhere first, or all together. One more disc may rest nearby.
  bool exchange(std::size_t count) {
    half_m_ = random_.uniform(0.6, 0.9);
    const double radius = random_.uniform(count == 4 ? 0.45 : 0.4, 0.6);
    const double turned = random_.uniform(0.0, 2.0 * std::numbers::pi);
    for (std::size_t i = 0; i < count; ++i) {
      const double angle =
          turned + 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
      stands_.push_back(radius * Place(std::cos(angle), std::sin(angle)));
    }
    if (random_.chance(0.3) && !stand_at_random(count + 1)) return false;
    made_.homes = stands_;
    const std::size_t laps = 1 + random_.index(2);
    for (std::size_t lap = 0; lap < laps; ++lap) {
      if (!(random_.chance(0.5) ? over_a_place_aside(count) : together(count))) return false;
    }
    return true;
  }

  bool over_a_place_aside(std::size_t count) {
    const std::vector<Place> goals = turned_by_one(count);
    const std::size_t first = random_.index(count);
    const auto aside = somewhere_free(first);
    if (!aside || !go(first, *aside)) return false;
    for (std::size_t n = 1; n <= count; ++n) {
      const std::size_t arm = (first + count - n) % count;  // the arm whose goal is free now
      if (!go(arm, goals[arm])) return false;
    }
    return true;
  }
  bool together(std::size_t count) {
    const std::vector<Place> goals = turned_by_one(count);
    const double speed_m_s = random_.uniform(0.25, 0.7);
    std::vector<DiscMotion> group;
    for (std::size_t arm = 0; arm < count; ++arm) {
      Way way{stands_[arm], goals[arm]};
      if (count == 2) {  // pass on the left
        const Place along = goals[arm] - stands_[arm];
        const Place left(-along.y(), along.x());
        way.insert(way.begin() + 1, stands_[arm] + 0.5 * along + 0.4 * left);
      }
      group.push_back(disc_motion(arm, std::move(way), speed_m_s));
    }
    made_.solution.push_back(std::move(group));
    for (std::size_t arm = 0; arm < count; ++arm) stands_[arm] = goals[arm];
    return true;
  }
  [[nodiscard]] std::vector<Place> turned_by_one(std::size_t count) const {
    std::vector<Place> goals;
    for (std::size_t arm = 0; arm < count; ++arm) goals.push_back(stands_[(arm + 1) % count]);
    return goals;
  }

  bool queues() {
    const std::size_t arms = 2 + random_.index(3);
    half_m_ = random_.uniform(0.3, 0.45) + 0.06 * static_cast<double>(arms);
    if (!stand_at_random(arms)) return false;
    made_.homes = stands_;
    std::vector<std::size_t> turns;
    for (std::size_t arm = 0; arm < arms; ++arm) {
      turns.insert(turns.end(), 2 + random_.index(2), arm);
    }
    shuffle(turns);
    for (const std::size_t arm : turns) {
      const auto to = somewhere_free(arm);
      if (!to || !go(arm, *to)) return false;
    }
    return true;
  }

  // The first disc moves to its place and has no more jobs. The others must pass or reach that
  // place, so the first disc goes home again. Returns false if its home would block the others.
  bool parked() {
    half_m_ = random_.uniform(0.6, 0.8);
    const std::size_t arms = 2 + random_.index(3);
    if (!stand_at_random(arms)) return false;
    made_.homes = stands_;
    const auto there = somewhere_free(0);
    if (!there || !go(0, *there)) return false;
    if (!go(0, made_.homes[0], false)) return false;
    for (std::size_t arm = 1; arm < arms; ++arm) {
      const bool through = random_.chance(0.5);
      const Place to = through ? Place(2.0 * *there - stands_[arm]) : *there;
      if (arm == 1) {
        if (!is_free(to, arm) || to.cwiseAbs().maxCoeff() > 1.5) return false;
        if (!go(arm, to)) return false;
        const Way& way = made_.solution.back().front().way;
        if (distance_to_leg(*there, way[0], way[1]) > 0.1 && way.back() != *there) return false;
      } else {
        const auto elsewhere = somewhere_free(arm);
        if (!elsewhere || !go(arm, *elsewhere)) return false;
      }
    }
    return true;
  }

  void submit() {
    std::vector<DiscMotion> motions;
    for (const auto& group : made_.solution) {
      for (const DiscMotion& one : group) {
        if (one.of_a_client) motions.push_back(one);
      }
    }
    if (made_.crowd == Crowd::parked) {
      const double after_s = motions.front().duration_s() + 1.0;
      for (const DiscMotion& one : motions) {
        made_.submitted.push_back({made_.submitted.empty() ? 0.0 : after_s, one, {}});
      }
    } else if (random_.chance(0.3)) {
      double at_s = 0.0;
      for (const DiscMotion& one : motions) {
        made_.submitted.push_back({at_s, one, {}});
        at_s += random_.uniform(0.0, 1.5);
      }
    } else {
      std::vector<std::size_t> turns;
      for (const DiscMotion& one : motions) turns.push_back(one.arm);
      shuffle(turns);
      for (const std::size_t arm : turns) {
        const auto next = std::ranges::find(motions, arm, &DiscMotion::arm);
        made_.submitted.push_back({0.0, *next, {}});
        motions.erase(next);
      }
    }
  }

  CrowdedWorkload made_;
};

}  // namespace

const char* to_string(Crowd crowd) {
  switch (crowd) {
    case Crowd::swap:
      return "swap";
    case Crowd::ring3:
      return "ring3";
    case Crowd::ring4:
      return "ring4";
    case Crowd::queues:
      return "queues";
    case Crowd::parked:
      return "parked";
  }
  return "";
}

std::string disc_name(std::size_t arm) { return std::string(1, static_cast<char>('a' + arm)); }

Eigen::Vector2d DiscMotion::at(double time_s) const {
  if (time_s <= 0.0) return way.front();
  for (std::size_t leg = 1; leg < way.size(); ++leg) {
    if (time_s >= times_s[leg]) continue;
    const double u = (time_s - times_s[leg - 1]) / (times_s[leg] - times_s[leg - 1]);
    const double share = u * u * u * (10.0 - 15.0 * u + 6.0 * u * u);
    return way[leg - 1] + share * (way[leg] - way[leg - 1]);
  }
  return way.back();
}

CellDescription CrowdedWorkload::cell() const {
  CellDescription cell{.name = "crowd"};
  for (std::size_t i = 0; i < homes.size(); ++i) {
    RobotDescription robot{.name = disc_name(i),
                           .urdf = source_dir() + "/test/scenarios/data/gantry.urdf",
                           .srdf = source_dir() + "/test/scenarios/data/gantry.srdf",
                           .prefix = disc_name(i) + "_"};
    ArmDescription arm{
        .name = robot.name, .group = "axes", .home = {homes[i].x(), homes[i].y()}, .limits = {}};
    arm.limits["x"].acceleration = arm.limits["y"].acceleration = 20.0;
    robot.arms.push_back(std::move(arm));
    cell.robots.push_back(std::move(robot));
  }
  cell.scheduling.backlog_timeout = 60s;
  return cell;
}

std::vector<TimedJob> CrowdedWorkload::jobs() const {
  std::vector<TimedJob> jobs;
  std::vector<int> count(homes.size(), 0);
  for (const Submitted& one : submitted) {
    const std::string arm = disc_name(one.motion.arm);
    JobRequest job{
        .key = arm + std::to_string(++count[one.motion.arm]), .name = "", .trajectory = {}};
    job.trajectory.joint_names = {arm + "_x", arm + "_y"};
    for (std::size_t i = 0; i < one.motion.way.size(); ++i) {
      const Place& place = one.motion.way[i];
      job.trajectory.points.push_back(
          {{place.x(), place.y()}, {0.0, 0.0}, {0.0, 0.0}, one.motion.times_s[i]});
    }
    for (const std::size_t before : one.after) job.after.push_back(jobs[before].job.key);
    jobs.push_back({at(from_seconds(one.at_s)), std::move(job)});
  }
  return jobs;
}

CrowdedWorkload make_crowded(Crowd crowd, std::uint64_t seed) {
  for (std::uint64_t attempt = 0; attempt < 200; ++attempt) {
    auto made = Maker(crowd, seed + (attempt << 32U)).make();
    if (!made) continue;
    made->seed = seed;
    return std::move(*made);
  }
  throw std::runtime_error("no workload for seed " + std::to_string(seed));
}

double smallest_kept_m(const CrowdedWorkload& workload) {
  double smallest = 1e9;
  std::vector<Place> stands = workload.homes;
  for (const auto& group : workload.solution) {
    const double owed = group.size() > 1 ? kKeptTogether_m - kKeptOneByOne_m : 0.0;
    double lasts_s = 0.0;
    for (const DiscMotion& one : group) lasts_s = std::max(lasts_s, one.duration_s());
    for (double t = 0.0; t < lasts_s + 1e-3; t += 1e-3) {
      for (const DiscMotion& one : group) stands[one.arm] = one.at(t);
      for (const DiscMotion& one : group) {
        for (std::size_t i = 0; i < stands.size(); ++i) {
          if (i == one.arm) continue;
          smallest = std::min(smallest, (stands[i] - stands[one.arm]).norm() - owed);
        }
      }
    }
    for (const DiscMotion& one : group) stands[one.arm] = one.way.back();
  }
  return smallest;
}

}  // namespace armloom
