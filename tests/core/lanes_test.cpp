#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "core/bsdf/opaque_bsdf.h"
#include "core/row_array.h"
#include "core/sample_sequence.h"
#include "support/bsdf_checks.h"
#include "support/scene_builder.h"

namespace photopic {
namespace {

using namespace test;

IntLanes mask_of(std::uint32_t bits) {
  IntLanes mask;
  for (int i = 0; i < kLanes; ++i) mask[i] = (bits >> i & 1) != 0 ? -1 : 0;
  return mask;
}

TEST(Lanes, BitsOfAMask) {
  for (std::uint32_t bits : {0u, 1u, 0x8000u, 0xffffu, 0x1234u, 0xa5c3u}) {
    EXPECT_EQ(bits_of(mask_of(bits)), bits);
    EXPECT_EQ(any(mask_of(bits)), bits != 0);
    std::uint32_t seen = 0;
    int last = -1;
    for_each_lane(mask_of(bits), [&](int i) {
      EXPECT_GT(i, last);
      last = i, seen |= 1u << i;
    });
    EXPECT_EQ(seen, bits);
  }
  EXPECT_TRUE(any(true));
  EXPECT_FALSE(any(false));
}

TEST(Lanes, RowsAndColumns) {
  std::array<Lanes, 4> rows;  // 16 rows of 4 numbers
  for (int i = 0; i < 64; ++i) rows[static_cast<std::size_t>(i / kLanes)][i % kLanes] = static_cast<float>(i);
  const auto turned = columns(rows);
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < kLanes; ++r)
      EXPECT_EQ(turned[static_cast<std::size_t>(c)][r], static_cast<float>(4 * r + c));
  const auto back = rows_of(turned);
  for (std::size_t i = 0; i < 4; ++i)
    for (int j = 0; j < kLanes; ++j) EXPECT_EQ(back[i][j], rows[i][j]);
}

/// Of whatever bits, integers that are no numbers as floats too.
template <std::size_t n>
void expect_rows_gathered() {
  std::array<std::array<std::uint32_t, n>, 3 * kLanes> rows;
  for (std::uint32_t i = 0; i < rows.size(); ++i)
    for (std::uint32_t j = 0; j < n; ++j) rows[i][j] = mix_bits(100 * i + j) | 0x7f800000u * (i % 2);
  const auto place = [](int i) { return static_cast<std::size_t>(i * 7 % (3 * kLanes)); };
  const auto gathered = gather_rows<n>([&](int i) { return rows[place(i)].data(); });
  for (std::size_t j = 0; j < n; ++j)
    for (int i = 0; i < kLanes; ++i)
      EXPECT_EQ(lane(reinterpret_cast<UintLanes>(gathered[j]), i), rows[place(i)][j]) << n << ", " << i;
}

TEST(Lanes, RowsGatheredFromMemory) {
  expect_rows_gathered<1>();
  expect_rows_gathered<2>();
  expect_rows_gathered<4>();
  expect_rows_gathered<8>();
  expect_rows_gathered<16>();
}

TEST(Lanes, VectorsInSlots) {
  RowArray array(2 * kLanes);
  Vec3Lanes v;
  Lanes w;
  for (int i = 0; i < kLanes; ++i) {
    const auto number = static_cast<float>(i);
    set_lane(v, i, {number, -number, 0.5f * number}), w[i] = 100.0f + number;
  }
  std::vector<std::uint32_t> slots;
  for (std::uint32_t i = 0; i < kLanes; ++i) slots.push_back(5 * i % 32);
  const auto rows = rows_of(v, w);
  for (std::size_t i = 0; i < kLanes; ++i) array.set(slots[i], rows[i]);
  const auto [x, y, z, w_back] = array.gather(Packet(slots, 0));
  for (int i = 0; i < kLanes; ++i) {
    EXPECT_EQ((Vec3f{lane(x, i), lane(y, i), lane(z, i)}), lane(v, i));
    EXPECT_EQ(array[slots[static_cast<std::size_t>(i)]], lane(v, i));
    EXPECT_EQ(lane(w_back, i), array.w(slots[static_cast<std::size_t>(i)]));
  }
}

TEST(Lanes, ReversedBitsAreThoseOfOneNumber) {
  UintLanes x;
  for (int i = 0; i < kLanes; ++i) x[i] = mix_bits(static_cast<std::uint32_t>(i) + 1u);
  const UintLanes reversed = reverse_bits(x);
  for (int i = 0; i < kLanes; ++i) EXPECT_EQ(reversed[i], reverse_bits(static_cast<std::uint32_t>(x[i])));
  EXPECT_EQ(reverse_bits(1u), 0x80000000u);
  EXPECT_EQ(reverse_bits(0x00010200u), 0x00408000u);
}

template <int N>
void expect_spectra_as_one_by_one() {
  LaneSpectra<N> a, b;
  for (std::size_t i = 0; i < kLanes; ++i)
    for (int j = 0; j < N; ++j) {
      a[i].set(j, static_cast<float>(i) + 0.01f * static_cast<float>(j));
      b[i].set(j, i == 3 ? 0.0f : 2.0f - a[i][j]);
    }
  const SpectrumLanes<N> la = to_lanes<N>(a), lb = to_lanes<N>(b);
  const LaneSpectra<N> product = by_lane(la * lb), quotient = by_lane(share(la, lb));
  const LaneSpectra<N> capped = by_lane(at_most_1(la));
  for (std::size_t i = 0; i < kLanes; ++i) {
    const int lane = static_cast<int>(i);
    EXPECT_NEAR(la.sum()[lane], a[i].sum(), 1e-5f * a[i].sum());
    EXPECT_EQ(lb.is_black()[lane] != 0, b[i].is_black());
    for (int j = 0; j < N; ++j) {
      EXPECT_EQ(product[i][j], (a[i] * b[i])[j]);
      EXPECT_EQ(quotient[i][j], share(a[i], b[i])[j]);
      EXPECT_EQ(capped[i][j], at_most_1(a[i])[j]);
    }
  }
}

TEST(Lanes, SpectraAsOneByOne) {
  expect_spectra_as_one_by_one<1>();
  expect_spectra_as_one_by_one<4>();
  expect_spectra_as_one_by_one<8>();
  expect_spectra_as_one_by_one<16>();
}

/// Sixteen materials that share nothing, seen from as many directions.
struct Paths {
  std::vector<OpaqueMaterial<4, float>> material;
  std::vector<Vec3f> wo;

