#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

/// Vectors that are handed over in memory cost more than the little work on them: what has this mark goes
/// into its caller, however large the compiler holds it to be.
#define PHOTOPIC_INLINE [[gnu::always_inline]] inline

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
inline std::int32_t select(bool condition, std::int32_t a, std::int32_t b) {
  return condition ? a : b;
}

/// What comparisons of T give.
template <typename T>
using Mask = decltype(T{} < T{});

/// Bit i tells of lane i.
inline std::uint32_t bits_of(bool mask) {
  return mask ? 1 : 0;
}
inline std::uint32_t bits_of(IntLanes mask) {
  constexpr IntLanes kBit{1 << 0, 1 << 1, 1 << 2,  1 << 3,  1 << 4,  1 << 5,  1 << 6,  1 << 7,
                          1 << 8, 1 << 9, 1 << 10, 1 << 11, 1 << 12, 1 << 13, 1 << 14, 1 << 15};
  IntLanes b = mask & kBit;
  b |= __builtin_shufflevector(b, b, 8, 9, 10, 11, 12, 13, 14, 15, 0, 1, 2, 3, 4, 5, 6, 7);
  b |= __builtin_shufflevector(b, b, 4, 5, 6, 7, 0, 1, 2, 3, 12, 13, 14, 15, 8, 9, 10, 11);
  return static_cast<std::uint32_t>(b[0] | b[1] | b[2] | b[3]);
}

/// Whether a mask is set in any lane.
template <typename M>
bool any(M mask) {
  return bits_of(mask) != 0;
}

/// Calls f with the numbers of the lanes in which a mask is set: which they are cannot be foretold, so a
/// branch for each would be foretold wrong.
template <typename M, typename F>
PHOTOPIC_INLINE void for_each_lane(M mask, const F& f) {
  for (std::uint32_t bits = bits_of(mask); bits != 0; bits &= bits - 1) f(std::countr_zero(bits));
}

/// One of the numbers; a single number has lane 0.
inline float lane(float a, int) {
  return a;
}
/// Not a[i], if i is no constant: for that GCC copies all lanes to memory, and again for each i.
template <typename Number, typename Vector>
Number lane_of(const Vector& a, int i) {
  Number value;
  std::memcpy(&value, reinterpret_cast<const char*>(&a) + static_cast<std::size_t>(i) * sizeof(value),
              sizeof(value));
  return value;
}
inline float lane(const Lanes& a, int i) {
  return lane_of<float>(a, i);
}
inline std::int32_t lane(const IntLanes& a, int i) {
  return lane_of<std::int32_t>(a, i);
}
inline std::uint32_t lane(const UintLanes& a, int i) {
  return lane_of<std::uint32_t>(a, i);
}
inline void set_lane(float& a, int, float value) {
  a = value;
}
inline void set_lane(Lanes& a, int i, float value) {
  a[i] = value;
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
inline float to_float(std::int32_t a) {
  return static_cast<float>(a);
}
inline Lanes to_float(IntLanes a) {
  return __builtin_convertvector(a, Lanes);
}
/// Of integers below 2^31.
inline float to_float(std::uint32_t a) {
  return static_cast<float>(a);
}
inline Lanes to_float(UintLanes a) {
  return __builtin_convertvector(reinterpret_cast<IntLanes>(a), Lanes);
}

/// A perfect shuffle of all numbers in some rows: the first half, then in turn with it the second.
template <std::size_t kRows>
PHOTOPIC_INLINE std::array<Lanes, kRows> interleave(const std::array<Lanes, kRows>& m) {
  std::array<Lanes, kRows> next;
  for (std::size_t k = 0; k < kRows / 2; ++k) {
    const Lanes a = m[k], b = m[k + kRows / 2];
    next[2 * k] = __builtin_shufflevector(a, b, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
    next[2 * k + 1] =
        __builtin_shufflevector(a, b, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31);
  }
  return next;
}
/// The way back: numbers at even places, then those at odd ones.
template <std::size_t kRows>
PHOTOPIC_INLINE std::array<Lanes, kRows> deinterleave(const std::array<Lanes, kRows>& m) {
  std::array<Lanes, kRows> next;
  for (std::size_t k = 0; k < kRows / 2; ++k) {
    const Lanes a = m[2 * k], b = m[2 * k + 1];
    next[k] = __builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
    next[k + kRows / 2] =
        __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31);
  }
  return next;
}

/// Rows of numbers, a vector each.
using LaneMatrix = std::array<Lanes, kLanes>;

inline LaneMatrix transpose(const LaneMatrix& m) {
  return interleave(interleave(interleave(interleave(m))));
}

/// Sixteen rows of n numbers, one after the other in memory, as n columns; n is 2^k.
template <std::size_t n>
PHOTOPIC_INLINE std::array<Lanes, n> columns(std::array<Lanes, n> rows) {
  if constexpr (n > 1)
    for (std::size_t i = 1; i < n; i *= 2) rows = deinterleave(rows);
  return rows;
}
/// The way back.
template <std::size_t n>
PHOTOPIC_INLINE std::array<Lanes, n> rows_of(std::array<Lanes, n> columns) {
  if constexpr (n > 1)
    for (std::size_t i = 1; i < n; i *= 2) columns = interleave(columns);
  return columns;
}

inline constexpr UintLanes kLaneNumbers{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

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

  /// The mask of the lanes in use.
  IntLanes used() const { return reinterpret_cast<IntLanes>(kLaneNumbers) < count; }
};

inline Lanes gather(const float* from, const Packet& packet) {
  Lanes r;
  for (int i = 0; i < kLanes; ++i) r[i] = from[packet[i]];
  return r;
}
inline UintLanes gather(const std::uint32_t* from, const Packet& packet) {
  UintLanes r;
  for (int i = 0; i < kLanes; ++i) r[i] = from[packet[i]];
  return r;
}

/// Whole numbers beside T: std::int32_t or IntLanes.
template <typename T>
using IndexOf = decltype(to_int(T{}));

template <typename Number>
Number gather(const Number* from, std::int32_t index) {
  return from[index];
}
inline Lanes gather(const float* from, IntLanes index) {
  Lanes r;
  for (int i = 0; i < kLanes; ++i) r[i] = from[index[i]];
  return r;
}
inline IntLanes gather(const std::int32_t* from, IntLanes index) {
  IntLanes r;
  for (int i = 0; i < kLanes; ++i) r[i] = from[index[i]];
  return r;
}

}  // namespace photopic
