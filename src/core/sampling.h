#pragma once

#include "core/math.h"
#include "core/sample_sequence.h"

namespace photopic {

/// Each warp takes uniform numbers in [0, 1) and stands beside its density.

template <typename T>
struct SinCos {
  T sin, cos;
};

/// sin 2πu and cos 2πu for u in [−1/8, 1], to 4e-7: Taylor polynomials about the nearest quarter turn.
template <typename T>
PHOTOPIC_INLINE SinCos<T> sin_cos_two_pi(T u) {
  const T quarter = floor(4.0f * u + 0.5f);
  const T x = (u - 0.25f * quarter) * (2.0f * kPi);  // in [−π/4, π/4]
  const T x2 = x * x;
  const T s = x * (1.0f + x2 * (-1.0f / 6 + x2 * (1.0f / 120 + x2 * (-1.0f / 5040))));
  const T c = 1.0f + x2 * (-0.5f + x2 * (1.0f / 24 + x2 * (-1.0f / 720 + x2 * (1.0f / 40320))));
  const auto q = to_int(quarter) & 3;
  const T sin = select((q & 1) != 0, c, s), cos = select((q & 1) != 0, s, c);
  return {select((q & 2) != 0, -sin, sin), select(((q + 1) & 2) != 0, -cos, cos)};
}

/// The angle of a vector with y ≥ 0 to the x axis, 0 … π, to 3e-7 of itself; 0 of the zero vector. Abramowitz
/// & Stegun 1964, equation 4.4.49.
template <typename T>
T angle_above(T y, T x) {
  const T long_side = max(y, abs(x)), short_side = min(y, abs(x));
  const T t = select(long_side > 0.0f, short_side / long_side, T{}), t2 = t * t;
  constexpr float kTerms[] = {-0.3333314528f, 0.1999355085f, -0.1420889944f, 0.1065626393f,
                              -0.0752896400f, 0.0429096138f, -0.0161657367f, 0.0028662257f};
  T sum = T{} + kTerms[7];
  for (int i = 6; i >= 0; --i) sum = sum * t2 + kTerms[i];
  const T octant = t + t * (t2 * sum);
  const T quarter = select(y > abs(x), 0.5f * kPi - octant, octant);
  return select(x < 0.0f, kPi - quarter, quarter);
}

/// The unit disk, squares becoming wedges: Shirley & Chiu 1997, "A Low Distortion Map Between Disk and
/// Square". Density 1/π.
inline Sample2d sample_disk(Sample2d u) {
  const float a = 2.0f * u.x - 1.0f, b = 2.0f * u.y - 1.0f;
  if (a == 0.0f && b == 0.0f) return {0.0f, 0.0f};
  const bool wide = std::abs(a) > std::abs(b);
  const float radius = wide ? a : b;
  const auto phi = sin_cos_two_pi(wide ? 0.125f * (b / a) : 0.25f - 0.125f * (a / b));
  return {radius * phi.cos, radius * phi.sin};
}

/// Cosine-weighted hemisphere about +z.
template <typename T>
PHOTOPIC_INLINE Vec3<T> sample_cosine_hemisphere(BasicSample2d<T> u) {
  const T r = sqrt(u.x);
  const auto phi = sin_cos_two_pi(u.y);
  return {r * phi.cos, r * phi.sin, sqrt(1.0f - u.x)};
}
/// [1/sr]
template <typename T>
T cosine_hemisphere_pdf(T cos_theta) {
  return max(T{}, cos_theta) * kInvPi;
}

/// Barycentric coordinates (of the second and third vertex) of a uniform point of a triangle; density 1/area.
template <typename T>
BasicSample2d<T> sample_triangle(BasicSample2d<T> u) {
  const T root = sqrt(u.x);
  return {1.0f - root, u.y * root};
}

/// The power heuristic, β = 2: Veach 1997, section 9.2.3. Written so that densities up to the largest float
/// do not overflow.
template <typename T>
T power_heuristic(T pdf, T other_pdf) {
  const T ratio = other_pdf / pdf;
  return 1.0f / (1.0f + ratio * ratio);
}

}  // namespace photopic
