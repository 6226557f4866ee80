#include "core/executive/home_search.h"

#include <algorithm>

#include "core/collision/state/clearance_query.h"

namespace armloom {
namespace {

// Arms are placed one after the other; who finds no place sends the one before it to its next.
class Search {
 public:
  Search(const PlanningScenePtr& scene, const HomePlaces& places)
      : cell_(scene->cell()), query_(scene), places_(places), q_(cell_.home()) {}

  std::optional<std::vector<std::size_t>> run() {
    if (place(0)) return chosen_;
    return std::nullopt;
  }

 private:
  bool place(std::size_t arm) {
    if (arm == places_.size()) return true;
    for (std::size_t i = 0; i < places_[arm].size(); ++i) {
      stand(arm, places_[arm][i].q);
      if (++checks_ > kHomeChecksMax) return false;
      if (!is_free(arm, places_[arm][i].clearance_m)) continue;
      chosen_.push_back(i);
      if (place(arm + 1)) return true;
      chosen_.pop_back();
    }
    return false;
  }

  void stand(std::size_t arm, const Eigen::VectorXd& home) {
    const auto& joints = cell_.arms[arm].joints;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      q_[static_cast<Eigen::Index>(joints[j].index())] = home[static_cast<Eigen::Index>(j)];
    }
  }

  // Whether nothing of this arm is too close to what stands already.
  bool is_free(std::size_t arm, double clearance_m) {
    query_.set_limits(PairLimits::scaled(cell_, clearance_m));
    return std::ranges::none_of(query_.near_pairs(q_), [&](const NearPair& pair) {
      const Proximity proximity = query_.describe(pair);
      const auto stands = [&](const std::optional<ArmId>& id) { return !id || id->index() <= arm; };
      if (!stands(proximity.arm_a) || !stands(proximity.arm_b)) return false;
      return !query_.is_self(pair.pair) || pair.clearance_m < cell_.clearances.self_clearance_m;
    });
  }

  const Cell& cell_;
  ClearanceQuery query_;
  const HomePlaces& places_;
  Configuration q_;
  std::vector<std::size_t> chosen_;
  std::size_t checks_ = 0;
};

}  // namespace

Result<std::optional<std::vector<std::size_t>>> find_free_homes(const CellPtr& cell,
                                                                const HomePlaces& places) {
  const auto scene = PlanningScene::build(cell);
  if (!scene) return failure(scene.error());
  return Search(*scene, places).run();
}

}  // namespace armloom
