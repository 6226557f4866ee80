// Kernel for AVX-512: eight doubles or eight floats at once. Runs only if the processor has AVX-512
// (F, DQ and VL). Eight floats fill half a register: there are no more lanes.
#include <immintrin.h>

#include "core/collision/filter/avx_floats.h"
#include "core/collision/filter/kernel_boxes.h"

namespace armloom::filter {
namespace {

struct D {
  static constexpr int kLanes = 8;
  __m512d v;
  static D load(const double* p) { return {_mm512_loadu_pd(p)}; }
  static D all(double x) { return {_mm512_set1_pd(x)}; }
  // Rounds to the nearest integer, ties to even, like the other kernels.
  static D round(D a) {
    const __m512d shift = _mm512_set1_pd(6755399441055744.0);
    return {_mm512_sub_pd(_mm512_add_pd(a.v, shift), shift)};
  }
  static D select(D odd, D a, D b) {
    const __mmask8 one = _mm512_cmp_pd_mask(odd.v, _mm512_set1_pd(1.0), _CMP_EQ_OQ);
    return {_mm512_mask_blend_pd(one, b.v, a.v)};
  }
  void store(double* p) const { _mm512_storeu_pd(p, v); }
  // g++ 12 warns wrongly about the form without a mask.
  void store_float(float* p) const { _mm256_storeu_ps(p, _mm512_maskz_cvtpd_ps(0xFF, v)); }
};
inline D operator+(D a, D b) { return {_mm512_add_pd(a.v, b.v)}; }
inline D operator-(D a, D b) { return {_mm512_sub_pd(a.v, b.v)}; }
inline D operator*(D a, D b) { return {_mm512_mul_pd(a.v, b.v)}; }

}  // namespace

const Kernel kAvx512Kernel = {"avx512",      place<D>,  inflate<F>,   enclose<F>,
                              near_pairs<F>, parted<F>, near_boxes<F>};

}  // namespace armloom::filter
