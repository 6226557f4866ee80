// Kernel for SSE2, which every x86-64 has: two doubles or four floats at once.
#include <immintrin.h>

#include "core/collision/filter/kernel_boxes.h"

namespace armloom::filter {
namespace {

struct D {
  static constexpr int kLanes = 2;
  __m128d v;
  static D load(const double* p) { return {_mm_loadu_pd(p)}; }
  static D all(double x) { return {_mm_set1_pd(x)}; }
  // Rounds to the nearest integer, ties to even. After 1.5 * 2^52 is added, a double has no digit
  // left for a fraction.
  static D round(D a) {
    const __m128d shift = _mm_set1_pd(6755399441055744.0);
    return {_mm_sub_pd(_mm_add_pd(a.v, shift), shift)};
  }
  static D select(D odd, D a, D b) {
    const __m128d one = _mm_cmpeq_pd(odd.v, _mm_set1_pd(1.0));
    return {_mm_or_pd(_mm_and_pd(one, a.v), _mm_andnot_pd(one, b.v))};
  }
  void store(double* p) const { _mm_storeu_pd(p, v); }
  void store_float(float* p) const { _mm_storel_pi(reinterpret_cast<__m64*>(p), _mm_cvtpd_ps(v)); }
};
inline D operator+(D a, D b) { return {_mm_add_pd(a.v, b.v)}; }
inline D operator-(D a, D b) { return {_mm_sub_pd(a.v, b.v)}; }
inline D operator*(D a, D b) { return {_mm_mul_pd(a.v, b.v)}; }

struct F {
  static constexpr int kLanes = 4;
  __m128 v;
  static F load(const float* p) { return {_mm_loadu_ps(p)}; }
  static F all(float x) { return {_mm_set1_ps(x)}; }
  static F max(F a, F b) { return {_mm_max_ps(a.v, b.v)}; }
  static F min(F a, F b) { return {_mm_min_ps(a.v, b.v)}; }
  static F abs(F a) { return {_mm_andnot_ps(_mm_set1_ps(-0.0F), a.v)}; }
  static F sqrt(F a) { return {_mm_sqrt_ps(a.v)}; }
  static unsigned not_at_least(F a, F b) {
    return static_cast<unsigned>(_mm_movemask_ps(_mm_cmpnge_ps(a.v, b.v)));
  }
  void store(float* p) const { _mm_storeu_ps(p, v); }
};
inline F operator+(F a, F b) { return {_mm_add_ps(a.v, b.v)}; }
inline F operator-(F a, F b) { return {_mm_sub_ps(a.v, b.v)}; }
inline F operator*(F a, F b) { return {_mm_mul_ps(a.v, b.v)}; }
inline F operator/(F a, F b) { return {_mm_div_ps(a.v, b.v)}; }

}  // namespace

const Kernel kBaselineKernel = {"baseline",    place<D>,  inflate<F>,   enclose<F>,
                                near_pairs<F>, parted<F>, near_boxes<F>};

}  // namespace armloom::filter
