#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/collision/diagram/motion_tube.h"
#include "core/collision/diagram/tube_pair.h"
#include "core/collision/scene/planning_scene.h"
#include "core/coordination/proximity.h"
#include "core/coordination/tracking_errors.h"

namespace armloom {

// Checks for planners if one arm can move along a straight line in joint space without conflict
// while everything else rests. The whole line is certified with the clearances and tracking error
// of jobs (Swept, motion_checker.h). The arm and its attached objects are checked against
// themselves, static bodies, the mount, and the other arms at rest.
// A line is first cut into eight stretches. Stretches that are not certified are halved.
//
// Deterministic. Not thread-safe: use one LineChecker per worker thread.
class LineChecker {
 public:
  // - `rest`: positions of all joints of the cell; those of the arm's own joints are ignored
  // - `left_out`: arms that are ignored, with their attached objects
  // Throws std::invalid_argument unless `rest` has an entry for each joint.
  LineChecker(PlanningScenePtr scene, ArmId arm, const Configuration& rest,
              const TrackingErrors& tracking_errors, const std::vector<ArmId>& left_out = {});

  enum class Kind {
    free,       // the whole line is certified
    conflict,   // a pair is closer than its limit somewhere on the line
    undecided,  // neither is proven; treat it as a conflict
  };
  struct Answer {
    Kind kind = Kind::free;
    double at = 0.0;                          // place of the evidence: share of the line, 0 to 1
    std::optional<Proximity> proximity = {};  // the pair there; body_a has the smaller arm id
    // If undecided: how far the pair may move within the stretch (m), tracking error included. The
    // pair is not far enough apart for this motion.
    double moves_m = 0.0;
  };
  // Checks a line between two positions of the arm's joints, in their order. If from == to, checks
  // one state.
  [[nodiscard]] Answer line(const Eigen::VectorXd& from, const Eigen::VectorXd& to);
  [[nodiscard]] Answer state(const Eigen::VectorXd& q) { return line(q, q); }
  // Lets other arms that are too close to the arm at `from` move apart (let_part) in all later
  // answers.
  void let_part_from(const Eigen::VectorXd& from);
  // Returns true if line() would return `free`; faster, without evidence.
  [[nodiscard]] bool is_free(const Eigen::VectorXd& from, const Eigen::VectorXd& to);

  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }
  [[nodiscard]] ArmId arm() const { return arm_; }
  [[nodiscard]] const PlanningScene& scene() const { return *scene_; }

  // Largest number of stretches of a line. A line that needs more passes something so closely that
  // the planner finds another path faster.
  inline static constexpr int kStretchesMax = 600;
  // Stretches in which no joint moves by more than this (rad or m) are not halved.
  inline static constexpr double kFinest = 1e-3;

 private:
  // The opposite side of a comparison: another arm, the static bodies, or the arm itself.
  struct Counterpart {
    std::unique_ptr<PairSet> pairs;
    TubePair tubes;
    std::vector<int> open;  // nodes of the line still to check
  };
  struct Found {
    std::size_t counterpart;
    int node;
    bool proven;
  };
  // A stretch that the filter leaves undecided. begin, end: range in undecided_.
  struct Look {
    std::size_t counterpart;
    int node;
    std::size_t begin, end;
  };
  // A pair whose capsules overlap by -over_m more than the limit allows.
  struct Deep {
    double over_m;
    std::size_t of_batch;
    TubePair::Undecided u;
  };
  // The pair whose distance is farthest below the required distance, and how far the pair may move.
  struct Worst {
    TubePair::PairDistance pair;
    double moves_m;
  };
  enum class Stretch { free, open, conflict };
  void add(PairSet pairs, std::shared_ptr<MotionTube> a, std::shared_ptr<MotionTube> b);
  double cut(const Eigen::VectorXd& from, const Eigen::VectorXd& to);
  [[nodiscard]] TubePair::Nodes nodes_of(const TubePair& pair, int node) const;
  [[nodiscard]] std::optional<Found> search(const Eigen::VectorXd& from, const Eigen::VectorXd& to);
  [[nodiscard]] std::optional<Found> filter(std::size_t counterpart, std::span<const int> nodes,
                                            bool finest);
  [[nodiscard]] Stretch look(const Look& at);
  [[nodiscard]] Worst worst_of(const Found& found);
  [[nodiscard]] double limit_m(PairId pair) const;

  PlanningScenePtr scene_;
  ArmId arm_;
  std::shared_ptr<TubePair::Scratch> pair_scratch_;
  std::shared_ptr<MotionTube> line_;
  std::vector<Counterpart> counterparts_;
  // Scratch of search().
  std::vector<int> level_, halves_;  // nodes of the line
  std::vector<Look> looks_;
  std::vector<TubePair::Undecided> undecided_;
  std::vector<Deep> deep_;
  std::uint64_t evaluations_ = 0;
};

}  // namespace armloom
