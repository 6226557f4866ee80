#include "core/collision/motion_store.h"

#include <algorithm>

#include "core/trajectory/stopping_reach.h"

namespace armloom {

MotionStore::MotionStore(PlanningScenePtr scene)
    : scene_(scene),
      links_(std::move(scene)),
      diagram_scratch_(CoordinationDiagram::make_scratch()) {
  const std::size_t arms = scene_->cell().arms.size();
  for (std::uint32_t a = 0; a < arms; ++a) {
    arms_.push_back(std::make_shared<const ArmGeometry>(scene_->bodies(), ArmId{a}));
    scratch_.push_back(MotionTube::make_scratch(*arms_.back()));
  }
  still_parts_ = std::make_unique<StillParts>(scene_->bodies());
  still_.resize(arms);
  entries_.resize(arms);
}

void MotionStore::look_at(PlanningScenePtr scene) {
  if (!scene->holds_as(*scene_)) {
    *this = MotionStore(std::move(scene));
    return;
  }
  scene_ = std::move(scene);
  with_still_.clear();
  for (auto& pairs : still_) pairs.reset();
  still_parts_ = std::make_unique<StillParts>(scene_->bodies());
}

void MotionStore::begin_question() {
  ++question_;
  for (auto& entries : entries_) {
    if (entries.size() <= kKept) continue;
    std::ranges::nth_element(entries, entries.begin() + kKept, std::ranges::greater{},
                             [](const std::unique_ptr<Entry>& e) { return e->asked_at; });
    for (std::size_t i = kKept; i < entries.size(); ++i) drop(*entries[i]);
    entries.resize(kKept);
  }
}

void MotionStore::drop(const Entry& entry) {
  with_self_.erase(&entry);
  with_still_.erase(&entry);
  for (Entry* other : entry.compared) {
    between_.erase(entry.arm < other->arm ? Key{&entry, other} : Key{other, &entry});
    std::erase(other->compared, &entry);
  }
}

MotionStore::Entry& MotionStore::motion(const TrajectoryPtr& trajectory, ArmId arm,
                                        const Configuration& rest, double tracking_error) {
  const std::shared_ptr<const ArmGeometry>& geometry = arms_[arm.index()];
  const auto stands_as = [&](const Entry& entry) {
    for (std::size_t row = 0; row < entry.rest.size(); ++row) {
      const JointId joint = geometry->linkage.joints()[row];
      const bool moved = trajectory && std::ranges::find(trajectory->joints(), joint) !=
                                           trajectory->joints().end();
      const double stands = rest[static_cast<Eigen::Index>(joint.index())];
      if (!moved && entry.rest[row] != stands) return false;
    }
    return true;
  };
  auto& entries = entries_[arm.index()];
  for (const auto& entry : entries) {
    if (entry->trajectory == trajectory && entry->tracking_error == tracking_error &&
        stands_as(*entry)) {
      entry->asked_at = question_;
      return *entry;
    }
  }
  auto entry = std::make_unique<Entry>(
      Entry{arm,
            trajectory,
            {},
            tracking_error,
            std::make_shared<MotionTube>(geometry, trajectory, rest, tracking_error,
                                         scratch_[arm.index()]),
            trajectory ? stopping_reach_s(scene_->cell(), *trajectory) : 0.0,
            question_});
  for (const JointId joint : geometry->linkage.joints()) {
    entry->rest.push_back(rest[static_cast<Eigen::Index>(joint.index())]);
  }
  entries.push_back(std::move(entry));
  return *entries.back();
}

const PairSet& MotionStore::cross(ArmId a, ArmId b) {
  const auto found = cross_.find({a, b});
  if (found != cross_.end()) return found->second;
  PairSet pairs =
      cross_pairs(links_->bodies(), arms_[a.index()]->linkage, arms_[b.index()]->linkage);
  return cross_.emplace(std::pair(a, b), std::move(pairs)).first->second;
}

MotionStore::Diagram MotionStore::pair(Entry& a, Entry& b) {
  const PairSet& pairs = cross(a.arm, b.arm);
  auto& diagram = between_[{&a, &b}];
  if (!diagram) {
    diagram = std::make_unique<CoordinationDiagram>(
        CoordinationDiagram::Setting{&links_->bodies(), &pairs, diagram_scratch_}, a.tube, b.tube);
    a.compared.push_back(&b);
    b.compared.push_back(&a);
  }
  return {diagram.get(), &pairs, &links_->bodies()};
}

MotionStore::Diagram MotionStore::still(const Entry& a) {
  auto& pairs = still_[a.arm.index()];
  if (!pairs) {
    pairs = std::make_unique<PairSet>(
        still_pairs(scene_->bodies(), arms_[a.arm.index()]->linkage, *still_parts_));
  }
  auto& diagram = with_still_[&a];
  if (!diagram) {
    diagram = std::make_unique<CoordinationDiagram>(
        CoordinationDiagram::Setting{&scene_->bodies(), pairs.get(), diagram_scratch_}, a.tube,
        *still_parts_);
  }
  return {diagram.get(), pairs.get(), &scene_->bodies()};
}

MotionStore::Diagram MotionStore::self(const Entry& a) {
  const PairSet& pairs = arms_[a.arm.index()]->self;
  auto& diagram = with_self_[&a];
  if (!diagram) {
    diagram = std::make_unique<CoordinationDiagram>(
        CoordinationDiagram::Setting{&links_->bodies(), &pairs, diagram_scratch_}, a.tube);
  }
  return {diagram.get(), &pairs, &links_->bodies()};
}

CoordinationDiagram MotionStore::with_pairs(const Diagram& like, const PairSet& pairs) const {
  return like.cells->with({like.bodies, &pairs, diagram_scratch_});
}

bool MotionStore::out_of_reach(ArmId a, ArmId b) const {
  const Linkage& one = arms_[a.index()]->linkage;
  const Linkage& other = arms_[b.index()]->linkage;
  // Tracking errors and rounding are far below this.
  constexpr double kSlack_m = 0.05;
  return (one.root() - other.root()).norm() >
         one.reach_m() + other.reach_m() + scene_->cell().clearance_m + kSlack_m;
}

}  // namespace armloom
