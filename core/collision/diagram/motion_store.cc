#include "core/collision/diagram/motion_store.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/collision/diagram/tube_scratch.h"
#include "core/collision/scene/arm_reach.h"
#include "core/collision/scene/scene_bodies.h"
#include "core/geometry/capsule/capsule_fit.h"
#include "core/trajectory/stopping_reach.h"

namespace armloom {
namespace {

// Halves nodes down to this width.
constexpr Duration kFinest = std::chrono::milliseconds(50);
constexpr double kRounding_m = 1e-5;  // of the kernels, in float

// Returns true if a ball may be closer than limit_m to what the motion sweeps in the node. Never
// errs on the side of "far".
bool sweeps_near(MotionTube& tube, int node, const std::vector<Ball>& balls, double limit_m) {
  tube.place({&node, 1});
  const MotionTube::Place at = tube.place_of(node);
  const auto number = [&at](const float* of, std::size_t row) {
    return static_cast<double>(of[row * filter::kLanes + at.lane]);
  };
  const auto& capsules = tube.kinematics().capsules();
  bool is_near = false;
  for (std::size_t c = 0; c < capsules.size() && !is_near; ++c) {
    const auto point = [&](std::size_t row) {
      return Eigen::Vector3d(number(at.block->capsules, 6 * c + row),
                             number(at.block->capsules, 6 * c + row + 1),
                             number(at.block->capsules, 6 * c + row + 2));
    };
    const Eigen::Vector3d center = point(0), half = point(3);
    const LinkCapsule axis{center - half, center + half, 0.0};
    const double keep_m = static_cast<double>(capsules[c].radius_up) +
                          number(at.block->motion_bound, c) + limit_m + kRounding_m;
    is_near = std::ranges::any_of(balls, [&](const Ball& ball) {
      return distance_to_axis(axis, ball.center) < keep_m + ball.radius_m;
    });
  }
  if (!is_near || tube.width(node) <= kFinest) return is_near;
  const int child = tube.first_child(node);
  return sweeps_near(tube, child, balls, limit_m) || sweeps_near(tube, child + 1, balls, limit_m);
}

}  // namespace

struct MotionStore::Still {
  explicit Still(PlanningScenePtr of)
      : scene(std::move(of)),
        tube(std::make_shared<MotionTube>(
            std::make_shared<const ArmGeometry>(scene->bodies(), std::nullopt), nullptr,
            scene->cell().home(), 0.0)) {}
  PlanningScenePtr scene;
  std::shared_ptr<MotionTube> tube;
  std::map<ArmId, PairSet> pairs;  // built on first use
};

MotionStore::MotionStore(PlanningScenePtr scene)
    : scene_(scene), links_(std::move(scene)), scratch_{{}, TubePair::make_scratch()} {
  const std::size_t arms = scene_->cell().arms.size();
  for (std::uint32_t a = 0; a < arms; ++a) {
    arms_.push_back(std::make_shared<const ArmGeometry>(scene_->bodies(), ArmId{a}));
    scratch_.tubes.push_back(MotionTube::make_scratch(*arms_.back()));
  }
  entries_.resize(arms);
}

void MotionStore::look_at(PlanningScenePtr scene) {
  if (!scene->holds_as(*scene_)) {
    *this = MotionStore(std::move(scene));
    return;
  }
  count();
  scene_ = std::move(scene);
  still_.reset();
}

void MotionStore::drop_old_still() {
  std::vector<Key> old;
  for (const auto& [key, diagram] : diagrams_.with_still) {
    if (diagram.still != still_ && key.first->asked_at + kOldStillKept < question_) {
      old.push_back(key);
    }
  }
  for (const Key& key : old) drop(diagrams_.with_still, key);
}

void MotionStore::begin_question(CheckProgress* progress) {
  scratch_.pair->progress = progress;
  count();
  for (auto& entries : entries_) {
    if (entries.size() <= kKept) continue;
    std::ranges::nth_element(entries, entries.begin() + kKept, std::ranges::greater{},
                             [](const std::unique_ptr<Entry>& e) { return e->asked_at; });
    for (std::size_t i = kKept; i < entries.size(); ++i) drop(*entries[i]);
    entries.resize(kKept);
  }
  while (bytes_ > kBytesKept) drop_oldest();
  drop_old_still();
  ++question_;
}

void MotionStore::count() {
  const auto renew = [this](std::size_t& counted, std::size_t now) {
    bytes_ += now - counted;
    counted = now;
  };
  for (Entry* entry : named_.entries) renew(entry->bytes, entry->tube->bytes());
  for (Diagram* diagram : named_.diagrams) renew(diagram->bytes, diagram->cells->bytes());
  named_ = {};
}

// Drops the least recently used entry. If several entries are equally old, drops that of the first
// arm.
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
  drop(diagrams_.with_itself, {&entry, &entry});
  drop(diagrams_.with_still, {&entry, &entry});
  for (Entry* other : entry.compared) {
    drop(diagrams_.between, entry.arm < other->arm ? Key{&entry, other} : Key{other, &entry});
    std::erase(other->compared, &entry);
  }
  bytes_ -= entry.bytes;
}

