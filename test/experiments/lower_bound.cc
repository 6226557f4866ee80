#include "test/experiments/lower_bound.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "core/collision/filter/kernel.h"
#include "core/collision/state/clearance_query.h"
#include "test/experiments/open_places.h"

namespace armloom::experiments {
namespace {

// Samples of one arm, motion by motion.
struct Moments {
  ArmId arm;
  std::vector<std::size_t> motion;
  std::vector<Eigen::VectorXd> q;  // as Arm::joints
};

// Gripper joints are left out.
Moments moments_of(const Cell& cell, ArmId arm, const std::vector<Work>& work, Duration step) {
  Moments moments{arm};
  Configuration q = cell.home();
  const std::vector<JointId>& joints = cell.arm(arm).joints;
  for (std::size_t m = 0; m < work.size(); ++m) {
    if (work[m].arm != arm) continue;
    for (Duration time{}; time + step <= work[m].motion->duration(); time += step) {
      place(*work[m].motion, time, q);
      Eigen::VectorXd own(static_cast<Eigen::Index>(joints.size()));
      for (std::size_t j = 0; j < joints.size(); ++j) {
        own[static_cast<Eigen::Index>(j)] = q[static_cast<Eigen::Index>(joints[j].index())];
      }
      moments.motion.push_back(m);
      moments.q.push_back(std::move(own));
    }
  }
  return moments;
}

class Conflicts {
 public:
  explicit Conflicts(const CellPtr& cell) : cell_(*cell), check_(scene_of(cell)) {}

  [[nodiscard]] ConflictTable between(const Moments& a, const Moments& b) {
    ConflictTable table{a.q.size(), b.q.size(), std::vector<char>(a.q.size() * b.q.size())};
    std::array<Configuration, filter::kLanes> states;
    std::array<const Configuration*, filter::kLanes> pointers{};
    states.fill(cell_.home());
    for (std::size_t i = 0; i < states.size(); ++i) pointers[i] = &states[i];
    for (std::size_t row = 0; row < table.rows; ++row) {
      for (Configuration& state : states) put(a.arm, a.q[row], state);
      for (std::size_t first = 0; first < table.columns; first += states.size()) {
        const std::size_t count = std::min(states.size(), table.columns - first);
        for (std::size_t i = 0; i < count; ++i) put(b.arm, b.q[first + i], states[i]);
        const unsigned close = check_.too_close({pointers.data(), count});
        for (std::size_t i = 0; i < count; ++i) {
          table.conflict[row * table.columns + first + i] = (close >> i & 1U) != 0 ? 1 : 0;
        }
      }
    }
    return table;
  }

 private:
  static PlanningScenePtr scene_of(const CellPtr& cell) {
    auto scene = PlanningScene::build(cell);
    if (!scene) throw std::runtime_error(scene.error().front().detail);
    return *scene;
  }
  void put(ArmId arm, const Eigen::VectorXd& own, Configuration& q) const {
    const std::vector<JointId>& joints = cell_.arm(arm).joints;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      q[static_cast<Eigen::Index>(joints[j].index())] = own[static_cast<Eigen::Index>(j)];
    }
  }

  const Cell& cell_;
  ClearanceQuery check_;
};

void consider(std::size_t steps, Duration step, std::vector<std::string> arms, LowerBound& bound) {
  const double excluding_s = to_seconds(step) * static_cast<double>(steps);
  if (excluding_s <= bound.excluding_s) return;
  bound.excluding_s = excluding_s;
  bound.excluding = std::move(arms);
}

// A graph of the moments of all arms. An entry is 1 if two moments are compatible.
class FreeOfAll {
 public:
  explicit FreeOfAll(const std::vector<Moments>& arms) {
    for (const Moments& moments : arms) {
      first_.push_back(motion_.size());
      motion_.insert(motion_.end(), moments.motion.begin(), moments.motion.end());
    }
    free_.assign(motion_.size() * motion_.size(), 0);
  }
  void note(std::size_t a, std::size_t b, const ConflictTable& table) {
    const std::size_t n = motion_.size();
    for (std::size_t i = 0; i < table.rows; ++i) {
      for (std::size_t j = 0; j < table.columns; ++j) {
        if (table.conflict[i * table.columns + j] != 0) continue;
        free_[(first_[a] + i) * n + first_[b] + j] = 1;
        free_[(first_[b] + j) * n + first_[a] + i] = 1;
      }
    }
  }
  [[nodiscard]] std::size_t steps() const {
    return steps_chosen(exclusion_of_all(free_, motion_.size()), motion_);
  }

 private:
  std::vector<std::size_t> first_;  // first moment of each arm
  std::vector<std::size_t> motion_;
  std::vector<char> free_;
};

}  // namespace

LowerBound lower_bound(const CellPtr& cell, const std::vector<Work>& work, Duration step) {
  LowerBound bound;
  std::vector<Duration> own(cell->arms.size());
  for (const Work& part : work) own[part.arm.index()] += part.motion->duration();
  const auto most = std::ranges::max_element(own);
  bound.own_s = to_seconds(*most);
  bound.busiest = cell->arms[static_cast<std::size_t>(most - own.begin())].name;

  std::vector<Moments> arms;
  for (std::uint32_t i = 0; i < cell->arms.size(); ++i) {
    arms.push_back(moments_of(*cell, ArmId(i), work, step));
  }
  Conflicts conflicts(cell);
  FreeOfAll free(arms);
  std::vector<std::string> names;
  for (const Arm& arm : cell->arms) names.push_back(arm.name);
  for (std::size_t a = 0; a < arms.size(); ++a) {
    for (std::size_t b = a + 1; b < arms.size(); ++b) {
      const ConflictTable table = conflicts.between(arms[a], arms[b]);
      const ChosenMoments chosen = largest_exclusion(table);
      consider(
          steps_chosen(chosen.rows, arms[a].motion) + steps_chosen(chosen.columns, arms[b].motion),
          step, {names[a], names[b]}, bound);
      free.note(a, b, table);
    }
  }
  if (arms.size() > 2) consider(free.steps(), step, names, bound);
  return bound;
}

}  // namespace armloom::experiments
