#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/collision/coordination_diagram.h"
#include "core/collision/motion_tube.h"
#include "core/collision/planning_scene.h"

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
    std::vector<double> rest;  // of the arm's joints, rows of its linkage
    double tracking_error;
    std::shared_ptr<MotionTube> tube;
    double stopping_reach_s;
    std::uint64_t asked_at;
    std::vector<Entry*> compared = {};  // those that it has a diagram with
  };
  // Of each arm kKept entries are kept, those that questions named last. References hold until the
  // next begin_question().
  inline static constexpr std::size_t kKept = 64;
  void begin_question();
  [[nodiscard]] Entry& motion(const TrajectoryPtr& trajectory, ArmId arm, const Configuration& rest,
                              double tracking_error);

  struct Diagram {
    CoordinationDiagram* cells;
    const PairSet* pairs;
    const PlanningScene::Bodies* bodies;
  };
  // The first one's arm has the smaller id.
  [[nodiscard]] Diagram pair(Entry& a, Entry& b);
  [[nodiscard]] Diagram still(const Entry& a);
  [[nodiscard]] Diagram self(const Entry& a);
  // The same motions with other limits; nothing of it is kept. `pairs` must outlive it.
  [[nodiscard]] CoordinationDiagram with_pairs(const Diagram& like, const PairSet& pairs) const;

  // The arms cannot come closer than the cell's clearance, wherever they are.
  [[nodiscard]] bool out_of_reach(ArmId a, ArmId b) const;

 private:
  using Key = std::pair<const Entry*, const Entry*>;
  const PairSet& cross(ArmId a, ArmId b);
  void drop(const Entry& entry);

  PlanningScenePtr scene_;
  PlanningScenePtr links_;  // the scene that cross and self pairs were read from
  std::vector<std::shared_ptr<const ArmGeometry>> arms_;
  std::vector<std::shared_ptr<MotionTube::Scratch>> scratch_;  // by arm
  std::shared_ptr<CoordinationDiagram::Scratch> diagram_scratch_;
  std::map<std::pair<ArmId, ArmId>, PairSet> cross_;
  std::unique_ptr<StillParts> still_parts_;
  std::vector<std::unique_ptr<PairSet>> still_;                  // by arm, made when asked for
  std::vector<std::vector<std::unique_ptr<Entry>>> entries_;     // by arm
  std::map<Key, std::unique_ptr<CoordinationDiagram>> between_;  // of arms
  std::map<const Entry*, std::unique_ptr<CoordinationDiagram>> with_still_;
  std::map<const Entry*, std::unique_ptr<CoordinationDiagram>> with_self_;
  std::uint64_t question_ = 0;
};

}  // namespace armloom
