#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "core/collision/diagram/sweep.h"
#include "core/collision/diagram/time_tree.h"
#include "core/collision/filter/pair_set.h"
#include "core/coordination/reach.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// An arm with its self-collision pairs, or all static bodies.
struct ArmGeometry {
  ArmGeometry(const PlanningScene::Bodies& bodies, std::optional<ArmId> arm)
      : kinematics(bodies, arm),
        self(arm ? pairs_between(bodies, kinematics, kinematics) : PairSet{}) {}
  ArmKinematics kinematics;
  PairSet self;
};

// One arm's motion over its trajectory time, or all static bodies. A node is an interval of this
// time. It holds the arm at the middle of the interval. It also bounds how far any point of each
// capsule may be from there during the interval. The bound includes `tracking_error` of each joint
// (rad, m). All comparisons of the motion share its nodes. Not thread-safe.
class MotionTube : public TimeTree {
 public:
  // Joints that are not in the trajectory rest at `rest` (positions of all joints of the cell).
  // Without a trajectory, one node covers all times. Tubes of one arm and thread may share their
  // scratch.
  struct Scratch;
  [[nodiscard]] static std::shared_ptr<Scratch> make_scratch(const ArmGeometry& geometry);
  MotionTube(std::shared_ptr<const ArmGeometry> geometry, TrajectoryPtr trajectory,
             const Configuration& rest, double tracking_error,
             std::shared_ptr<Scratch> scratch = nullptr);
  // The stretch of a motion that an arm may reach. Times count from the start of the stretch.
  MotionTube(std::shared_ptr<const ArmGeometry> geometry, const Reach& reach,
             std::shared_ptr<Scratch> scratch);

  // Replaces the motion by a straight line in joint space of `duration`, or by a rest at `from` if
  // duration is zero. Forgets all nodes, but keeps their memory for the next ones. `joints`: those
  // of `from` and `to`, in their order.
  void move_along(const std::vector<JointId>& joints, const Eigen::VectorXd& from,
                  const Eigen::VectorXd& to, Duration duration);

  [[nodiscard]] const ArmKinematics& kinematics() const { return geometry_->kinematics; }
  [[nodiscard]] const ArmGeometry& geometry() const { return *geometry_; }
  [[nodiscard]] const TrajectoryPtr& trajectory() const { return trajectory_; }

  // Places the nodes that are not placed yet, eight at once. Required before place_of() and
  // axes_of(). `with_self`: also required before self_hits(). Along a line (move_along), the nodes
  // must be of one level of the tree.
  void place(std::span<const int> nodes, bool with_self = false);
  // Returns the memory used, including the trajectory and the tree of times.
  [[nodiscard]] std::size_t bytes() const;
  // A wider node consists of stretches: nodes of at most this width.
  inline static constexpr Duration kStretch = std::chrono::microseconds(87'500);

  // Eight nodes, one per lane, in the data layout of the kernels.
  struct Block {
    explicit Block(const ArmKinematics& arm);

    std::size_t bytes = 0;
    std::unique_ptr<double[]> frames;  // [frame][12][kLanes]
    std::unique_ptr<float[]> floats;   // all arrays below
    float* capsules;                   // [capsule][6][kLanes]
    float* motion_bound;               // [capsule][kLanes]: motion bounds, m
    float* ball;                       // [4][kLanes], filter::Side::ball
    float* spread;                     // filter::Spread::balls
    float* drifts;                     // filter::JointMotions::drift
    float* looses;                     // filter::JointMotions::loose
    float* sweeps;                     // filter::MotionBounds::sweeps
  };
  struct Place {
    const Block* block;
    std::size_t lane;
    [[nodiscard]] const double* frames() const { return block->frames.get() + lane; }
  };
  [[nodiscard]] Place place_of(int node) const {
    return {blocks_[at(node).block].get(), at(node).lane};
  }
  // The stretches of a placed node: lanes [first, end) of a block. They are placed on first use.
  // `block` is null if there are more than eight.
  struct Stretches {
    const Block* block = nullptr;
    int first = 0;
    int end = 0;
  };
  [[nodiscard]] Stretches stretches_of(int node);

  // Writes the axes of the joints that move a frame, base to tip, without the first `skipped` axes.
  void axes_of(int node, int frame, std::size_t skipped, std::vector<MovingAxis>& axes) const;
  // A pair of the arm's own capsules that is undecided over the interval. `pair`: index in
  // ArmGeometry::self.pairs. distance: lower bound at the middle (m). motion_bound: bound of the
  // relative motion of both (m).
  struct SelfHit {
    int pair;
    float distance;
    float motion_bound;
  };
  [[nodiscard]] std::span<const SelfHit> self_hits(int node) const;

  // Writes the configuration at this time, one value per ArmKinematics::joints().
  void configuration(Duration time, double* q);
  // Returns the arm at rest in this configuration, with the same tracking error: one node.
  [[nodiscard]] std::shared_ptr<MotionTube> still_at(Duration time);

 private:
  MotionTube(std::shared_ptr<const ArmGeometry> geometry, Duration duration,
             std::shared_ptr<Scratch> scratch)
      : TimeTree(duration), geometry_(std::move(geometry)), scratch_(std::move(scratch)) {}

  struct Placement {  // of a node
    bool placed = false;
    bool with_self = false;  // self_begin and self_end are set
    std::size_t block = 0;
    std::size_t lane = 0;
    std::size_t self_begin = 0;
    std::size_t self_end = 0;
    Stretches stretches = {};
  };
  [[nodiscard]] const Placement& at(int node) const {
    return placements_[static_cast<std::size_t>(node)];
  }
  void place_batch(std::span<const int> nodes, bool with_self);
  void filter_self(std::span<const int> nodes, const Block& block);
  void collect_stretches(int node, std::vector<int>& stretches);
  void fill_lane(int node, int lane);
  void find_columns(const std::vector<JointId>& moved);
  void fill_lanes(std::span<const int> nodes);
  void fill_lanes_of_line(std::span<const int> nodes);

  std::shared_ptr<const ArmGeometry> geometry_;
  TrajectoryPtr trajectory_;
  Eigen::VectorXd line_from_, line_velocity_;  // empty unless moving along a line
  std::vector<int> column_;    // by row: index in the joints of the trajectory or line, or -1
  std::vector<double> rest_;   // by row
  Duration begin_{};           // trajectory time at which the tube begins
  std::vector<double> shift_;  // by row, of joints on the motion
  std::vector<double> error_;  // by row: largest deviation of the joint
  std::vector<Placement> placements_;
  std::vector<std::unique_ptr<Block>> blocks_;
  std::size_t used_ = 0;  // number of blocks in use
  std::vector<SelfHit> self_hits_;

  std::shared_ptr<Scratch> scratch_;
};

}  // namespace armloom
