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

// Keeps the tubes of motions and rests, and the diagrams between them, while they are asked about.
// What links and held objects do to each other outlives a change of the scene's objects. Not
// thread-safe.
class MotionStore {
 public:
  explicit MotionStore(PlanningScenePtr scene);

  // Objects have changed, or what arms hold; the cell is the same. Everything is forgotten if the
  // scene does not hold as the one before does (PlanningScene::holds_as).
  void look_at(PlanningScenePtr scene);
  [[nodiscard]] const PlanningScenePtr& scene() const { return scene_; }

  // One arm's motion, or its rest.
  struct Entry {
    ArmId arm;
    TrajectoryPtr trajectory;  // null: a rest
    std::vector<double> rest;  // of the arm's joints, rows of its kinematics
    double tracking_error;
    std::shared_ptr<MotionTube> tube;
    std::uint64_t asked_at;
    std::vector<Entry*> compared = {};            // those that it has a diagram with
    std::optional<double> stopping_reach_s = {};  // once it was asked for
    std::size_t bytes = 0;                        // of the tube, as last counted

    [[nodiscard]] Duration duration() const { return tube->duration(); }
  };
  // Of each arm kKept entries are kept, those that questions named last. References hold until the
  // next begin_question().
  inline static constexpr std::size_t kKept = 64;
  // Entries and diagrams hold no more memory than this when a question begins: entries that were
  // asked about longest ago go first.
  inline static constexpr std::size_t kBytesKept = std::size_t{192} << 20;
  // `progress`: null, or outlives the question.
  void begin_question(CheckProgress* progress = nullptr);
  // The check at hand: it may use so many cells; whether it is to end early.
  void expect(std::uint64_t cells);
  [[nodiscard]] bool is_interrupted() const;
  [[nodiscard]] Entry& motion(const TrajectoryPtr& trajectory, ArmId arm, const Configuration& rest,
                              double tracking_error);

  [[nodiscard]] double stopping_reach_s(Entry& entry) const;

  // Of two arms, empty where they are out of reach; of an arm and what stands still; of an arm and
  // itself.
  [[nodiscard]] OrientedDiagram between(Entry& own, Entry& other);
  [[nodiscard]] OrientedDiagram with_still(const Entry& own);
  [[nodiscard]] OrientedDiagram with_itself(const Entry& own);

  // The arms cannot come closer than the cell's clearance, wherever they are.
  [[nodiscard]] bool out_of_reach(ArmId a, ArmId b) const;

 private:
  using Key = std::pair<const Entry*, const Entry*>;  // of two arms; of one: twice the same
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
  PlanningScenePtr links_;  // the scene that cross and self pairs were read from
  std::vector<std::shared_ptr<const ArmGeometry>> arms_;
  struct Scratch {
    std::vector<std::shared_ptr<MotionTube::Scratch>> tubes;  // by arm
    std::shared_ptr<TubePair::Scratch> pair;
  };
  Scratch scratch_;
  std::shared_ptr<MotionTube> still_;
  struct Pairs {
    std::map<std::pair<ArmId, ArmId>, PairSet> cross;
    std::map<ArmId, PairSet> still;  // made when asked for
  };
  Pairs pairs_;
  std::vector<std::vector<std::unique_ptr<Entry>>> entries_;  // by arm
  struct Kept {
    Diagrams between, with_still, with_itself;
  };
  Kept diagrams_;
  std::uint64_t question_ = 0;
  // The entries and diagrams of the present question. Only they grow: begin_question() and
  // look_at() renew their counts.
  struct Named {
    std::vector<Entry*> entries;
    std::vector<Diagram*> diagrams;
  };
  Named named_;
  std::size_t bytes_ = 0;  // of all entries and diagrams, as last counted
};

}  // namespace armloom
