#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/lanes.h"

namespace photopic {

inline constexpr float kPi = std::numbers::pi_v<float>;
inline constexpr float kInvPi = std::numbers::inv_pi_v<float>;

template <typename T>
struct Vec3 {
  T x{}, y{}, z{};

  friend Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator*(Vec3 a, T s) { return {a.x * s, a.y * s, a.z * s}; }
  friend Vec3 operator*(T s, Vec3 a) { return a * s; }
  friend Vec3 operator/(Vec3 a, T s) { return a * (1.0f / s); }
  Vec3 operator-() const { return {-x, -y, -z}; }
  bool operator==(const Vec3&) const = default;
};
using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;
using Vec3Lanes = Vec3<Lanes>;

struct Vec2f {
  float x = 0, y = 0;
  bool operator==(const Vec2f&) const = default;
};
struct Vec4f {
  float x = 0, y = 0, z = 0, w = 0;
  bool operator==(const Vec4f&) const = default;
};

template <typename T>
T dot(Vec3<T> a, Vec3<T> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <typename T>
Vec3<T> cross(Vec3<T> a, Vec3<T> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <typename T>
T length(Vec3<T> a) {
  return sqrt(dot(a, a));
}
template <typename T>
Vec3<T> normalize(Vec3<T> a) {
  return a / length(a);
}
template <typename T>
T max_abs(Vec3<T> a) {
  return max(max(abs(a.x), abs(a.y)), abs(a.z));
}
template <typename T>
bool is_finite(Vec3<T> a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

template <typename Mask, typename T>
Vec3<T> select(Mask condition, Vec3<T> a, Vec3<T> b) {
  return {select(condition, a.x, b.x), select(condition, a.y, b.y), select(condition, a.z, b.z)};
}
/// The same in all lanes.
template <typename T>
Vec3<T> broadcast(Vec3f v) {
  return {T{} + v.x, T{} + v.y, T{} + v.z};
}
template <typename T>
Vec3f lane(const Vec3<T>& v, int i) {
  return {lane(v.x, i), lane(v.y, i), lane(v.z, i)};
}
template <typename T>
void set_lane(Vec3<T>& v, int i, Vec3f a) {
  set_lane(v.x, i, a.x), set_lane(v.y, i, a.y), set_lane(v.z, i, a.z);
}

inline Vec3f to_float(Vec3d a) {
  return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}
inline Vec3d to_double(Vec3f a) {
  return {a.x, a.y, a.z};
}

template <typename T>
T sqr(T x) {
  return x * x;
}
template <typename T>
T safe_sqrt(T x) {
  return sqrt(max(T{}, x));
}

}  // namespace photopic
