#pragma once

// The conservative filter: capsules of eight configurations at once. Plain data and function
// pointers only, because this header is included by files that are compiled for other instruction
// sets: nothing here may be emitted twice (no standard library, no Eigen).
//
// Every array is "structure of arrays": the last index is the lane, one configuration each. Poses
// are computed in double and rounded once to float, so that the rounding margin is a few float
// roundings of a coordinate, whatever the length of the chain. The same operations in the same
// order run on every instruction set: results are equal bit for bit.

namespace armloom::filter {

inline constexpr int kLanes = 8;

// A movable joint and the frame that it moves, turned so that its axis is the frame's z:
// X_parent * C * motion(multiplier * q[joint] + offset).
struct Frame {
  int parent;  // smaller than the own index; -1: the world
  int joint;   // row of q
  bool prismatic;
  bool about_x;  // C turns about x only, as right-angled joints do
  double multiplier;
  double offset;
  double C[12];  // columns x, y, z, then the origin; m
};

// A capsule fixed in a frame (-1: in the world). Its ancestors are the frames from the root to its
// own, as indices in ArmKinematics::ancestors.
struct Capsule {
  int frame;
  double center[3];  // in the frame, m
  double half[3];    // from the centre to one end of the axis
  float radius_up;   // rounded up
  float ball_up;     // radius and half length, rounded up
  int ancestors_begin;
  int depth;                // number of ancestors
  int motion_bounds_begin;  // first of its depth + 1 rows in the array of motion bounds
};

struct ArmKinematics {
  const Frame* frames;
  int frame_count;
  const Capsule* capsules;
  int capsule_count;
  const int* ancestors;
};

// q: [joint][kLanes], rad or m. Outputs: frames [frame][12][kLanes] as Frame::C; axes
// [frame][6][kLanes]: origin and z axis; capsules [capsule][6][kLanes]: centre and half axis.
struct Placed {
  double* frames;
  float* axes;
  float* capsules;
};

// How far the joint of each frame may be from the configuration, [frame][kLanes] (rad, m), rounded
// up: by no more than span, and by s * drift + e, the same s for all of them from -1 to 1, |e| <=
// loose; |drift| + loose is no more than the span by much.
struct JointMotions {
  const float* span;
  const float* drift;
  const float* loose;
};

// How far each capsule may move.
struct MotionBounds {
  float* rows;    // [row][kLanes], see Capsule::motion_bounds_begin
  float* sweeps;  // [capsule][kSweep][kLanes]
};
// What a capsule passes: both ends of its axis move by s V and something of at most this length
// more, -1 <= s <= 1. V of the end at center + half, V of the other one, the length.
inline constexpr int kSweep = 7;

// Capsules whose motion bounds are known, as one side of a comparison.
struct Side {
  const float* capsules;      // as Placed::capsules
  const float* motion_bound;  // [row][kLanes], m; null on both sides: nothing moves
  const float* ball;  // [4][kLanes]: centre and radius of a ball around all of them as far as
                      // they may move (Kernel::enclose); not read where pairs have no groups
};

// A capsule in one configuration, and what it passes from there in up to kLanes stretches of a
// motion, side by side: those of [first, end).
struct SweptCapsule {
  const float* at;        // of Placed::capsules, at its lane
  const float* capsules;  // of Placed::capsules, in the middle of each stretch
  const float* sweeps;    // of MotionBounds::sweeps, from there
  int first, end;
};

// Two of them along the direction that parts their axes.
struct Parted {
  float distance;    // what they keep at least (m), with their radii and margins
  float towards[2];  // how much closer each comes along it than where it is at
};

// Two capsules to compare, with what does not change. Rows of the sides' motion_bound arrays say
// how far each may move.
struct Pair {
  int a, b;
  int row_a, row_b;
  float limit_up;        // distance to be kept
  float radii_up;        // both radii and the rounding margin
  float ends_up;         // both half lengths
  float end_b_up;        // b's half length, and what an inexact foot point may add
  float aa, bb;          // squared half lengths
  float inv_aa, inv_bb;  // zero for a point
};

// Consecutive pairs of one capsule of one side, held against the other side's ball first.
struct Group {
  int capsule;
  int row;
  int begin;  // pairs
  int end;
  float limit_up;  // the largest of its pairs
  float size_up;   // the capsule's radius and half length, and the margin
};
struct Groups {
  const Group* all;
  int count;  // none: every pair is looked at
  bool of_b;  // the capsules are the second side's, the ball the first one's
  // The second side's capsules, held against the first side's ball; begin, end are not read. None:
  // all of them are looked at. At most 64.
  const Group* others;
  int other_count;
  float limit_up;  // the largest of all pairs
};

// What two sides are compared by.
struct Pairs {
  const Pair* all;
  int count;
  Groups groups;
};

// A capsule against a solid box that stands still.
struct BoxPair {
  int a;
  int row_a;
  float R[9];  // rows: the box's axes in the world
  float center[3];
  float half_up[3];
  float limit_up;
  float radius_up;  // of the capsule, with the rounding margin
};

// A pair that is not proven to keep its limit in some lanes. distance: a lower bound at the
// configuration itself; motion_bound: what motion may take from it.
struct Hit {
  int pair;
  unsigned lanes;  // bit by lane
  float distance[kLanes];
  float motion_bound[kLanes];
};

struct Kernel {
  const char* name;
  void (*place)(const ArmKinematics& kinematics, const double* q, const Placed& out);
  // `at`: as place() made it. Row m of a capsule bounds how far any point of it moves
  // against anything that shares its first m ancestors: the sum over the other ancestors of span
  // times the lever about that joint at this configuration. (Changing the joints one after another
  // from base to tip, each turns what is behind it in the shape that it has here: hence the levers
  // at hand bound motions of any size.) Sweeps are the drifts' motion to first order, and all else
  // that may be added to it along any direction (sweep.h: what is loose, and the second sum).
  void (*inflate)(const ArmKinematics& kinematics, const Placed& at, const JointMotions& motions,
                  const MotionBounds& out);
  // The ball of a side; rows[c] is the row of capsule c in `motion_bound`. Null: nothing moves.
  void (*enclose)(const ArmKinematics& kinematics, const float* capsules, const float* motion_bound,
                  const int* rows, float* ball);
  // Writes the pairs that are undecided in one of `lanes`; returns their number. `hits` has room
  // for all pairs.
  int (*near_pairs)(const Side& a, const Side& b, const Pairs& pairs, unsigned lanes, Hit* hits);
  // What the two capsules keep, whichever stretch each is in.
  Parted (*parted)(const SweptCapsule& a, const SweptCapsule& b, const Pair& pair);
  int (*near_boxes)(const Side& a, const BoxPair* pairs, int count, unsigned lanes, Hit* hits);
};

extern const Kernel kScalarKernel;    // one lane after the other: the reference
extern const Kernel kBaselineKernel;  // SSE2: every x86-64
extern const Kernel kAvx2Kernel;

// Rounding margin of near_pairs and near_boxes (m), to be added to radii_up and radius_up: where no
// coordinate is larger than `extent_m`. With u = 2^-24: a centre or an end of an axis is rounded
// once, to within sqrt(3) u extent; with differences, products with a unit vector (itself 4 u off)
// and sums of at most 2 sqrt(3) extent, 16 roundings in all.
constexpr float rounding_margin(double extent_m) {
  return static_cast<float>(16.0 * 5.97e-8 * 1.7321 * extent_m);
}

}  // namespace armloom::filter
