#pragma once

#include <cmath>
#include <cstring>

namespace photopic {

/// The processor's vectors.
using Float1 [[gnu::vector_size(4)]] = float;
using Float4 [[gnu::vector_size(16)]] = float;
using Float8 [[gnu::vector_size(32)]] = float;
using Float16 [[gnu::vector_size(64)]] = float;
using Double8 [[gnu::vector_size(64)]] = double;

/// Numbers that stand in a row in memory, aligned or not.
template <typename Vector>
Vector load(const void* numbers) {
  Vector vector;
  std::memcpy(&vector, numbers, sizeof vector);
  return vector;
}

/// The square root of each.
template <typename Vector>
inline Vector sqrt_of(Vector square) {
  constexpr int kSize = sizeof(square) / sizeof(square[0]);
  for (int j = 0; j < kSize; ++j) square[j] = std::sqrt(square[j]);
  return square;
}

/// The two halves of a vector.
inline Float4 low(Float8 v) {
  return __builtin_shufflevector(v, v, 0, 1, 2, 3);
}
inline Float4 high(Float8 v) {
  return __builtin_shufflevector(v, v, 4, 5, 6, 7);
}
inline Float8 low(Float16 v) {
  return __builtin_shufflevector(v, v, 0, 1, 2, 3, 4, 5, 6, 7);
}
inline Float8 high(Float16 v) {
  return __builtin_shufflevector(v, v, 8, 9, 10, 11, 12, 13, 14, 15);
}

/// All lanes in one, by halves.
inline float sum_of(Float1 v) {
  return v[0];
}
inline float sum_of(Float4 v) {
  const Float4 pairs = v + __builtin_shufflevector(v, v, 2, 3, 0, 1);
  return pairs[0] + pairs[1];
}
inline float sum_of(Float8 v) {
  return sum_of(low(v) + high(v));
}
inline float sum_of(Float16 v) {
  return sum_of(low(v) + high(v));
}

/// Vectors side by side.
inline Float8 join(Float4 a, Float4 b) {
  return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
}
inline Float16 join(Float8 a, Float8 b) {
  return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}

}  // namespace photopic