  Paths() {
    const SampledSpectrum<4> lambda(SampledSpectrum<4>::Vector{420, 500, 580, 660});
    for (std::uint32_t i = 0; i < kLanes; ++i) {
      const SampleStream u(Sequence::independent, 3, 0, i);
      Material m = plastic(ConstantSpectrum{0.1 + 0.05 * i}, i % 4 == 0 ? 0.0f : u.get_1d(0));
      m.metallic = i % 3 == 0 ? 1.0f : u.get_1d(1), m.specular = u.get_1d(2);
      if (i == 5) m.ior = 0.0f;
      const Surface surface(m);
      material.push_back(opaque_material(ShadingMaterial<4>(surface, lambda)));
      wo.push_back(sample_cosine_hemisphere(u.get_2d(3)));
    }
    wo[7].z = -wo[7].z;
  }

  BasicOpaqueBsdf<4, Lanes> in_lanes() const {
    OpaqueMaterial<4, Lanes> all;
    LaneSpectra<4> base, f0;
    Vec3Lanes towards;
    for (int i = 0; i < kLanes; ++i) {
      const auto k = static_cast<std::size_t>(i);
      base[k] = material[k].base, f0[k] = material[k].f0;
      all.roughness[i] = material[k].roughness, all.metallic[i] = material[k].metallic;
      all.specular[i] = material[k].specular;
      set_lane(towards, i, wo[k]);
    }
    all.base = to_lanes<4>(base), all.f0 = to_lanes<4>(f0);
    return {all, towards};
  }
};

/// What the checks of BSDFs find of one path's holds for 16 as well.
TEST(Lanes, OpaqueBsdfsAsOneByOne) {
  const Paths paths;
  const auto all = paths.in_lanes();
  int found = 0, deltas = 0;
  for (std::uint32_t n = 0; n < 200; ++n) {
    const SampleStreamLanes stream(Sequence::independent, UintLanes{} + n, UintLanes{}, UintLanes{});
    const Lanes u_lobe = Lanes{} + SampleStream(Sequence::independent, n, 0, 1).get_1d(0);
    const Sample2dLanes u = stream.get_2d(1);
    const auto draws = all.draw(u_lobe, u);
    const auto values = all.evaluate(draws.wi);
    const LaneSpectra<4> weights = by_lane(draws.weight), f_cos = by_lane(values.f_cos);
    for (int i = 0; i < kLanes; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const OpaqueBsdf<4> one(paths.material[k], paths.wo[k]);
      const auto sample = one.sample(u_lobe[i], lane(u, i));
      ASSERT_EQ(draws.found[i] != 0, sample.has_value()) << n << ", lane " << i;
      if (!sample) continue;
      ++found, deltas += sample->delta ? 1 : 0;
      EXPECT_EQ(draws.delta[i] != 0, sample->delta);
      EXPECT_LT(length(lane(draws.wi, i) - sample->wi), 1e-5f);
      for (int j = 0; j < 4; ++j)
        EXPECT_NEAR(weights[k][j], sample->weight[j], 2e-4f * (sample->weight[j] + 1e-3f));
      if (sample->delta) continue;
      EXPECT_NEAR(draws.pdf[i], sample->pdf, 2e-4f * sample->pdf);
      const auto value = one.evaluate(lane(draws.wi, i));
      for (int j = 0; j < 4; ++j) EXPECT_NEAR(f_cos[k][j], value.f_cos[j], 1e-5f * (value.f_cos[j] + 1e-3f));
    }
  }
  EXPECT_GT(found, 2000);
  EXPECT_GT(deltas, 100);
}

/// A direction that is not a number leads to values that are none, which renders count: not to black.
TEST(Lanes, WhatIsNotANumberIsSeen) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto values = Paths().in_lanes().evaluate(broadcast<Lanes>({nan, nan, nan}));
  EXPECT_TRUE(std::isnan(values.f_cos.v[0][1]));
  EXPECT_TRUE(std::isnan(values.pdf[1]));
}

}  // namespace
}  // namespace photopic
