#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace photopic {

/// Vectors of 16 numbers, one a path, in the processor's registers (GCC's and clang's vector extension; where
/// registers are shorter, several). A function template on T works on one float or on Lanes alike;
/// comparisons of Lanes give masks, which select() takes.
inline constexpr int kLanes = 16;
using Lanes [[gnu::vector_size(kLanes * sizeof(float))]] = float;
using IntLanes [[gnu::vector_size(kLanes * sizeof(float))]] = std::int32_t;
using UintLanes [[gnu::vector_size(kLanes * sizeof(float))]] = std::uint32_t;
using DoubleLanes [[gnu::vector_size(kLanes * sizeof(double))]] = double;

inline float select(bool condition, float a, float b) {
  return condition ? a : b;
}
inline Lanes select(IntLanes condition, Lanes a, Lanes b) {
  return condition ? a : b;
}

inline bool select(bool condition, bool a, bool b) {
  return condition ? a : b;
}
inline IntLanes select(IntLanes condition, IntLanes a, IntLanes b) {
  return condition ? a : b;
}

/// Whether a mask is set in any lane.
inline bool any(bool mask) {
  return mask;
}
inline bool any(IntLanes mask) {
  std::int32_t all = 0;
  for (int i = 0; i < kLanes; ++i) all |= mask[i];
  return all != 0;
}

// On floats the names below mean the standard library's functions.
using std::abs, std::copysign, std::floor, std::max, std::min, std::sqrt;

inline Lanes sqrt(Lanes a) {
  Lanes r;
  for (int i = 0; i < kLanes; ++i) r[i] = std::sqrt(a[i]);
  return r;
}
inline Lanes floor(Lanes a) {
  Lanes r;
  for (int i = 0; i < kLanes; ++i) r[i] = std::floor(a[i]);
  return r;
}
inline Lanes abs(Lanes a) {
  return reinterpret_cast<Lanes>(reinterpret_cast<UintLanes>(a) & 0x7fffffffu);
}
inline Lanes copysign(Lanes magnitude, Lanes sign) {
  return reinterpret_cast<Lanes>((reinterpret_cast<UintLanes>(magnitude) & 0x7fffffffu) |
                                 (reinterpret_cast<UintLanes>(sign) & 0x80000000u));
}
/// As std::max and std::min: the first where the numbers cannot be compared.
inline Lanes max(Lanes a, Lanes b) {
  return a < b ? b : a;
}
inline Lanes min(Lanes a, Lanes b) {
  return b < a ? b : a;
}

inline std::int32_t to_int(float a) {
  return static_cast<std::int32_t>(a);
}
inline IntLanes to_int(Lanes a) {
  return __builtin_convertvector(a, IntLanes);
}
inline Lanes to_float(DoubleLanes a) {
  return __builtin_convertvector(a, Lanes);
}
inline DoubleLanes to_double(Lanes a) {
  return __builtin_convertvector(a, DoubleLanes);
}
/// Of integers below 2^31.
inline float to_float(std::uint32_t a) {
  return static_cast<float>(a);
}
inline Lanes to_float(UintLanes a) {
  return __builtin_convertvector(reinterpret_cast<IntLanes>(a), Lanes);
}

/// Rows of numbers, a vector each.
using LaneMatrix = std::array<Lanes, kLanes>;

/// Four perfect shuffles of the upper rows with the lower.
inline LaneMatrix transpose(LaneMatrix m) {
  for (int i = 0; i < 4; ++i) {
    LaneMatrix next;
    for (std::size_t k = 0; k < kLanes / 2; ++k) {
      const Lanes a = m[k], b = m[k + kLanes / 2];
      next[2 * k] = __builtin_shufflevector(a, b, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
      next[2 * k + 1] =
          __builtin_shufflevector(a, b, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31);
    }
    m = next;
  }
  return m;
}

/// Which paths' numbers stand in the lanes: up to 16 slots of a batch. Unused lanes repeat the first.
struct Packet {
  std::array<std::uint32_t, kLanes> slot;
  int count;

  template <typename Slots>
  Packet(const Slots& slots, std::size_t first)
      : count(static_cast<int>(std::min<std::size_t>(kLanes, slots.size() - first))) {
    for (int i = 0; i < kLanes; ++i)
      slot[static_cast<std::size_t>(i)] = slots[first + static_cast<std::size_t>(i < count ? i : 0)];
  }
  std::uint32_t operator[](int lane) const { return slot[static_cast<std::size_t>(lane)]; }
};

inline Lanes gather(const float* from, const Packet& packet) {
  Lanes r;
  for (int i = 0; i < kLanes; ++i) r[i] = from[packet[i]];
  return r;
}
template <typename T, typename Vector>
void scatter(T* to, const Packet& packet, const Vector& values) {
  for (int i = 0; i < packet.count; ++i) to[packet[i]] = values[i];
}
inline UintLanes gather(const std::uint32_t* from, const Packet& packet) {
  UintLanes r;
  for (int i = 0; i < kLanes; ++i) r[i] = from[packet[i]];
  return r;
}

}  // namespace photopic
