#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/collision/diagram/check_progress.h"
#include "core/collision/diagram/oriented_diagram.h"
#include "core/collision/scene/planning_scene.h"

namespace armloom {

// Keeps the tubes of motions and rests, and their diagrams, while questions use them. Diagrams of
// links and attached objects survive a change of objects. Not thread-safe.
class MotionStore {
 public:
  explicit MotionStore(PlanningScenePtr scene);

  // Switches to another scene of the same cell. Drops everything if the attached objects differ
  // (PlanningScene::holds_as).
  void look_at(PlanningScenePtr scene);
  [[nodiscard]] const PlanningScenePtr& scene() const { return scene_; }

  struct Entry {
    ArmId arm;
    TrajectoryPtr trajectory;  // null if at rest
    std::vector<double> rest;  // the arm's joints, rows as in its kinematics
    double tracking_error;
    std::shared_ptr<MotionTube> tube;
    std::uint64_t asked_at;
    std::vector<Entry*> compared = {};            // have a diagram with it
    std::optional<double> stopping_reach_s = {};  // cached
    std::size_t bytes = 0;                        // of the tube, as last counted

    [[nodiscard]] Duration duration() const { return tube->duration(); }
  };
  // When a question begins, each arm keeps the entries used last. References stay valid until the
  // next begin_question() or look_at().
  inline static constexpr std::size_t kKept = 64;
  // Memory limit when a question begins; the least recently used entries are dropped first.
  inline static constexpr std::size_t kBytesKept = std::size_t{192} << 20;
  // `progress`: null, or outlives the question.
  void begin_question(CheckProgress* progress = nullptr);
  // Announces how many cells the check may use; returns true if it must end early.
  void expect(std::uint64_t cells);
  [[nodiscard]] bool is_interrupted() const;
  [[nodiscard]] Entry& motion(const TrajectoryPtr& trajectory, ArmId arm, const Configuration& rest,
                              double tracking_error);

  [[nodiscard]] double stopping_reach_s(Entry& entry) const;

  // Diagrams of two arms (empty if out of reach), of an arm and static bodies, of an arm with
  // itself.
  [[nodiscard]] OrientedDiagram between(Entry& own, Entry& other);
  [[nodiscard]] OrientedDiagram with_still(const Entry& own);
  [[nodiscard]] OrientedDiagram with_itself(const Entry& own);

  [[nodiscard]] bool out_of_reach(ArmId a, ArmId b) const;

 private:
  using Key = std::pair<const Entry*, const Entry*>;  // two arms; or the same entry twice
  struct Diagram {
    std::unique_ptr<CoordinationDiagram> cells;
    std::size_t bytes = 0;  // as last counted
  };
  using Diagrams = std::map<Key, Diagram>;
  struct Comparison {
    const PlanningScene& scene;
    const PairSet& pairs;
    std::shared_ptr<MotionTube> second;
    bool turned = false;
  };
  [[nodiscard]] OrientedDiagram diagram(Diagrams& of, const Key& key, const Comparison& made);
  void look_at_still();
  void drop(const Entry& entry);
  void drop(Diagrams& of, const Key& key);
  void drop_oldest();
  void count();

  PlanningScenePtr scene_;
  PlanningScenePtr links_;  // source of cross and self pairs
  std::vector<std::shared_ptr<const ArmGeometry>> arms_;
  struct Scratch {
    std::vector<std::shared_ptr<MotionTube::Scratch>> tubes;  // by arm
    std::shared_ptr<TubePair::Scratch> pair;
  };
  Scratch scratch_;
  std::shared_ptr<MotionTube> still_;
  struct Pairs {
    std::map<std::pair<ArmId, ArmId>, PairSet> cross;
    std::map<ArmId, PairSet> still;  // built on first use
  };
  Pairs pairs_;
  std::vector<std::vector<std::unique_ptr<Entry>>> entries_;  // by arm
  struct Kept {
    Diagrams between, with_still, with_itself;
  };
  Kept diagrams_;
  std::uint64_t question_ = 0;
  // Entries and diagrams of the current question. Only these grow and are recounted.
  struct Named {
    std::vector<Entry*> entries;
    std::vector<Diagram*> diagrams;
  };
  Named named_;
  std::size_t bytes_ = 0;  // as last counted
};

}  // namespace armloom
