#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/collision/diagram/motion_tube.h"
#include "core/collision/diagram/tube_pair.h"
#include "core/collision/scene/planning_scene.h"
#include "core/coordination/proximity.h"

namespace armloom {

// May one arm move straight through its joint space from here to there, while everything else
// stands still? What planners ask thousands of times: an edge is proven for its whole length, with
// the clearances and the tracking error that jobs are judged by (Swept, motion_checker.h), against
// itself, what stands still, what it is mounted on, and the other arms where they rest; what arms
// hold included. A line is cut in eight, and what is not proven is halved (as CoordinationDiagram
// does it, along one axis).
//
// Holds the scratch: one per worker thread, not thread-safe. Deterministic.
class LineChecker {
 public:
  // `rest`: where every joint of the cell stands, those of the arm's group excepted. Tracking error
  // of every joint (rad, m). Arms that are left out are as good as gone, with what they hold.
  // Throws std::invalid_argument unless rest has an entry for each joint.
  LineChecker(PlanningScenePtr scene, ArmId arm, const Configuration& rest, double tracking_error,
              const std::vector<ArmId>& left_out = {});

  enum class Kind {
    free,       // proven for the whole line
    conflict,   // a pair is proven to be closer than its limit somewhere on it
    undecided,  // neither: as good as a conflict
  };
  struct Answer {
    Kind kind = Kind::free;
    double at = 0.0;                          // share of the line, 0 to 1: where ...
    std::optional<Proximity> proximity = {};  // ... and what, if not free; body_a is of the arm
                                              // with the smaller id
    // Undecided: what these two may move on top by the tracking error, and along what is left open
    // of the line; their distance does not leave that room.
    double moves_m = 0.0;
  };
  // Rows as the arm's joints. With from == to: the state, with its tracking error.
  [[nodiscard]] Answer line(const Eigen::VectorXd& from, const Eigen::VectorXd& to);
  [[nodiscard]] Answer state(const Eigen::VectorXd& q) { return line(q, q); }
  // The same without evidence, sooner.
  [[nodiscard]] bool is_free(const Eigen::VectorXd& from, const Eigen::VectorXd& to);

  // Stretches of lines that have been looked at, so far.
  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }
  [[nodiscard]] ArmId arm() const { return arm_; }
  [[nodiscard]] const PlanningScene& scene() const { return *scene_; }

  // A line for which more stretches than this would have to be looked at passes something so
  // closely that another way is sooner found.
  inline static constexpr int kStretchesMax = 600;
  // Stretches in which no joint moves by more than this are not halved; rad or m.
  inline static constexpr double kFinest = 1e-3;

 private:
  struct Counterpart {
    PairSet pairs;
    std::shared_ptr<MotionTube> tube;  // null: the arm itself
  };
  struct Found {
    std::size_t counterpart;
    int node;
    bool proven;
  };
  enum class Stretch { free, open, conflict };
  [[nodiscard]] std::shared_ptr<MotionTube> tube_along(const Eigen::VectorXd& from,
                                                       const Eigen::VectorXd& to) const;
  [[nodiscard]] TubePair pair_with(const Counterpart& other,
                                   const std::shared_ptr<MotionTube>& tube) const;
  [[nodiscard]] std::optional<Found> search(const std::shared_ptr<MotionTube>& tube,
                                            double distance);
  // The pair that lacks most of its limit there, and how much more than that was asked of it.
  struct Worst {
    TubePair::PairDistance pair;
    double moves_m;
  };
  [[nodiscard]] Worst worst_of(TubePair& pair, const std::shared_ptr<MotionTube>& tube,
                               const Found& found) const;
  [[nodiscard]] double limit_m(PairId pair) const;
  [[nodiscard]] Stretch look(TubePair& pair, TubePair::Nodes at,
                             std::vector<TubePair::Undecided>& undecided) const;

  PlanningScenePtr scene_;
  ArmId arm_;
  Configuration rest_;
  double tracking_error_;
  std::shared_ptr<const ArmGeometry> geometry_;
  std::shared_ptr<MotionTube::Scratch> tube_scratch_;
  std::shared_ptr<TubePair::Scratch> pair_scratch_;
  std::vector<Counterpart> counterparts_;
  std::vector<std::vector<int>> open_;  // by counterpart: nodes of the line at hand
  std::uint64_t evaluations_ = 0;
};

}  // namespace armloom
