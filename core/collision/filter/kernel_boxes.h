#pragma once

// Source that all kernels share, part 3: finds the capsules that may be too close to static boxes.
// Part 2 is kernel_pairs.h.

#include "core/collision/filter/kernel_pairs.h"

namespace armloom::filter {
namespace {

// Returns true if the box may be too close to a ball in any lane. Adds `more` to the ball's
// radius_up unless it is null.
template <class F>
inline bool near_ball(const StaticBox& box, const float* center, float radius_up,
                      const float* more) {
  unsigned near = 0;
  for (int l = 0; l < kLanes; l += F::kLanes) {
    const Vec<F> w = {F::load(center + l) - F::all(box.center[0]),
                      F::load(center + kLanes + l) - F::all(box.center[1]),
                      F::load(center + 2 * kLanes + l) - F::all(box.center[2])};
    F reach = F::all(box.ball_up + box.limit_up + radius_up);
    if (more != nullptr) reach = reach + F::load(more + l);
    reach = reach * F::all(1.00001F);
    near |= F::not_at_least(dot(w, w), reach * reach);
  }
  return near != 0;
}

// Returns a vector, in the box's frame, from about the point of the box that is nearest to a
// capsule's axis, to the axis. p, h: center and half axis in that frame.
template <class F>
inline Vec<F> from_box(const StaticBox& box, const Vec<F>& p, const Vec<F>& h) {
  const F one = F::all(1.0F);
  const F inverse = one / F::max(dot(h, h), F::all(1e-12F));
  const auto inside = [](F x, float half) {
    return F::max(F::all(-half), F::min(F::all(half), x));
  };
  Vec<F> nearest = {F::all(0.0F), F::all(0.0F), F::all(0.0F)};
  Vec<F> x = p;
  for (int round = 0; round < 3; ++round) {
    const F t = F::max(F::all(-1.0F), F::min(one, (dot(h, nearest) - dot(h, p)) * inverse));
    x = {p.x + t * h.x, p.y + t * h.y, p.z + t * h.z};
    nearest = {inside(x.x, box.half_up[0]), inside(x.y, box.half_up[1]),
               inside(x.z, box.half_up[2])};
  }
  return minus(x, nearest);
}

// Compares a capsule with a box: by the largest gap along the box's axes, then along the direction
// between their nearest points. Each gap is a lower bound of the distance. A gap along a direction
// has more roundings than one along an axis, so it has the margin twice.
template <class F>
inline unsigned near_box(const Side& a, const BoxedCapsule& capsule, const StaticBox& box,
                         Hit& hit) {
  const float* at = a.capsules + capsule.capsule * (6 * kLanes);
  const F zero = F::all(0.0F);
  unsigned near = 0;
  for (int l = 0; l < kLanes; l += F::kLanes) {
    Vec<F> w = Vec<F>::load(at + l);
    w = {w.x - F::all(box.center[0]), w.y - F::all(box.center[1]), w.z - F::all(box.center[2])};
    const F motion_bound =
        a.motion_bound == nullptr ? zero : F::load(a.motion_bound + capsule.row * kLanes + l);
    const Vec<F> half = Vec<F>::load(at + 3 * kLanes + l);
    F p[3], h[3];
    F gap = F::all(-1e9F);
    for (long i = 0; i < 3; ++i) {
      const Vec<F> axis = {F::all(box.R[3 * i]), F::all(box.R[3 * i + 1]),
                           F::all(box.R[3 * i + 2])};
      p[i] = dot(axis, w);
      h[i] = dot(axis, half);
      gap = F::max(gap, F::abs(p[i]) - F::abs(h[i]) - F::all(box.half_up[i]));
    }
    const F keep = F::all(box.limit_up) + motion_bound;
    F distance = gap - F::all(capsule.radius_up + box.margin_up);
    unsigned close = F::not_at_least(distance, keep);
    if (close != 0) {
      const Vec<F> at_p = {p[0], p[1], p[2]};
      const Vec<F> at_h = {h[0], h[1], h[2]};
      Vec<F> d = from_box(box, at_p, at_h);
      const F scale = F::all(1.0F) / F::max(F::sqrt(dot(d, d)), F::all(1e-20F));
      d = {d.x * scale, d.y * scale, d.z * scale};
      const F along = dot(d, at_h);
      const F in_front = dot(d, at_p) - F::all(box.half_up[0]) * F::abs(d.x) -
                         F::all(box.half_up[1]) * F::abs(d.y) -
                         F::all(box.half_up[2]) * F::abs(d.z) -
                         F::all(capsule.radius_up + 2.0F * box.margin_up);
      distance = F::max(distance, in_front - F::abs(along));
      close = F::not_at_least(distance, keep);
      if (close != 0 && a.sweeps != nullptr) {
        F back[3];  // towards the box, in the world
        for (int i = 0; i < 3; ++i) {
          back[i] = zero - (d.x * F::all(box.R[i]) + d.y * F::all(box.R[3 + i]) +
                            d.z * F::all(box.R[6 + i]));
        }
        const F reach =
            swept_reach(a, capsule.capsule, Vec<F>{back[0], back[1], back[2]}, zero - along, l);
        close &= F::not_at_least(in_front - reach, F::all(box.limit_up + kSweptMargin_m));
      }
    }
    near |= close << l;
    distance.store(hit.distance + l);
    motion_bound.store(hit.motion_bound + l);
  }
  return near;
}

template <class F>
int near_boxes(const Side& side, const Boxes& boxes, unsigned lanes, Hit* hits) {
  const Side a = side;  // see near_pairs_of()
  int found = 0;
  for (int b = 0; b < boxes.count; ++b) {
    const StaticBox& box = boxes.all[b];
    if (a.ball != nullptr && !near_ball<F>(box, a.ball, 0.0F, a.ball + 3 * kLanes)) continue;
    const NearCapsules near = near_capsules<F>(a.spread, box.center, box.center + 1, box.center + 2,
                                               box.ball_up + box.limit_up);
    if (near.bits == 0) continue;
    // First lists the capsules whose balls are near, without a branch that is hard to predict.
    Hit* next = hits + found;
    for (int c = box.begin; c < box.end; ++c) {
      const BoxedCapsule& of = boxes.capsules[c];
      if (!near.has(of.capsule)) continue;
      next->capsule = c;
      const float* more = a.motion_bound == nullptr ? nullptr : a.motion_bound + of.row * kLanes;
      const float* center = a.capsules + of.capsule * (6 * kLanes);
      next = near_ball<F>(box, center, of.ball_up, more) ? next + 1 : next;
    }
    for (const Hit* listed = hits + found; listed < next; ++listed) {
      const int c = listed->capsule;
      Hit& hit = hits[found];
      hit.pair = b;
      hit.capsule = c;
      hit.lanes = near_box<F>(a, boxes.capsules[c], box, hit) & lanes;
      found += hit.lanes != 0 ? 1 : 0;
    }
  }
  return found;
}

}  // namespace
}  // namespace armloom::filter
