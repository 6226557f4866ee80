#pragma once

// The conservative filter: capsules of eight configurations at once. Plain data and function
// pointers only: files compiled for other instruction sets include this header, so it must not emit
// code (no standard library, no Eigen).
//
// The last index of every array is the lane, one configuration each. Poses are computed in double
// and rounded once to float, so the rounding margin is a few float roundings of a coordinate,
// however long the chain. All instruction sets perform the same operations in the same order:
// results are bitwise equal.

namespace armloom::filter {

inline constexpr int kLanes = 8;

// A movable joint and its frame, whose z is the joint's axis: X_parent * C * motion(multiplier *
// q[joint] + offset).
struct Frame {
  int parent;  // smaller than the own index; -1: the world
  int joint;   // row of q
  bool prismatic;
  bool about_x;  // C turns about x only, as right-angled joints do
  double multiplier;
  double offset;
  double C[12];  // columns x, y, z, then the origin; m
};

// A capsule fixed in a frame (-1: the world). Its ancestors are the frames from the root to its
// own, as indices in ArmKinematics::ancestors.
struct Capsule {
  int frame;
  double center[3];  // in the frame, m
  double half[3];    // from the center to one end
  float radius_up;   // rounded up
  float ball_up;     // radius and half length, rounded up
  int ancestors_begin;
  int depth;                // number of ancestors
  int motion_bounds_begin;  // first of its depth + 1 rows
};

struct ArmKinematics {
  const Frame* frames;
  int frame_count;
  const Capsule* capsules;
  int capsule_count;
  const int* ancestors;
};

// q: [joint][kLanes], rad or m. Outputs: frames [frame][12][kLanes] as Frame::C; axes
// [frame][6][kLanes]: origin and z axis; capsules [capsule][6][kLanes]: center and half axis.
struct Placed {
  double* frames;
  float* axes;
  float* capsules;
};

// Bounds of each joint's deviation from the configuration, [frame][kLanes] (rad, m), rounded up. It
// is at most span; it is also s * drift + e, with |e| <= loose and the same s, from -1 to 1, for
// all joints. |drift| + loose is at most span, but for rounding.
struct JointMotions {
  const float* span;
  const float* drift;
  const float* loose;
};

struct MotionBounds {
  float* rows;    // [row][kLanes], see Capsule::motion_bounds_begin
  float* sweeps;  // [capsule][kSweep][kLanes]
};
// A sweep: both ends of a capsule's axis move by s V, -1 <= s <= 1, and a vector of at most some
// length. V of the end at center + half, V of the other end, the length.
inline constexpr int kSweep = 7;

// One side of a comparison: capsules with known motion bounds.
struct Side {
  const float* capsules;      // as Placed::capsules
  const float* motion_bound;  // [row][kLanes], m; null for both sides: no motion
  const float* ball;  // [4][kLanes]: center, radius of Kernel::enclose; only for pairs with groups
};

// A capsule in one configuration, and its sweeps in the stretches [first, end), side by side.
struct SweptCapsule {
  const float* at;        // in Placed::capsules, at its lane
  const float* capsules;  // in Placed::capsules, at the middle of each stretch
  const float* sweeps;    // in MotionBounds::sweeps
  int first, end;
};

// Two swept capsules along the direction that separates them.
struct Parted {
  float distance;    // lower bound (m), less radii and margins
  float towards[2];  // how much closer each comes along it
};

// Two capsules to compare. Rows of the sides' motion_bound arrays bound their motion.
struct Pair {
  int a, b;
  int row_a, row_b;
  float limit_up;        // required distance
  float radii_up;        // both radii and the rounding margin
  float ends_up;         // both half lengths
  float end_b_up;        // b's half length, and the effect of an inexact foot point
  float aa, bb;          // squared half lengths
  float inv_aa, inv_bb;  // zero for a point
};

// Consecutive pairs of a capsule, which is first compared with the other side's ball.
struct Group {
  int capsule;
  int row;
  int begin;  // pairs
  int end;
  float limit_up;  // the largest of its pairs
  float size_up;   // radius, half length and margin
};
struct Groups {
  const Group* all;
  int count;  // 0: every pair is compared
  bool of_b;  // capsules of the second side, ball of the first
  // The second side's capsules, compared with the first side's ball (begin, end are unused); at
  // most 64. Empty: none is skipped.
  const Group* others;
  int other_count;
  float limit_up;  // the largest of all pairs
};

struct Pairs {
  const Pair* all;
  int count;
  Groups groups;
};

// A capsule against a static box.
struct BoxPair {
  int a;
  int row_a;
  float R[9];  // rows: the box's axes in the world
  float center[3];
  float half_up[3];
  float limit_up;
  float radius_up;  // of the capsule, with the rounding margin
};

// A pair that is undecided in some lanes. distance: lower bound at the configuration; motion_bound:
// how much motion may reduce it.
struct Hit {
  int pair;
  unsigned lanes;  // bit by lane
  float distance[kLanes];
  float motion_bound[kLanes];
};

struct Kernel {
  const char* name;
  void (*place)(const ArmKinematics& kinematics, const double* q, const Placed& out);
  // `at`: output of place(). Row m bounds how far any point of a capsule moves relative to anything
  // that shares its first m ancestors: the sum over the other ancestors of span times the lever
  // about that joint here. (If joints change one by one from base to tip, each turns the rest in
  // its present shape: so the levers here bound motions of any size.) Sweeps hold the first-order
  // motion of the drifts, and a bound of all other motion along any direction (sweep.h: loose parts
  // and the second sum).
  void (*inflate)(const ArmKinematics& kinematics, const Placed& at, const JointMotions& motions,
                  const MotionBounds& out);
  // Writes the ball of a side. rows[c] is the row of capsule c in `motion_bound`, which is null
  // without motion.
  void (*enclose)(const ArmKinematics& kinematics, const float* capsules, const float* motion_bound,
                  const int* rows, float* ball);
  // Writes the pairs that are undecided in `lanes`; returns their number. `hits` has room for all
  // pairs.
  int (*near_pairs)(const Side& a, const Side& b, const Pairs& pairs, unsigned lanes, Hit* hits);
  // The result holds for all combinations of stretches.
  Parted (*parted)(const SweptCapsule& a, const SweptCapsule& b, const Pair& pair);
  int (*near_boxes)(const Side& a, const BoxPair* pairs, int count, unsigned lanes, Hit* hits);
};

extern const Kernel kScalarKernel;    // one lane after the other: the reference
extern const Kernel kBaselineKernel;  // SSE2: every x86-64
extern const Kernel kAvx2Kernel;

// Rounding margin of near_pairs and near_boxes (m) if no coordinate exceeds `extent_m`; part of
// radii_up and radius_up. With u = 2^-24, a center or end of an axis is rounded once, to within
// sqrt(3) u extent. With differences, products with a unit vector (off by 4 u) and sums of at most
// 2 sqrt(3) extent, 16 roundings in all.
constexpr float rounding_margin(double extent_m) {
  return static_cast<float>(16.0 * 5.97e-8 * 1.7321 * extent_m);
}

}  // namespace armloom::filter
