#pragma once

// The vector type F of the AVX kernels: eight floats. Included once by each of their files.
#include <immintrin.h>

namespace armloom::filter {
namespace {

struct F {
  static constexpr int kLanes = 8;
  __m256 v;
  static F load(const float* p) { return {_mm256_loadu_ps(p)}; }
  static F all(float x) { return {_mm256_set1_ps(x)}; }
  static F max(F a, F b) { return {_mm256_max_ps(a.v, b.v)}; }
  static F min(F a, F b) { return {_mm256_min_ps(a.v, b.v)}; }
  static F abs(F a) { return {_mm256_andnot_ps(_mm256_set1_ps(-0.0F), a.v)}; }
  static F sqrt(F a) { return {_mm256_sqrt_ps(a.v)}; }
  static unsigned not_at_least(F a, F b) {
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_NGE_UQ)));
  }
  void store(float* p) const { _mm256_storeu_ps(p, v); }
};
inline F operator+(F a, F b) { return {_mm256_add_ps(a.v, b.v)}; }
inline F operator-(F a, F b) { return {_mm256_sub_ps(a.v, b.v)}; }
inline F operator*(F a, F b) { return {_mm256_mul_ps(a.v, b.v)}; }
inline F operator/(F a, F b) { return {_mm256_div_ps(a.v, b.v)}; }

}  // namespace
}  // namespace armloom::filter
