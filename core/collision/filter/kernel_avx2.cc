// Kernel for AVX2: four doubles or eight floats at once. Runs only if the processor has AVX2.
#include <immintrin.h>

#include "core/collision/filter/avx_floats.h"
#include "core/collision/filter/kernel_boxes.h"

namespace armloom::filter {
namespace {

struct D {
  static constexpr int kLanes = 4;
  __m256d v;
  static D load(const double* p) { return {_mm256_loadu_pd(p)}; }
  static D all(double x) { return {_mm256_set1_pd(x)}; }
  // Rounds to the nearest integer, ties to even. After 1.5 * 2^52 is added, a double has no digit
  // left for a fraction.
  static D round(D a) {
    const __m256d shift = _mm256_set1_pd(6755399441055744.0);
    return {_mm256_sub_pd(_mm256_add_pd(a.v, shift), shift)};
  }
  static D select(D odd, D a, D b) {
    const __m256d one = _mm256_cmp_pd(odd.v, _mm256_set1_pd(1.0), _CMP_EQ_OQ);
    return {_mm256_or_pd(_mm256_and_pd(one, a.v), _mm256_andnot_pd(one, b.v))};
  }
  void store(double* p) const { _mm256_storeu_pd(p, v); }
  void store_float(float* p) const { _mm_storeu_ps(p, _mm256_cvtpd_ps(v)); }
};
inline D operator+(D a, D b) { return {_mm256_add_pd(a.v, b.v)}; }
inline D operator-(D a, D b) { return {_mm256_sub_pd(a.v, b.v)}; }
inline D operator*(D a, D b) { return {_mm256_mul_pd(a.v, b.v)}; }

}  // namespace

const Kernel kAvx2Kernel = {"avx2",        place<D>,  inflate<F>,   enclose<F>,
                            near_pairs<F>, parted<F>, near_boxes<F>};

}  // namespace armloom::filter
