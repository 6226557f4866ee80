// Kernel that processes one lane at a time: the reference for the vector kernels.
#include <cmath>

#include "core/collision/filter/kernel_boxes.h"

namespace armloom::filter {
namespace {

struct D {
  static constexpr int kLanes = 1;
  double v;
  static D load(const double* p) { return {*p}; }
  static D all(double x) { return {x}; }
  // Rounds to the nearest integer, ties to even, like the vector kernels.
  static D round(D a) { return {(a.v + 6755399441055744.0) - 6755399441055744.0}; }
  static D select(D odd, D a, D b) { return odd.v == 1.0 ? a : b; }
  void store(double* p) const { *p = v; }
  void store_float(float* p) const { *p = static_cast<float>(v); }
};
inline D operator+(D a, D b) { return {a.v + b.v}; }
inline D operator-(D a, D b) { return {a.v - b.v}; }
inline D operator*(D a, D b) { return {a.v * b.v}; }

struct F {
  static constexpr int kLanes = 1;
  float v;
  static F load(const float* p) { return {*p}; }
  static F all(float x) { return {x}; }
  static F max(F a, F b) { return a.v > b.v ? a : b; }
  static F min(F a, F b) { return a.v < b.v ? a : b; }
  static F abs(F a) { return {std::fabs(a.v)}; }
  static F sqrt(F a) { return {std::sqrt(a.v)}; }
  static unsigned not_at_least(F a, F b) { return a.v >= b.v ? 0U : 1U; }
  void store(float* p) const { *p = v; }
};
inline F operator+(F a, F b) { return {a.v + b.v}; }
inline F operator-(F a, F b) { return {a.v - b.v}; }
inline F operator*(F a, F b) { return {a.v * b.v}; }
inline F operator/(F a, F b) { return {a.v / b.v}; }

}  // namespace

const Kernel kScalarKernel = {"scalar",      place<D>,  inflate<F>,   enclose<F>,
                              near_pairs<F>, parted<F>, near_boxes<F>};

}  // namespace armloom::filter
