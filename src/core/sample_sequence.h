#pragma once

#if defined(__GFNI__) && defined(__AVX512F__)
#include <immintrin.h>
#endif

#include <cstdint>

#include "core/lanes.h"

namespace photopic {

enum class Sequence { sobol, independent };

// U is one std::uint32_t or UintLanes.

/// Mixes all bits: Wellons' lowbias32 (nullprogram.com/blog/2018/07/31).
template <typename U>
U mix_bits(U x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ (x >> 16);
}

inline std::uint32_t swap_bytes(std::uint32_t x) {
  return __builtin_bswap32(x);
}
inline UintLanes swap_bytes(UintLanes x) {
  x = (x << 16) | (x >> 16);
  return ((x & 0x00ff00ffu) << 8) | ((x >> 8) & 0x00ff00ffu);
}

/// The bits of each byte the other way round.
template <typename U>
U reverse_in_bytes(U x) {
  x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
  x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
  return ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
}
#if defined(__GFNI__) && defined(__AVX512F__)
/// As a product of matrices of bits, which is one instruction.
inline UintLanes reverse_in_bytes(UintLanes x) {
  const __m512i mirror = _mm512_set1_epi64(static_cast<long long>(0x8040201008040201));
  return reinterpret_cast<UintLanes>(_mm512_gf2p8affine_epi64_epi8(reinterpret_cast<__m512i>(x), mirror, 0));
}
#endif

template <typename U>
U reverse_bits(U x) {
  return reverse_in_bytes(swap_bytes(x));
}

/// Owen scrambling of a number whose bits stand reversed (a bit is flipped by a hash of those below it): the
/// Laine–Karras hash (Laine, Karras 2011) with Vegdahl's constants (psychopath.io, "Building a Better LK
/// Hash", 2021).
template <typename U>
U owen_scramble_reversed(U x, U seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  return x ^ (x * 0x53a22864u);
}

/// The second Sobol' dimension of an index, its bits reversed. The generator matrix is Pascal's triangle mod
/// 2: a sum over supersets of the index's bits, in five steps. (The first dimension's reversed bits are the
/// index itself.)
template <typename U>
U sobol_second_reversed(U index) {
  index ^= (index >> 16) & 0x0000ffffu;
  index ^= (index >> 8) & 0x00ff00ffu;
  index ^= (index >> 4) & 0x0f0f0f0fu;
  index ^= (index >> 2) & 0x33333333u;
  return index ^ ((index >> 1) & 0x55555555u);
}

template <typename T>
struct BasicSample2d {
  T x, y;
};
using Sample2d = BasicSample2d<float>;
using Sample2dLanes = BasicSample2d<Lanes>;

template <typename T>
Sample2d lane(const BasicSample2d<T>& u, int i) {
  return {lane(u.x, i), lane(u.y, i)};
}

/// The numbers that drive one path: pairs of an Owen-scrambled Sobol' sequence, padded by shuffling the
/// sample index anew for each dimension pair (Burley 2020, "Practical Hash-based Owen Scrambling", sections
/// 4–5), or independent ones. A pure function of (seed, pixel, sample, dimension), so any path may be drawn
/// in any order.
template <typename U>
class BasicSampleStream {
 public:
  using Float = decltype(to_float(U{}));

  BasicSampleStream() = default;
  BasicSampleStream(Sequence sequence, U seed, U index_reversed)
      : seed_(seed), index_reversed_(index_reversed), sequence_(sequence) {}
  BasicSampleStream(Sequence sequence, U seed, U pixel, U sample)
      : seed_(mix_bits(pixel ^ mix_bits(seed * 0x9e3779b9u + 0x85ebca6bu))), sequence_(sequence) {
    if (sequence == Sequence::sobol)
      index_reversed_ = reverse_bits(sample);
    else
      seed_ = mix_bits(seed_ + sample * 0x9e3779b9u);
  }

  /// 32 random bits, stratified over the samples of a pixel.
  PHOTOPIC_INLINE U bits(std::uint32_t dimension) const {
    const U hash = hash_of(dimension);
    if (sequence_ == Sequence::independent) return hash;
    return reverse_bits(owen_scramble_reversed(shuffled_index(hash), mix_bits(hash + 1u)));
  }

  Float get_1d(std::uint32_t dimension) const { return to_unit(bits(dimension)); }

  /// All 32 bits, in the middle of their intervals: for choices that 24 bits are too coarse for.
  double get_1d_fine(std::uint32_t dimension) const { return fine(bits(dimension)); }
  static double fine(std::uint32_t bits) { return (bits + 0.5) * 0x1p-32; }
  static DoubleLanes fine(UintLanes bits) {
    return (__builtin_convertvector(bits, DoubleLanes) + 0.5) * 0x1p-32;
  }

  PHOTOPIC_INLINE BasicSample2d<Float> get_2d(std::uint32_t dimension) const {
    const U hash = hash_of(dimension);
    if (sequence_ == Sequence::independent) return {to_unit(hash), to_unit(mix_bits(hash + 1u))};
    const U index = shuffled_index(hash);
    const U x = owen_scramble_reversed(index, mix_bits(hash + 1u));
    const U y = owen_scramble_reversed(sobol_second_reversed(index), mix_bits(hash + 2u));
    return {to_unit(reverse_bits(x)), to_unit(reverse_bits(y))};
  }

  U seed() const { return seed_; }
  U index_reversed() const { return index_reversed_; }

 private:
  U hash_of(std::uint32_t dimension) const { return mix_bits(seed_ + dimension * 0x9e3779b9u); }
  U shuffled_index(U hash) const { return reverse_bits(owen_scramble_reversed(index_reversed_, hash)); }
  /// [0, 1): 24 bits, so that rounding never yields 1.
  static Float to_unit(U bits) { return to_float(bits >> 8) * 0x1p-24f; }

  U seed_{};
  U index_reversed_{};  ///< the sample's index, its bits reversed
  Sequence sequence_ = Sequence::sobol;
};
using SampleStream = BasicSampleStream<std::uint32_t>;
using SampleStreamLanes = BasicSampleStream<UintLanes>;

}  // namespace photopic
