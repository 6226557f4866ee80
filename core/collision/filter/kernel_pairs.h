#pragma once

// Source that all kernels share, part 2: finds the pairs that may be too close. Part 1 is
// kernel_lanes.h, part 3 kernel_boxes.h.

#include "core/collision/filter/kernel_lanes.h"

namespace armloom::filter {
namespace {

// Returns the vector from the point of b's axis nearest to a's axis, to the point of a's axis
// nearest to b's. The points are inexact by rounding. w: vector from b's center to a's center. ha,
// hb: half axes.
template <class F>
inline Vec<F> between_axes(const Vec<F>& w, const Vec<F>& ha, const Vec<F>& hb, const Pair& pair) {
  const F one = F::all(1.0F);
  const F ab = dot(ha, hb);
  const F aw = dot(ha, w);
  const F bw = dot(hb, w);
  const auto clamp = [&one](F x) { return F::max(F::all(-1.0F), F::min(one, x)); };
  const F aa = F::all(pair.aa);
  const F bb = F::all(pair.bb);
  const F denominator = F::max(aa * bb - ab * ab, F::all(1e-12F));
  F s = clamp((ab * bw - aw * bb) / denominator);
  const F t = clamp((ab * s + bw) * F::all(pair.inv_bb));
  s = clamp((ab * t - aw) * F::all(pair.inv_aa));
  return {w.x + s * ha.x - t * hb.x, w.y + s * ha.y - t * hb.y, w.z + s * ha.z - t * hb.z};
}

template <class F>
inline Vec<F> same(const float* at) {
  return {F::all(at[0]), F::all(at[kLanes]), F::all(at[2 * kLanes])};
}

// Returns how far the capsule's axis reaches along d beyond the center at of.at, at most, in any of
// its stretches.
template <class F>
inline float reach_along(const SweptCapsule& of, const Vec<F>& d) {
  const Vec<F> center = same<F>(of.at);
  float reach[kLanes];
  for (int l = 0; l < kLanes; l += F::kLanes) {
    const F along = dot(d, Vec<F>::load(of.capsules + 3 * kLanes + l));
    const F ahead = F::abs(dot(d, Vec<F>::load(of.sweeps + l))) + along;
    const F behind = F::abs(dot(d, Vec<F>::load(of.sweeps + 3 * kLanes + l))) - along;
    const F away = dot(d, minus(Vec<F>::load(of.capsules + l), center));
    (away + F::max(ahead, behind) + F::load(of.sweeps + 6 * kLanes + l)).store(reach + l);
  }
  float most = reach[of.first];
  for (int l = of.first + 1; l < of.end; ++l) most = reach[l] > most ? reach[l] : most;
  return most;
}

// Covers the rounding of bounds along a direction, and that of the direction and the centers.
constexpr float kSweptMargin_m = 3e-6F;

template <class F>
Parted parted(const SweptCapsule& a, const SweptCapsule& b, const Pair& pair,
              const float* direction) {
  const float x = direction[0], y = direction[kLanes], z = direction[2 * kLanes];
  const auto magnitude_along = [x, y, z](const float* v) {
    const float along = x * v[0] + y * v[kLanes] + z * v[2 * kLanes];
    return along < 0.0F ? -along : along;
  };
  const float* half_a = a.at + 3 * kLanes;
  const float* half_b = b.at + 3 * kLanes;
  const float apart = x * (a.at[0] - b.at[0]) + y * (a.at[kLanes] - b.at[kLanes]) +
                      z * (a.at[2 * kLanes] - b.at[2 * kLanes]);
  const float of_a = reach_along(a, Vec<F>{F::all(-x), F::all(-y), F::all(-z)});
  const float of_b = reach_along(b, Vec<F>{F::all(x), F::all(y), F::all(z)});
  return {apart - of_a - of_b - pair.radii_up - kSweptMargin_m,
          {of_a - magnitude_along(half_a), of_b - magnitude_along(half_b)}};
}

// Writes the capsule's ball around all lanes (Spread). The center lies between the first and the
// last lane. far: [kLanes], distance of the capsule from there in each lane.
template <class F>
inline void spread_capsule(const float* capsule, float ball_up, const float* motion_bound,
                           float* ball, long size) {
  float center[3];
  for (int i = 0; i < 3; ++i) {
    center[i] = 0.5F * (capsule[i * kLanes] + capsule[i * kLanes + kLanes - 1]);
  }
  float far[kLanes];
  for (int l = 0; l < kLanes; l += F::kLanes) {
    const Vec<F> w = minus(Vec<F>::load(capsule + l),
                           Vec<F>{F::all(center[0]), F::all(center[1]), F::all(center[2])});
    F reach = F::sqrt(dot(w, w)) * F::all(1.00001F) + F::all(ball_up);
    if (motion_bound != nullptr) reach = reach + F::load(motion_bound + l);
    reach.store(far + l);
  }
  float radius = far[0];
  for (int l = 1; l < kLanes; ++l) radius = far[l] > radius ? far[l] : radius;
  for (int i = 0; i < 3; ++i) ball[i * size] = center[i];
  ball[3 * size] = radius;
}

// The ball's center is the center of the bounding box of the capsules' centers.
template <class F>
void enclose(const ArmKinematics& kinematics, const float* capsules, const float* motion_bound,
             const int* rows, float* ball, float* spread) {
  if (kinematics.capsule_count == 0) {  // an arm without shapes is never compared
    for (int i = 0; i < 4 * kLanes; ++i) ball[i] = 0.0F;
    return;
  }
  const long size = spread_size(kinematics.capsule_count);
  for (int c = 0; c < size; ++c) {
    if (c >= kinematics.capsule_count) {  // no capsule: far away
      for (int i = 0; i < 4; ++i) spread[i * size + c] = i == 3 ? 0.0F : 1e9F;
      continue;
    }
    spread_capsule<F>(capsules + c * (6 * kLanes), kinematics.capsules[c].ball_up,
                      motion_bound == nullptr ? nullptr : motion_bound + rows[c] * kLanes,
                      spread + c, size);
  }
  for (int l = 0; l < kLanes; l += F::kLanes) {
    Vec<F> low = Vec<F>::load(capsules + l);
    Vec<F> high = low;
    for (int c = 1; c < kinematics.capsule_count; ++c) {
      const Vec<F> p = Vec<F>::load(capsules + c * (6 * kLanes) + l);
      low = {F::min(low.x, p.x), F::min(low.y, p.y), F::min(low.z, p.z)};
      high = {F::max(high.x, p.x), F::max(high.y, p.y), F::max(high.z, p.z)};
    }
    const F half = F::all(0.5F);
    const Vec<F> center = {(low.x + high.x) * half, (low.y + high.y) * half,
                           (low.z + high.z) * half};
    F radius = F::all(0.0F);
    for (int c = 0; c < kinematics.capsule_count; ++c) {
      const Vec<F> w = minus(Vec<F>::load(capsules + c * (6 * kLanes) + l), center);
      F far = F::sqrt(dot(w, w)) * F::all(1.00001F) + F::all(kinematics.capsules[c].ball_up);
      if (motion_bound != nullptr) far = far + F::load(motion_bound + rows[c] * kLanes + l);
      radius = F::max(radius, far);
    }
    center.x.store(ball + l);
    center.y.store(ball + kLanes + l);
    center.z.store(ball + 2 * kLanes + l);
    radius.store(ball + 3 * kLanes + l);
  }
}

// The capsules of a side that may be near something, as bits. Capsules from the 65th on always may.
struct NearCapsules {
  unsigned long long bits = ~0ULL;
  [[nodiscard]] bool has(int capsule) const { return capsule >= 64 || (bits >> capsule & 1U) != 0; }
};
// Returns the capsules whose balls (Spread) are within reach_up of the point, in any lane.
template <class F>
inline NearCapsules near_capsules(const Spread& spread, const float* x, const float* y,
                                  const float* z, float reach_up) {
  NearCapsules near;
  if (spread.balls == nullptr) return near;
  const long size = spread.size < 64 ? spread.size : 64;
  near.bits = 0;
  for (int c = 0; c < size; c += F::kLanes) {
    const float* ball = spread.balls + c;
    const Vec<F> w = {F::load(ball) - F::all(*x), F::load(ball + spread.size) - F::all(*y),
                      F::load(ball + 2 * spread.size) - F::all(*z)};
    const F reach = (F::load(ball + 3 * spread.size) + F::all(reach_up)) * F::all(1.00001F);
    near.bits |= static_cast<unsigned long long>(F::not_at_least(dot(w, w), reach * reach)) << c;
  }
  if (spread.size > 64) near.bits |= 1ULL << 63;  // so that the bits are not zero
  return near;
}

// Returns how far the capsule of each lane reaches along d beyond its center, at most, as its axis
// moves. `along`: d . half axis.
template <class F>
inline F swept_reach(const Side& side, int capsule, const Vec<F>& d, F along, int l) {
  const float* sweep = side.sweeps + capsule * (kSweep * kLanes) + l;
  const F ahead = F::abs(dot(d, Vec<F>::load(sweep))) + along;
  const F behind = F::abs(dot(d, Vec<F>::load(sweep + 3 * kLanes))) - along;
  return F::max(ahead, behind) + F::load(sweep + 6 * kLanes);
}

// Returns the lanes in which the pair is undecided. Fills `hit` for these lanes.
template <class F, bool kMoving>
inline unsigned near_pair(const Side& a, const Side& b, const Pair& pair, Hit& hit) {
  const float* at_a = a.capsules + pair.a * (6 * kLanes);
  const float* at_b = b.capsules + pair.b * (6 * kLanes);
  unsigned near = 0;
  for (int l = 0; l < kLanes; l += F::kLanes) {
    const Vec<F> w = minus(Vec<F>::load(at_a + l), Vec<F>::load(at_b + l));
    F motion_bound = F::all(0.0F);
    F keep = F::all(pair.limit_up + pair.radii_up);
    if constexpr (kMoving) {
      motion_bound = F::load(a.motion_bound + pair.row_a * kLanes + l) +
                     F::load(b.motion_bound + pair.row_b * kLanes + l);
      keep = keep + motion_bound;
    }
    const F reach = keep + F::all(pair.ends_up);
    if (F::not_at_least(dot(w, w), reach * reach) == 0) continue;
    const Vec<F> ha = Vec<F>::load(at_a + 3 * kLanes + l);
    // Compare a ball around b with the axis of a.
    const F one = F::all(1.0F);
    const F t = F::max(F::all(-1.0F), F::min(one, dot(ha, w) * F::all(-pair.inv_aa)));
    const Vec<F> v = {w.x + t * ha.x, w.y + t * ha.y, w.z + t * ha.z};
    const F ball = keep + F::all(pair.end_b_up);
    if (F::not_at_least(dot(v, v), ball * ball) == 0) continue;
    const Vec<F> hb = Vec<F>::load(at_b + 3 * kLanes + l);
    // A lower bound of the distance of the axes: the gap between two planes, normal to the
    // direction between their nearest points. If these points are inexact, the bound is only lower.
    const Vec<F> between = between_axes(w, ha, hb, pair);
    const F length = F::max(F::sqrt(dot(between, between)), F::all(1e-20F));
    const F along_a = dot(between, ha);
    const F along_b = dot(between, hb);
    const F gap = (dot(between, w) - F::abs(along_a) - F::abs(along_b)) / length;
    unsigned close = F::not_at_least(gap, keep);
    if constexpr (kMoving) {
      const Vec<F> d = {between.x / length, between.y / length, between.z / length};
      if (close != 0 && a.sweeps != nullptr && b.sweeps != nullptr) {
        const Vec<F> back = {F::all(0.0F) - d.x, F::all(0.0F) - d.y, F::all(0.0F) - d.z};
        const F apart = dot(d, w) - swept_reach(a, pair.a, back, dot(back, ha), l) -
                        swept_reach(b, pair.b, d, dot(d, hb), l);
        close &= F::not_at_least(apart, F::all(pair.limit_up + pair.radii_up + kSweptMargin_m));
      }
      d.x.store(hit.direction + l);
      d.y.store(hit.direction + kLanes + l);
      d.z.store(hit.direction + 2 * kLanes + l);
    }
    near |= close << l;
    (gap - F::all(pair.radii_up)).store(hit.distance + l);
    motion_bound.store(hit.motion_bound + l);
  }
  return near;
}

// Returns true if the group's capsule, which belongs to side `own`, may be too close to the other
// side's ball.
template <class F, bool kMoving>
inline bool near_ball(const Side& own, const Side& other, const Group& group) {
  const float* at = own.capsules + group.capsule * (6 * kLanes);
  unsigned near = 0;
  for (int l = 0; l < kLanes; l += F::kLanes) {
    const Vec<F> w = minus(Vec<F>::load(at + l), Vec<F>::load(other.ball + l));
    F reach = F::load(other.ball + 3 * kLanes + l) + F::all(group.limit_up + group.size_up);
    if constexpr (kMoving) reach = reach + F::load(own.motion_bound + group.row * kLanes + l);
    near |= F::not_at_least(dot(w, w), reach * reach);
  }
  return near != 0;
}

// Returns true if the balls of both sides may be too close to each other.
template <class F>
inline bool near_balls(const Side& a, const Side& b, float limit_up) {
  unsigned near = 0;
  for (int l = 0; l < kLanes; l += F::kLanes) {
    const Vec<F> w = minus(Vec<F>::load(a.ball + l), Vec<F>::load(b.ball + l));
    const F reach =
        (F::load(a.ball + 3 * kLanes + l) + F::load(b.ball + 3 * kLanes + l) + F::all(limit_up)) *
        F::all(1.00001F);
    near |= F::not_at_least(dot(w, w), reach * reach);
  }
  return near != 0;
}

// Copies both sides, so that their pointers stay in registers: `hits` cannot alias them.
template <class F, bool kMoving>
int near_pairs_of(const Side a, const Side b, const Pairs& of, unsigned lanes, Hit* hits) {
  const Pair* pairs = of.all;
  const Groups& groups = of.groups;
  int found = 0;
  unsigned long long of_b = ~0ULL;  // capsules of b to compare
  const auto look = [&](int begin, int end, NearCapsules of_a = {}) {
    for (int p = begin; p < end; ++p) {
      if (!of_a.has(pairs[p].a)) continue;
      if (groups.other_count > 0 && (of_b >> pairs[p].b & 1U) == 0) continue;
      Hit& hit = hits[found];
      hit.pair = p;
      hit.lanes = near_pair<F, kMoving>(a, b, pairs[p], hit) & lanes;
      found += hit.lanes != 0 ? 1 : 0;
    }
  };
  if (groups.count == 0) look(0, of.count);
  if (groups.other_count > 0) {
    if (!near_balls<F>(a, b, groups.limit_up)) return 0;
    of_b = 0;
    for (int o = 0; o < groups.other_count; ++o) {
      const Group& other = groups.others[o];
      if (near_ball<F, kMoving>(b, a, other)) of_b |= 1ULL << other.capsule;
    }
    if (of_b == 0) return 0;
  }
  for (int g = 0; g < groups.count; ++g) {
    const Group& group = groups.all[g];
    const bool near =
        groups.of_b ? near_ball<F, kMoving>(b, a, group) : near_ball<F, kMoving>(a, b, group);
    if (!near) continue;
    NearCapsules of_a;
    if (groups.of_b) {
      const float* at = b.capsules + group.capsule * (6 * kLanes);
      of_a = near_capsules<F>(a.spread, at, at + kLanes, at + 2 * kLanes,
                              group.limit_up + group.size_up);
    }
    look(group.begin, group.end, of_a);
  }
  return found;
}

template <class F>
int near_pairs(const Side& a, const Side& b, const Pairs& pairs, unsigned lanes, Hit* hits) {
  if (a.motion_bound == nullptr && b.motion_bound == nullptr) {
    return near_pairs_of<F, false>(a, b, pairs, lanes, hits);
  }
  return near_pairs_of<F, true>(a, b, pairs, lanes, hits);
}

}  // namespace
}  // namespace armloom::filter
