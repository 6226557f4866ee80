#include "core/executive/home_search.h"

#include <algorithm>
#include <functional>
#include <map>
#include <ranges>
#include <set>
#include <utility>

#include "core/collision/state/check_home.h"
#include "core/collision/state/clearance_query.h"

namespace armloom {
namespace {

// Places the arms one after the other. If an arm finds no free candidate, the arm before it moves
// to its next one.
class Search {
 public:
  Search(const PlanningScenePtr& scene, const HomePlaces& places)
      : cell_(scene->cell()), query_(scene), places_(places), q_(cell_.home()) {}

  HomeChoice run() {
    HomeChoice choice;
    if (place(0)) {
      choice.chosen = chosen_;
    } else {
      for (std::size_t arm = 0; arm < places_.size(); ++arm) look_at_lasting(arm, choice);
      restart();
      if (!ignored_.empty() && place(0))
        choice.chosen = chosen_;
      else
        choice.frequent = frequent();
    }
    if (choice.chosen) choice.at_first = at_first(*choice.chosen);
    return choice;
  }

 private:
  // The number of an arm's candidates at which two bodies are too close.
  using Counts = std::map<PairId, HomeObstacle>;

  bool place(std::size_t arm) {
    if (arm == places_.size()) return true;
    for (std::size_t i = 0; i < places_[arm].size(); ++i) {
      move(arm, places_[arm][i].q);
      if (++checks_ > kHomeChecksMax) return false;
      if (!is_free(arm, places_[arm][i].clearance_m)) continue;
      chosen_.push_back(i);
      if (place(arm + 1)) return true;
      chosen_.pop_back();
    }
    return false;
  }

  void restart() {
    checks_ = 0;
    chosen_.clear();
  }

  void move(std::size_t arm, const Eigen::VectorXd& home) {
    const auto& joints = cell_.arms[arm].joints;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      q_[static_cast<Eigen::Index>(joints[j].index())] = home[static_cast<Eigen::Index>(j)];
    }
  }

  // Returns true if nothing of this arm is too close to bodies that are already placed.
  bool is_free(std::size_t arm, double clearance_m) {
    query_.set_limits(PairLimits::scaled(cell_, clearance_m));
    return std::ranges::none_of(query_.near_pairs(q_), [&](const NearPair& pair) {
      const Proximity proximity = query_.describe(pair);
      const auto is_placed = [&](const std::optional<ArmId>& id) {
        return !id || id->index() <= arm;
      };
      if (!is_placed(proximity.arm_a) || !is_placed(proximity.arm_b)) return false;
      if (ignored_.contains(pair.pair)) return false;
      return !query_.is_self(pair.pair) || pair.clearance_m < cell_.clearances.self_clearance_m;
    });
  }

  // Returns what is closer than the cell's limits now and involves the arm.
  std::vector<std::pair<PairId, HomeObstacle>> obstacles_of(std::size_t arm) {
    const ArmId id(static_cast<std::uint32_t>(arm));
    std::vector<std::pair<PairId, HomeObstacle>> obstacles;
    query_.set_limits(PairLimits::of(cell_));
    for (const NearPair& pair : query_.near_pairs(q_)) {
      Proximity near = query_.describe(pair);
      if (near.arm_b == id && near.arm_a != id) near = turned_around(near);
      if (near.arm_a != id || ignored_.contains(pair.pair)) continue;
      const bool is_self = query_.is_self(pair.pair);
      HomeObstacle obstacle{.body_a = near.body_a,
                            .body_b = near.body_b,
                            .arm = id,
                            .other = is_self ? std::nullopt : near.arm_b,
                            .is_self = is_self,
                            .places = 1,
                            .clearance_m = near.clearance_m,
                            .limit_m = near.limit_m,
                            .srdf_element = {}};
      if (is_self) obstacle.srdf_element = disabling_element(cell_, near.body_a, near.body_b);
      obstacles.emplace_back(pair.pair, std::move(obstacle));
    }
    return obstacles;
  }

