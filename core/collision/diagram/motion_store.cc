#include "core/collision/diagram/motion_store.h"

#include <algorithm>

#include "core/collision/diagram/tube_scratch.h"
#include "core/trajectory/stopping_reach.h"

namespace armloom {

MotionStore::MotionStore(PlanningScenePtr scene)
    : scene_(scene), links_(std::move(scene)), scratch_{{}, TubePair::make_scratch()} {
  const std::size_t arms = scene_->cell().arms.size();
  for (std::uint32_t a = 0; a < arms; ++a) {
    arms_.push_back(std::make_shared<const ArmGeometry>(scene_->bodies(), ArmId{a}));
    scratch_.tubes.push_back(MotionTube::make_scratch(*arms_.back()));
  }
  entries_.resize(arms);
  look_at_still();
}

void MotionStore::look_at(PlanningScenePtr scene) {
  if (!scene->holds_as(*scene_)) {
    *this = MotionStore(std::move(scene));
    return;
  }
  scene_ = std::move(scene);
  look_at_still();
}

void MotionStore::look_at_still() {
  diagrams_.with_still.clear();
  pairs_.still.clear();
  still_ = std::make_shared<MotionTube>(
      std::make_shared<const ArmGeometry>(scene_->bodies(), std::nullopt), nullptr,
      scene_->cell().home(), 0.0);
}

void MotionStore::begin_question(CheckProgress* progress) {
  scratch_.pair->progress = progress;
  for (auto& entries : entries_) {
    if (entries.size() <= kKept) continue;
    std::ranges::nth_element(entries, entries.begin() + kKept, std::ranges::greater{},
                             [](const std::unique_ptr<Entry>& e) { return e->asked_at; });
    for (std::size_t i = kKept; i < entries.size(); ++i) drop(*entries[i]);
    entries.resize(kKept);
  }
  while (bytes() > kBytesKept) drop_oldest();
  ++question_;
}

std::size_t MotionStore::bytes() const {
  std::size_t bytes = 0;
  for (const auto& entries : entries_) {
    for (const auto& entry : entries) bytes += entry->tube->bytes();
  }
  for (const auto* kept : {&diagrams_.between, &diagrams_.with_itself, &diagrams_.with_still}) {
    for (const auto& [key, diagram] : *kept) bytes += diagram->bytes();
  }
  return bytes;
}

// Of those that were asked about at one time the first arm's first.
void MotionStore::drop_oldest() {
  const auto asked_at = [](const std::unique_ptr<Entry>& entry) { return entry->asked_at; };
  std::vector<std::unique_ptr<Entry>>* of_arm = nullptr;
  std::size_t oldest = 0;
  for (auto& entries : entries_) {
    if (entries.empty()) continue;
    const auto found = std::ranges::min_element(entries, {}, asked_at);
    if (of_arm != nullptr && (*found)->asked_at >= (*of_arm)[oldest]->asked_at) continue;
    of_arm = &entries;
    oldest = static_cast<std::size_t>(found - entries.begin());
  }
  drop(*(*of_arm)[oldest]);
  of_arm->erase(of_arm->begin() + static_cast<std::ptrdiff_t>(oldest));
}

void MotionStore::expect(std::uint64_t cells) {
  if (scratch_.pair->progress != nullptr) scratch_.pair->progress->expect(cells);
}

bool MotionStore::is_interrupted() const {
  return scratch_.pair->progress != nullptr && scratch_.pair->progress->is_interrupted();
}

void MotionStore::drop(const Entry& entry) {
  diagrams_.with_itself.erase({&entry, &entry});
  diagrams_.with_still.erase({&entry, &entry});
  for (Entry* other : entry.compared) {
    diagrams_.between.erase(entry.arm < other->arm ? Key{&entry, other} : Key{other, &entry});
    std::erase(other->compared, &entry);
  }
}

MotionStore::Entry& MotionStore::motion(const TrajectoryPtr& trajectory, ArmId arm,
                                        const Configuration& rest, double tracking_error) {
  const std::shared_ptr<const ArmGeometry>& geometry = arms_[arm.index()];
  const auto stands_as = [&](const Entry& entry) {
    for (std::size_t row = 0; row < entry.rest.size(); ++row) {
      const JointId joint = geometry->kinematics.joints()[row];
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
                                         scratch_.tubes[arm.index()]),
            question_});
  for (const JointId joint : geometry->kinematics.joints()) {
    entry->rest.push_back(rest[static_cast<Eigen::Index>(joint.index())]);
  }
  entries.push_back(std::move(entry));
  return *entries.back();
}

double MotionStore::stopping_reach_s(Entry& entry) const {
  if (!entry.stopping_reach_s) {
    entry.stopping_reach_s =
        entry.trajectory ? armloom::stopping_reach_s(scene_->cell(), *entry.trajectory) : 0.0;
  }
  return *entry.stopping_reach_s;
}

OrientedDiagram MotionStore::diagram(Diagrams& of, const Key& key, const Comparison& made) {
  const TubePair::Setting setting{&made.scene.bodies(), &made.pairs, scratch_.pair};
  auto& cells = of[key];
  if (!cells) {
    cells = std::make_unique<CoordinationDiagram>(TubePair(setting, key.first->tube, made.second));
  }
  return {*cells, setting, made.turned};
}

OrientedDiagram MotionStore::between(Entry& own, Entry& other) {
  if (out_of_reach(own.arm, other.arm)) return {};
  const bool turned = other.arm < own.arm;
  Entry& a = turned ? other : own;
  Entry& b = turned ? own : other;
  const auto kinematics = [&](ArmId arm) -> const ArmKinematics& {
    return arms_[arm.index()]->kinematics;
  };
  auto pairs = pairs_.cross.find({a.arm, b.arm});
  if (pairs == pairs_.cross.end()) {
    pairs = pairs_.cross
                .emplace(std::pair(a.arm, b.arm),
                         pairs_between(links_->bodies(), kinematics(a.arm), kinematics(b.arm)))
                .first;
  }
  if (!diagrams_.between.contains({&a, &b})) {
    a.compared.push_back(&b);
    b.compared.push_back(&a);
  }
  return diagram(diagrams_.between, {&a, &b}, {*links_, pairs->second, b.tube, turned});
}

OrientedDiagram MotionStore::with_still(const Entry& own) {
  auto pairs = pairs_.still.find(own.arm);
  if (pairs == pairs_.still.end()) {
    pairs = pairs_.still
                .emplace(own.arm, pairs_between(scene_->bodies(), own.tube->kinematics(),
                                                still_->kinematics()))
                .first;
  }
  return diagram(diagrams_.with_still, {&own, &own}, {*scene_, pairs->second, still_});
}

OrientedDiagram MotionStore::with_itself(const Entry& own) {
  return diagram(diagrams_.with_itself, {&own, &own},
                 {*links_, own.tube->geometry().self, own.tube});
}

bool MotionStore::out_of_reach(ArmId a, ArmId b) const {
  const ArmKinematics& one = arms_[a.index()]->kinematics;
  const ArmKinematics& other = arms_[b.index()]->kinematics;
  // Tracking errors and rounding are far below this.
  constexpr double kSlack_m = 0.05;
  return (one.root() - other.root()).norm() >
         one.reach_m() + other.reach_m() + scene_->cell().clearances.clearance_m + kSlack_m;
}

}  // namespace armloom
