#pragma once

// The conservative filter compares capsules of eight configurations at once. It may report a pair
// as too close that is not, but never the reverse.
// Files compiled for different instruction sets include this header, so it must not emit code. It
// has plain data and function pointers only: no standard library, no Eigen.
//
// The last index of every array is the lane; each lane is one configuration. Poses are computed in
// double and rounded once to float. So the rounding margin is a few float roundings of a
// coordinate, however long the kinematic chain. All instruction sets perform the same operations in
// the same order, so their results are bitwise equal.

namespace armloom::filter {

inline constexpr long kLanes = 8;  // long, so that offsets of pointers are not computed in int

// A movable joint and its frame, whose z is the joint's axis. The frame's pose is X_parent * C *
// motion(multiplier * q[joint] + offset).
struct Frame {
  int parent;  // index of the parent frame, smaller than its own; -1 is the world
  int joint;   // row of q
  bool prismatic;
  bool about_x;  // C turns about x only, as in arms with right-angled joints
  double multiplier;
  double offset;
  double C[12];  // columns x, y, z, then the origin; m
};

// A capsule fixed in a frame (-1 is the world). Its ancestors are the frames from the root to that
// frame, as indices in ArmKinematics::ancestors.
struct Capsule {
  int frame;
  double center[3];  // in the frame, m
  double half[3];    // from the center to one end of the axis
  float radius_up;   // radius, rounded up
  float ball_up;     // radius + half length, rounded up
  int ancestors_begin;
  int depth;                // number of ancestors
  int motion_bounds_begin;  // first of depth + 1 rows in MotionBounds::rows
};

struct ArmKinematics {
  const Frame* frames;
  int frame_count;
  const Capsule* capsules;
  int capsule_count;
  const int* ancestors;
};

// Output of Kernel::place for q: [joint][kLanes] (rad or m).
// - frames: [frame][12][kLanes], laid out like Frame::C
// - axes: [frame][6][kLanes], the origin and z axis
// - capsules: [capsule][6][kLanes], the center and half axis
struct Placed {
  double* frames;
  float* axes;
  float* capsules;
};

// Bounds of each joint's deviation from the configuration, [frame][kLanes] (rad, m). The absolute
// deviation is at most span. The deviation is also s * drift + e, where |e| <= loose and s, between
// -1 and 1, is the same for all joints. span and loose are rounded up. |drift| + loose is at most
// span, except for rounding.
struct JointMotions {
  const float* span;
  const float* drift;
  const float* loose;
};

struct MotionBounds {
  float* rows;    // [row][kLanes], see Capsule::motion_bounds_begin
  float* sweeps;  // [capsule][kSweep][kLanes]
};
// A sweep bounds the motion of a capsule's axis. Each end moves by s V, with s between -1 and 1,
// plus a vector of limited length. A sweep has seven numbers: V of the end at center + half, V of
// the other end, and the largest length of the additional vector.
inline constexpr int kSweep = 7;

// For each capsule, a ball around it in all lanes, motion included: [4][size], center and radius.
// Lanes that are similar (of one state, or along a line) are far from most static bodies at once.
// `size` is a multiple of kLanes. If `balls` is null, every capsule may be anywhere.
struct Spread {
  const float* balls;
  long size;
};
constexpr long spread_size(long capsules) { return (capsules + kLanes - 1) / kLanes * kLanes; }

// One side of a comparison: capsules with known motion bounds.
struct Side {
  const float* capsules;      // Placed::capsules
  const float* motion_bound;  // [row][kLanes], m; null for both sides if nothing moves
  const float* ball;  // [4][kLanes], from Kernel::enclose: center, radius; for groups and boxes
  Spread spread = {nullptr, 0};
  const float* sweeps = nullptr;  // MotionBounds::sweeps: makes moving sides rarer to be near
};

// A capsule in one configuration, and its sweeps in consecutive stretches of a motion. Each stretch
// has its own lane, from `first` to before `end`.
struct SweptCapsule {
  const float* at;        // in Placed::capsules, at the lane of the configuration
  const float* capsules;  // in Placed::capsules, at the middle of each stretch
  const float* sweeps;    // in MotionBounds::sweeps
  int first, end;
};

// Bounds for two swept capsules along the direction that separates them.
struct Parted {
  float distance;    // lower bound of the distance (m); radii and margins are subtracted
  float towards[2];  // distance by which each capsule comes closer along that direction
};

// Two capsules to compare. row_a and row_b are the rows of Side::motion_bound that bound their
// motion.
struct Pair {
  int a, b;
  int row_a, row_b;
  float limit_up;        // required distance
  float radii_up;        // sum of both radii and the rounding margin
  float ends_up;         // sum of both half lengths
  float end_b_up;        // b's half length, plus a margin for an inexact nearest point
  float aa, bb;          // squared half lengths
  float inv_aa, inv_bb;  // 1 / aa, 1 / bb; zero if the axis is a point
};

// Consecutive pairs that share a capsule. If this capsule is not near the ball around the other
// side, all of them are skipped.
struct Group {
  int capsule;
  int row;
  int begin;  // range in Pairs::all
  int end;
  float limit_up;  // the largest limit of these pairs
  float size_up;   // sum of radius, half length and margin
};
struct Groups {
  const Group* all;
  int count;  // if 0, every pair is compared
  bool of_b;  // groups share a capsule of the second side, compared with the first side's ball
  // The second side's capsules, at most 64. Pairs of a capsule that is not near the first side's
  // ball are skipped. If empty, no capsule is skipped. begin and end are unused.
  const Group* others;
  int other_count;
  float limit_up;  // the largest limit of all pairs
};

struct Pairs {
  const Pair* all;
  int count;
  Groups groups;
};

// A capsule that is compared with static boxes. `row`: of Side::motion_bound.
struct BoxedCapsule {
  int capsule;
  int row;
  float radius_up;
  float ball_up;  // Capsule::ball_up
};
// A static box, and the capsules that are compared with it.
struct StaticBox {
  float R[9];  // rows: the box's axes in the world
  float center[3];
  float half_up[3];
  float ball_up;    // radius of the ball around the box, with the rounding margin
  float margin_up;  // the rounding margin
  float limit_up;   // required distance
  int begin;        // range in Boxes::capsules
  int end;
};
// A box is skipped if the ball around the first side (Side::ball) is not near the box.
struct Boxes {
  const StaticBox* all;
  int count;
  const BoxedCapsule* capsules;
};

// A pair that is undecided in some lanes. distance: lower bound at the configuration. motion_bound:
// largest decrease of the distance by motion. direction: from b to a, normal to the planes between
// which the gap is measured; near_pairs only, if a side moves.
struct Hit {
  int pair;        // index in Pairs::all or Boxes::all
  int capsule;     // near_boxes only: index in Boxes::capsules
  unsigned lanes;  // bit by lane
  float distance[kLanes];
  float motion_bound[kLanes];
  float direction[3 * kLanes];
};

struct Kernel {
  const char* name;
  void (*place)(const ArmKinematics& kinematics, const double* q, const Placed& out);
  // Bounds the motion of each capsule. `at`: output of place().
  // - Row m bounds how far any point of the capsule moves relative to anything that shares its
  //   first m ancestors. The bound is the sum, over the other ancestors, of span times the lever
  //   about the joint in this configuration. These levers bound motions of any size: if joints
  //   change one by one from base to tip, each joint turns the rest of the chain in its present
  //   shape.
  // - A sweep holds the first-order motion of the drifts. Its last number bounds all other motion
  //   along any direction (sweep.h: loose parts and the second sum).
  void (*inflate)(const ArmKinematics& kinematics, const Placed& at, const JointMotions& motions,
                  const MotionBounds& out);
  // Writes Side::ball, a ball around all capsules of a side, and Spread::balls. Motion is included.
  // rows[c] is the row of capsule c in `motion_bound`, which is null if nothing moves.
  void (*enclose)(const ArmKinematics& kinematics, const float* capsules, const float* motion_bound,
                  const int* rows, float* ball, float* spread);
  // Writes the pairs that are undecided in any of `lanes`; returns their number. `hits` must have
  // room for all pairs. A pair is also decided if its sweeps prove it apart.
  int (*near_pairs)(const Side& a, const Side& b, const Pairs& pairs, unsigned lanes, Hit* hits);
  // Bounds the distance of two swept capsules, for each stretch of `a` with each stretch of `b`.
  // `direction`: Hit::direction, at the lane of the configuration.
  Parted (*parted)(const SweptCapsule& a, const SweptCapsule& b, const Pair& pair,
                   const float* direction);
  // Likewise for capsules and static boxes. `hits` must have room for all capsules of all boxes.
  int (*near_boxes)(const Side& a, const Boxes& boxes, unsigned lanes, Hit* hits);
};

extern const Kernel kScalarKernel;  // one lane after the other; the reference for the other kernels
extern const Kernel kBaselineKernel;  // SSE2, which every x86-64 has
// Only if the processor has them (kernels.h), and unless compiled with ARMLOOM_SIMD=off.
extern const Kernel kAvx2Kernel;
extern const Kernel kAvx512Kernel;

// Returns the rounding margin of near_pairs and near_boxes (m) if no coordinate exceeds `extent_m`.
// The margin is part of Pair::radii_up. StaticBox::margin_up has one rounding more, of its sum with
// the radius.
// With u = 2^-24, a center or end of an axis is rounded once, to within sqrt(3) u extent.
// Differences, products with a unit vector (off by 4 u) and sums of at most 2 sqrt(3) extent are
// also rounded. Together these are at most 16 such roundings.
constexpr float rounding_margin(double extent_m) {
  return static_cast<float>(16.0 * 5.97e-8 * 1.7321 * extent_m);
}

}  // namespace armloom::filter