  // Counts obstacles over the arm's candidates. Without `of_others`, pairs with other arms do not
  // count. Returns the number of candidates without an obstacle, too.
  std::pair<Counts, std::size_t> count(std::size_t arm, bool of_others) {
    Counts counts;
    std::size_t free = 0;
    for (const HomePlace& place : places_[arm]) {
      move(arm, place.q);
      bool is_free = true;
      for (const auto& [pair, obstacle] : obstacles_of(arm)) {
        if (obstacle.other && !of_others) continue;
        is_free = false;
        const auto [known, first] = counts.emplace(pair, obstacle);
        if (first) continue;
        ++known->second.places;
        known->second.clearance_m = std::max(known->second.clearance_m, obstacle.clearance_m);
      }
      free += is_free ? 1 : 0;
    }
    return {std::move(counts), free};
  }

  // Returns true if body_b is a link of the arm's robot.
  bool is_of_robot(const HomeObstacle& obstacle) const {
    const auto link = cell_.find_link(obstacle.body_b);
    return link && cell_.link(*link).robot == cell_.arm(obstacle.arm).robot;
  }

  void look_at_lasting(std::size_t arm, HomeChoice& choice) {
    std::set<PairId> lasting;
    for (const auto& [pair, obstacle] : count(arm, false).first) {
      if (obstacle.places < places_[arm].size() || !is_of_robot(obstacle)) continue;
      choice.lasting.push_back(obstacle);
      lasting.insert(pair);
    }
    ignored_.merge(lasting);
  }

  std::vector<HomeObstacle> frequent() {
    constexpr std::size_t kMost = 3;
    std::vector<HomeObstacle> all;
    for (std::size_t arm = 0; arm < places_.size(); ++arm) {
      const auto [counts, free] = count(arm, false);
      if (free == 0) append_most(counts, kMost, all);
    }
    if (!all.empty()) return all;
    // Every arm has a place by itself. With the other arms at their first candidates:
    for (std::size_t arm = 0; arm < places_.size(); ++arm) move(arm, places_[arm].front().q);
    Counts between;
    for (std::size_t arm = 0; arm < places_.size(); ++arm) {
      auto counts = count(arm, true).first;
      std::erase_if(counts, [](const auto& entry) { return !entry.second.other; });
      between.merge(counts);
      move(arm, places_[arm].front().q);
    }
    append_most(between, 1, all);
    return all;
  }

  void append_most(const Counts& counts, std::size_t most, std::vector<HomeObstacle>& all) const {
    std::vector<HomeObstacle> sorted;
    for (const auto& [pair, obstacle] : counts) sorted.push_back(obstacle);
    std::ranges::stable_sort(sorted, std::greater{}, &HomeObstacle::places);
    for (const HomeObstacle& obstacle : sorted | std::views::take(most)) {
      all.push_back(obstacle);
      if (obstacle.places == places_[obstacle.arm.index()].size()) break;  // a sufficient reason
    }
  }

  std::vector<std::optional<HomeObstacle>> at_first(const std::vector<std::size_t>& chosen) {
    std::vector<std::optional<HomeObstacle>> at_first(places_.size());
    for (std::size_t arm = 0; arm < places_.size(); ++arm) move(arm, places_[arm][chosen[arm]].q);
    for (std::size_t arm = 0; arm < places_.size(); ++arm) {
      if (chosen[arm] == 0) continue;
      move(arm, places_[arm].front().q);
      for (const auto& [pair, obstacle] : obstacles_of(arm)) {
        if (!at_first[arm] || obstacle.clearance_m < at_first[arm]->clearance_m)
          at_first[arm] = obstacle;
      }
      move(arm, places_[arm][chosen[arm]].q);
    }
    return at_first;
  }

  const Cell& cell_;
  ClearanceQuery query_;
  const HomePlaces& places_;
  Configuration q_;
  std::vector<std::size_t> chosen_;
  std::size_t checks_ = 0;
  std::set<PairId> ignored_;  // too close at every candidate of an arm
};

}  // namespace

Result<HomeChoice> find_free_homes(const CellPtr& cell, const HomePlaces& places) {
  const auto scene = PlanningScene::build(cell);
  if (!scene) return failure(scene.error());
  return Search(*scene, places).run();
}

}  // namespace armloom
