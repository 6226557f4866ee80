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

// Keeps the tubes of motions and of arms at rest, and the diagrams of these tubes, while questions
// use them. If only the objects of the scene change, diagrams of two arms and of an arm with itself
// are kept. The diagram of a motion with the static bodies is kept, too, if no object that is new,
// changed or gone is near what the motion sweeps. So a check after a change of the scene costs what
// meets the change. Not thread-safe.
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
    std::vector<double> rest;  // joint positions, by row of ArmKinematics::joints()
    double tracking_error;
    std::shared_ptr<MotionTube> tube;
    std::uint64_t asked_at;                       // number of the last question that used it
    std::vector<Entry*> compared = {};            // entries that have a diagram with this entry
    std::optional<double> stopping_reach_s = {};  // cached
    std::size_t bytes = 0;                        // of the tube, as last counted

    [[nodiscard]] Duration duration() const { return tube->duration(); }
  };
  // When a question begins, each arm keeps its kKept most recently used entries. References stay
  // valid until the next begin_question() or look_at().
  inline static constexpr std::size_t kKept = 64;
  // Memory limit when a question begins; the least recently used entries are dropped first.
  inline static constexpr std::size_t kBytesKept = std::size_t{192} << 20;
  // A diagram that refers to the static bodies of an earlier scene is dropped if so many questions
  // did not use it.
  inline static constexpr std::uint64_t kOldStillKept = 8;
  // If more objects differ between two scenes, diagrams with static bodies are made again.
  inline static constexpr std::size_t kFewChanges = 64;
  // `progress`: null, or an object that outlives the question.
  void begin_question(CheckProgress* progress = nullptr);
  // Announces how many cells the check may evaluate.
  void expect(std::uint64_t cells);
  // Returns true if the check must end early.
  [[nodiscard]] bool is_interrupted() const;
  [[nodiscard]] Entry& motion(const TrajectoryPtr& trajectory, ArmId arm, const Configuration& rest,
                              double tracking_error);

  [[nodiscard]] double stopping_reach_s(Entry& entry) const;

  // Return the diagram of two arms (empty if out of reach), of an arm and static bodies, and of an
  // arm with itself.
  [[nodiscard]] OrientedDiagram between(Entry& own, Entry& other);
  [[nodiscard]] OrientedDiagram with_still(const Entry& own);
  [[nodiscard]] OrientedDiagram with_itself(const Entry& own);

  [[nodiscard]] bool out_of_reach(ArmId a, ArmId b) const;

 private:
  // Two arms. For an arm alone, both are the same entry.
  using Key = std::pair<const Entry*, const Entry*>;
  struct Still;  // the static bodies of a scene
  struct Diagram {
    std::unique_ptr<CoordinationDiagram> cells;
    std::size_t bytes = 0;              // as last counted
    std::shared_ptr<Still> still = {};  // with_still only: what the diagram refers to
    PlanningScenePtr holds_in = {};     // with_still only: the last scene in which it was used
  };
  using Diagrams = std::map<Key, Diagram>;
  struct Comparison {
    const PlanningScene& scene;
    const PairSet& pairs;
    std::shared_ptr<MotionTube> second;
    bool turned = false;
  };
  [[nodiscard]] OrientedDiagram diagram(Diagrams& of, const Key& key, const Comparison& made);
  // Returns true if an object that differs between the two scenes may be near the motion.
  [[nodiscard]] bool meets_change(const Entry& own, const PlanningScene& before) const;
  void drop_old_still();
  void drop(const Entry& entry);
  void drop(Diagrams& of, const Key& key);
  void drop_oldest();
  void count();

  PlanningScenePtr scene_;
  PlanningScenePtr links_;  // scene of the pairs of two arms, and of an arm with itself
  std::vector<std::shared_ptr<const ArmGeometry>> arms_;
  struct Scratch {
    std::vector<std::shared_ptr<MotionTube::Scratch>> tubes;  // by arm
    std::shared_ptr<TubePair::Scratch> pair;
  };
  Scratch scratch_;
  std::shared_ptr<Still> still_;                              // of scene_; built on first use
  std::map<std::pair<ArmId, ArmId>, PairSet> cross_pairs_;    // built on first use
  std::vector<std::vector<std::unique_ptr<Entry>>> entries_;  // by arm
  struct Kept {
    Diagrams between, with_still, with_itself;
  };
  Kept diagrams_;
  std::uint64_t question_ = 0;
  // Entries and diagrams that the current question uses. Only these grow, so only their memory is
  // counted again.
  struct Named {
    std::vector<Entry*> entries;
    std::vector<Diagram*> diagrams;
  };
  Named named_;
  std::size_t bytes_ = 0;  // as last counted
};

}  // namespace armloom
