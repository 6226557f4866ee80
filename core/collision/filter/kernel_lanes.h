#pragma once

// Source that all kernels share, part 1: places capsules and bounds their motion. Parts 2
// and 3 are kernel_pairs.h and kernel_boxes.h. Each instruction set's file includes this header
// once and passes its vector types D (doubles) and F (floats). The unnamed namespace prevents the
// linker from using code of one instruction set in another. Operations of the vector types:
// - D, F: kLanes, load(p), store(p), all(x), +, -, *
// - F also: max(a, b), min(a, b), sqrt, abs, /, not_at_least(a, b) (bits by lane of !(a >= b))
// - D also: round, select(odd, a, b), store_float(p)

#include "core/collision/filter/kernel.h"

namespace armloom::filter {
namespace {

// Computes sine and cosine with fdlibm's polynomials on [-pi/4, pi/4], after subtracting k * pi/2
// from x. Error 1e-16 for |x| < 1e6.
template <class D>
inline void sin_cos(D x, D& sin_x, D& cos_x) {
  const D k = D::round(x * D::all(6.36619772367581382433e-01));
  const D r = (x - k * D::all(1.57079632673412561417e+00)) - k * D::all(6.07710050650619224932e-11);
  const D z = r * r;
  D s = D::all(1.58969099521155010221e-10);
  s = s * z + D::all(-2.50507602534068634195e-08);
  s = s * z + D::all(2.75573137070700676789e-06);
  s = s * z + D::all(-1.98412698298579493134e-04);
  s = s * z + D::all(8.33333333332248946124e-03);
  s = s * z + D::all(-1.66666666666666324348e-01);
  s = r + r * z * s;
  D c = D::all(-1.13596475577881948265e-11);
  c = c * z + D::all(2.08757232129817482790e-09);
  c = c * z + D::all(-2.75573143513906633035e-07);
  c = c * z + D::all(2.48015872894767294178e-05);
  c = c * z + D::all(-1.38888888888741095749e-03);
  c = c * z + D::all(4.16666666666666019037e-02);
  c = D::all(1.0) - (D::all(0.5) * z - z * z * c);
  // Let m = k mod 4 quarter turns have been subtracted. An odd m swaps sine and cosine. The sine
  // changes sign if m is 2 or 3, the cosine if m is 1 or 2.
  const D half = D::round(k * D::all(0.5) - D::all(0.25));      // floor(k / 2)
  const D turns = D::round(half * D::all(0.5) - D::all(0.25));  // floor(k / 4)
  const D odd = k - D::all(2.0) * half;                         // 0 or 1
  const D back = half - D::all(2.0) * turns;                    // 1 for m = 2, 3
  const D sign_s = D::all(1.0) - D::all(2.0) * back;
  const D sign_c = sign_s * (D::all(1.0) - D::all(2.0) * odd);
  sin_x = D::select(odd, c, s) * sign_s;
  cos_x = D::select(odd, s, c) * sign_c;
}

// Writes R v for a constant vector v.
template <class D>
inline void turn(const D* R, const double* v, D* out) {
  const D x = D::all(v[0]);
  const D y = D::all(v[1]);
  const D z = D::all(v[2]);
  for (int i = 0; i < 3; ++i) out[i] = R[i] * x + R[3 + i] * y + R[6 + i] * z;
}

template <class D>
inline void place_frame(const Frame& frame, const double* parent, const double* q, int l,
                        double* out) {
  D c[12];
  if (parent == nullptr) {
    for (int i = 0; i < 12; ++i) c[i] = D::all(frame.C[i]);
  } else {
    D p[12];
    for (int i = 0; i < 12; ++i) p[i] = D::load(parent + i * kLanes + l);
    if (frame.about_x) {
      const D cosine = D::all(frame.C[4]);
      const D sine = D::all(frame.C[5]);
      for (int i = 0; i < 3; ++i) {
        c[i] = p[i];
        c[3 + i] = p[3 + i] * cosine + p[6 + i] * sine;
        c[6 + i] = p[6 + i] * cosine - p[3 + i] * sine;
      }
    } else {
      for (long column = 0; column < 3; ++column) turn(p, frame.C + 3 * column, c + 3 * column);
    }
    turn(p, frame.C + 9, c + 9);
    for (int i = 0; i < 3; ++i) c[9 + i] = c[9 + i] + p[9 + i];
  }
  const D value =
      D::load(q + frame.joint * kLanes + l) * D::all(frame.multiplier) + D::all(frame.offset);
  if (frame.prismatic) {
    for (int i = 0; i < 3; ++i) c[9 + i] = c[9 + i] + c[6 + i] * value;
  } else {
    D s, k;
    sin_cos(value, s, k);
    for (int i = 0; i < 3; ++i) {
      const D x = c[i];
      c[i] = x * k + c[3 + i] * s;
      c[3 + i] = c[3 + i] * k - x * s;
    }
  }
  for (int i = 0; i < 12; ++i) c[i].store(out + i * kLanes + l);
}

template <class D>
void place(const ArmKinematics& kinematics, const double* q, const Placed& out) {
  for (int f = 0; f < kinematics.frame_count; ++f) {
    const Frame& frame = kinematics.frames[f];
    double* X = out.frames + f * (12 * kLanes);
    const double* parent = frame.parent < 0 ? nullptr : out.frames + frame.parent * (12 * kLanes);
    float* axis = out.axes + f * (6 * kLanes);
    for (int l = 0; l < kLanes; l += D::kLanes) {
      place_frame<D>(frame, parent, q, l, X);
      for (int i = 0; i < 3; ++i) {
        D::load(X + (9 + i) * kLanes + l).store_float(axis + i * kLanes + l);
        D::load(X + (6 + i) * kLanes + l).store_float(axis + (3 + i) * kLanes + l);
      }
    }
  }
  for (int c = 0; c < kinematics.capsule_count; ++c) {
    const Capsule& capsule = kinematics.capsules[c];
    float* to = out.capsules + c * (6 * kLanes);
    for (int l = 0; l < kLanes; l += D::kLanes) {
      D center[3] = {D::all(capsule.center[0]), D::all(capsule.center[1]),
                     D::all(capsule.center[2])};
      D half[3] = {D::all(capsule.half[0]), D::all(capsule.half[1]), D::all(capsule.half[2])};
      if (capsule.frame >= 0) {
        const double* X = out.frames + capsule.frame * (12 * kLanes) + l;
        D R[9];
        for (int i = 0; i < 9; ++i) R[i] = D::load(X + i * kLanes);
        turn(R, capsule.center, center);
        turn(R, capsule.half, half);
        for (int i = 0; i < 3; ++i) center[i] = center[i] + D::load(X + (9 + i) * kLanes);
      }
      for (int i = 0; i < 3; ++i) {
        center[i].store_float(to + i * kLanes + l);
        half[i].store_float(to + (3 + i) * kLanes + l);
      }
    }
  }
}

template <class F>
struct Vec {
  F x, y, z;
  static Vec load(const float* p) {
    return {F::load(p), F::load(p + kLanes), F::load(p + 2 * kLanes)};
  }
  void store(float* p) const {
    x.store(p);
    y.store(p + kLanes);
    z.store(p + 2 * kLanes);
  }
};
template <class F>
inline F dot(const Vec<F>& a, const Vec<F>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class F>
inline Vec<F> cross(const Vec<F>& a, const Vec<F>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class F>
inline Vec<F> minus(const Vec<F>& a, const Vec<F>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

// The terms of a capsule's sweep (kSweep), summed over its ancestors.
template <class F>
struct SweepSums {
  F zero = F::all(0.0F);
  Vec<F> ahead{zero, zero, zero};   // V of the end at center + half
  Vec<F> behind{zero, zero, zero};  // V of the other end
  F off = zero;                     // bound of all other motion: loose parts, second-order terms
  F turned = zero;                  // sum of the spans of all joints that turn

  void add(const Vec<F>& v, F by) {
    ahead = {ahead.x + v.x * by, ahead.y + v.y * by, ahead.z + v.z * by};
    behind = {behind.x + v.x * by, behind.y + v.y * by, behind.z + v.z * by};
  }
  void turn_ends(const Vec<F>& v, F by) {
    ahead = {ahead.x + v.x * by, ahead.y + v.y * by, ahead.z + v.z * by};
    behind = {behind.x - v.x * by, behind.y - v.y * by, behind.z - v.z * by};
  }
  void store(float* to) const {
    const F drifts = F::abs(ahead.x) + F::abs(ahead.y) + F::abs(ahead.z) + F::abs(behind.x) +
                     F::abs(behind.y) + F::abs(behind.z);
    ahead.store(to);
    behind.store(to + 3 * kLanes);
    (off * F::all(1.0001F) + drifts * F::all(1e-5F)).store(to + 6 * kLanes);
  }
};

// Adds margins for the float rounding of each lever, which is below one part in 1e5 plus a
// micrometer.
template <class F>
void inflate(const ArmKinematics& kinematics, const Placed& at, const JointMotions& motions,
             const MotionBounds& out) {
  for (int c = 0; c < kinematics.capsule_count; ++c) {
    const Capsule& capsule = kinematics.capsules[c];
    const int* ancestors = kinematics.ancestors + capsule.ancestors_begin;
    float* rows = out.rows + capsule.motion_bounds_begin * kLanes;
    const F extra = F::all(capsule.radius_up + 2e-6F);
    const F half_one = F::all(0.5F);
    for (int l = 0; l < kLanes; l += F::kLanes) {
      const Vec<F> center = Vec<F>::load(at.capsules + c * (6 * kLanes) + l);
      const Vec<F> half = Vec<F>::load(at.capsules + (c * 6 + 3) * kLanes + l);
      F sum = F::all(0.0F);
      SweepSums<F> sweep;
      sum.store(rows + capsule.depth * kLanes + l);
      for (int k = capsule.depth - 1; k >= 0; --k) {
        const int f = ancestors[k];
        const F by = F::load(motions.span + f * kLanes + l);
        const F drift = F::load(motions.drift + f * kLanes + l);
        const F loose = F::load(motions.loose + f * kLanes + l);
        const Vec<F> axis = Vec<F>::load(at.axes + (f * 6 + 3) * kLanes + l);
        F lever = F::all(1.0F);
        if (kinematics.frames[f].prismatic) {
          sweep.add(axis, F::all(0.0F) - drift);
          sweep.off = sweep.off + loose * F::all(1.0001F);
        } else {
          const Vec<F> origin = Vec<F>::load(at.axes + f * (6 * kLanes) + l);
          const Vec<F> u = cross(minus(center, origin), axis);
          const Vec<F> v = cross(half, axis);
          const F uv = F::abs(dot(u, v));
          lever = F::sqrt(dot(u, u) + dot(v, v) + uv + uv) + extra;
          sweep.add(u, drift);
          sweep.turn_ends(v, drift);
          sweep.off = sweep.off + loose * (lever - F::all(capsule.radius_up)) +
                      by * (sum + half_one * by * lever);
          sweep.turned = sweep.turned + by;
        }
        sum = sum + lever * by * F::all(1.00001F);
        sum.store(rows + k * kLanes + l);
      }
      // The first addition uses sqrt(1 + t^2) - 1 <= t^2 / 2 (Sweep::round in sweep.cc). The second
      // covers the rounding of the moments about each axis.
      const F turned = sweep.turned;
      const F size = F::abs(center.x) + F::abs(center.y) + F::abs(center.z);
      sweep.off = sweep.off + half_one * F::all(capsule.radius_up) * turned * turned +
                  turned * (F::all(4e-6F) + F::all(1e-6F) * size);
      sweep.store(out.sweeps + c * (kSweep * kLanes) + l);
    }
  }
}

}  // namespace
}  // namespace armloom::filter