void MotionStore::drop(Diagrams& of, const Key& key) {
  const auto found = of.find(key);
  if (found == of.end()) return;
  bytes_ -= found->second.bytes;
  of.erase(found);
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
      if (std::exchange(entry->asked_at, question_) != question_) {
        named_.entries.push_back(entry.get());
      }
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
  named_.entries.push_back(entry.get());
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
  Diagram& diagram = of[key];
  if (!diagram.cells) {
    diagram.cells =
        std::make_unique<CoordinationDiagram>(TubePair(setting, key.first->tube, made.second));
  }
  named_.diagrams.push_back(&diagram);
  return {*diagram.cells, setting, made.turned};
}

OrientedDiagram MotionStore::between(Entry& own, Entry& other) {
  if (out_of_reach(own.arm, other.arm)) return {};
  const bool turned = other.arm < own.arm;
  Entry& a = turned ? other : own;
  Entry& b = turned ? own : other;
  const auto kinematics = [&](ArmId arm) -> const ArmKinematics& {
    return arms_[arm.index()]->kinematics;
  };
  auto pairs = cross_pairs_.find({a.arm, b.arm});
  if (pairs == cross_pairs_.end()) {
    pairs = cross_pairs_
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
  const Key key{&own, &own};
  const auto known = diagrams_.with_still.find(key);
  if (known != diagrams_.with_still.end() && known->second.holds_in != scene_ &&
      meets_change(own, *known->second.holds_in)) {
    drop(diagrams_.with_still, key);
  }
  Diagram& made = diagrams_.with_still[key];
  made.holds_in = scene_;
  if (made.still == nullptr) {
    if (still_ == nullptr) still_ = std::make_shared<Still>(scene_);
    made.still = still_;
  }
  Still& still = *made.still;
  auto pairs = still.pairs.find(own.arm);
  if (pairs == still.pairs.end()) {
    pairs = still.pairs
                .emplace(own.arm, pairs_between(still.scene->bodies(), own.tube->kinematics(),
                                                still.tube->kinematics()))
                .first;
  }
  return diagram(diagrams_.with_still, key, {*still.scene, pairs->second, still.tube});
}

bool MotionStore::meets_change(const Entry& own, const PlanningScene& before) const {
  std::vector<Fingerprint> changes;
  std::ranges::set_symmetric_difference(before.fingerprint().objects[own.arm.index()],
                                        scene_->fingerprint().objects[own.arm.index()],
                                        std::back_inserter(changes));
  if (changes.size() > kFewChanges) return true;
  std::vector<Ball> balls;
  for (const PlanningScene* scene : {&before, scene_.get()}) {
    const PlanningScene::Bodies& of = scene->bodies();
    for (std::size_t i = of.held_end; i < of.bodies.size(); ++i) {
      const CollisionBody& object = of.bodies[i];
      if (!std::ranges::binary_search(changes, object.content)) continue;
      balls.push_back({object.X_CP * object.sphere.p_PC, object.sphere.radius_m});
    }
  }
  const double limit_m = std::max(scene_->cell().clearances.clearance_m, kTouching_m);
  return !balls.empty() && sweeps_near(*own.tube, TimeTree::root(), balls, limit_m);
}

OrientedDiagram MotionStore::with_itself(const Entry& own) {
  return diagram(diagrams_.with_itself, {&own, &own},
                 {*links_, own.tube->geometry().self, own.tube});
}

bool MotionStore::out_of_reach(ArmId a, ArmId b) const { return scene_->out_of_reach(a, b); }

}  // namespace armloom
