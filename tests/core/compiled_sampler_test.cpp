#include "core/compiled_sampler.h"

#include <gtest/gtest.h>

#include <bit>

#include "core/sample_sequence.h"
#include "spectral/illuminants.h"
#include "spectral/wavelength_checks.h"

namespace photopic {
namespace {

/// The largest value next to a wavelength: single precision is relative to it.
double scale_at(const TabulatedSpectrum& spectrum, double nm) {
  const auto knots = spectrum.lambda();
  const auto right = std::upper_bound(knots.begin(), knots.end() - 1, nm) - knots.begin();
  return std::max(spectrum.value()[right - 1], spectrum.value()[right]);
}

/// Sixteen in a row: evenly spread, and both ends of u among them.
UintLanes bits_of_packet(std::uint32_t packet, std::uint32_t packets) {
  UintLanes bits;
  for (std::uint32_t i = 0; i < kLanes; ++i) {
    const std::uint64_t number = packet * kLanes + i, last = packets * kLanes - 1ull;
    bits[i] = static_cast<std::uint32_t>(number * 0xffffffffull / last);
  }
  return bits;
}

/// VisibleWavelengths' density at every nanometre.
PiecewiseLinearDensity polygon(int count) {
  std::vector<double> nm, value;
  for (int i = 0; i <= 470; ++i) {
    nm.push_back(360.0 + i);
    value.push_back(density_sum(VisibleWavelengths{count}, nm.back()));
  }
  return {std::move(nm), std::move(value)};
}

/// What the compiled sampler stands for, in double precision.
template <int N>
class PlainSampler {
 public:
  explicit PlainSampler(const WavelengthSampler& sampler) : sampler_(sampler) {}
  SampledWavelengths<N> operator()(std::uint32_t bits) const {
    const double u = SampleStream::fine(bits);
    if (!std::holds_alternative<VisibleWavelengths>(sampler_)) return sample_wavelengths<N>(sampler_, u);
    SampledWavelengths<N> w;
    for (std::size_t j = 0; j < N; ++j) {
      const double turned = u + static_cast<double>(j) / N;
      const auto drawn = polygon_.draw(turned < 1.0 ? turned : turned - 1.0);
      w.lambda[j] = drawn.x, w.density_sum[j] = N * drawn.density;
    }
    return w;
  }

 private:
  const WavelengthSampler& sampler_;
  PiecewiseLinearDensity polygon_ = polygon(N);
};

TEST(CompiledSampler, VisibleDensityIsNearlyAPolygon) {
  const PiecewiseLinearDensity density = polygon(4);
  for (double nm = 360.0; nm <= 830.0; nm += 0.03)
    ASSERT_NEAR(4.0 * density.density(nm) / density_sum(VisibleWavelengths{4}, nm), 1.0, 3e-5) << nm;
}

/// Every number of the compiled sampler against what is drawn and looked up in double precision. Where a
/// density falls to nothing few digits of it are left, and a jump may be met on its other side: so one in a
/// thousand may be off.
template <int N>
void expect_plain(const WavelengthSampler& sampler, const Observer& observer,
                  const std::vector<TabulatedSpectrum>& lamps) {
  SCOPED_TRACE(testing::Message() << sampler_name(sampler) << ", " << N << " wavelengths");
  const CompiledSampler compiled(sampler, observer, lamps);
  const PlainSampler<N> plain_sampler(sampler);
  constexpr std::uint32_t kPackets = 512;
  constexpr double kTolerance = 1e-3;
  int off = 0;
  const auto check = [&off](double value, double plain, double scale, double tolerance) {
    ASSERT_TRUE(std::isfinite(value));
    off += !(std::abs(value - plain) <= tolerance * scale);
  };
  for (std::uint32_t p = 0; p < kPackets; ++p) {
    const UintLanes bits = bits_of_packet(p, kPackets);
    const WavelengthLanes<N> drawn = compiled.draw<N>(bits);
    std::vector<std::array<SpectrumLanes<N>, 4>> looked_up;
    for (std::size_t first = 0; first < 3 + lamps.size(); first += 4)
      looked_up.push_back(compiled.look_up(drawn, first));
    for (int i = 0; i < kLanes; ++i) {
      const auto plain = plain_sampler(bits[i]);
      const SampledSpectrum<N> alone = compiled.look_up(drawn.place(i), 2 + lamps.size());
      for (std::size_t j = 0; j < N; ++j) {
        ASSERT_EQ(alone[static_cast<int>(j)], looked_up.back()[(2 + lamps.size()) % 4].v[j][i]);
        const double nm = plain.lambda[j];
        const auto value = [&](std::size_t s) { return double{looked_up[s / 4][s % 4].v[j][i]}; };
        ASSERT_GE(drawn.lambda.v[j][i], kLambdaMin);
        ASSERT_LE(drawn.lambda.v[j][i], kLambdaMax);
        ASSERT_GT(drawn.weight.v[j][i], 0.0f);
        check(drawn.lambda.v[j][i], nm, 1.0, kTolerance);
        check(drawn.weight.v[j][i] * plain.density_sum[j], 1.0, 1.0, kTolerance);
        const Xyz h = observer(nm) * (1.0 / observer.y_integral());
        for (const auto& [s, exact] : {std::pair{0u, h.x}, {1u, h.y}, {2u, h.z}})
          check(value(s), exact, exact + 1e-10, kTolerance);
        for (std::size_t k = 0; k < lamps.size(); ++k)
          check(value(3 + k), lamps[k](nm), scale_at(lamps[k], nm), kTolerance);
      }
    }
  }
  EXPECT_LE(off, static_cast<int>(kPackets * kLanes * N / 1000));
}

TEST(CompiledSampler, IsThePlainSampler) {
  for (const auto& [name, lamp] : test::hard_lamps()) {
    SCOPED_TRACE(name);
    const std::vector<TabulatedSpectrum> one{lamp};
    for (const WavelengthSampler& sampler : test::all_samplers(lamp, 4, 3))
      expect_plain<4>(sampler, Observer::cie1931(), one);
  }
}

TEST(CompiledSampler, IsThePlainSamplerForAnyNumberOfWavelengths) {
  const TabulatedSpectrum lamp = tabulate_emission(*cie_illuminant("FL11"));
  const std::vector<TabulatedSpectrum> one{lamp};
  for (const WavelengthSampler& s : test::all_samplers(lamp, 1, 5))
    expect_plain<1>(s, Observer::cie1931(), one);
  for (const WavelengthSampler& s : test::all_samplers(lamp, 8, 6))
    expect_plain<8>(s, Observer::cie1931(), one);
  for (const WavelengthSampler& s : test::all_samplers(lamp, 16, 7))
    expect_plain<16>(s, Observer::cie1931(), one);
}

TEST(CompiledSampler, HoldsAnyNumberOfLamps) {
  std::vector<TabulatedSpectrum> lamps;
  expect_plain<4>(UniformWavelengths{4}, Observer::cie1964(), lamps);
  for (const auto& [name, lamp] : test::hard_lamps()) {
    if (lamps.size() == 11) break;
    lamps.push_back(lamp);
    for (const WavelengthSampler& sampler : test::all_samplers(lamp, 4, 9))
      expect_plain<4>(sampler, Observer::cie1964(), lamps);
  }
}

/// A lamp's XYZ by both, at the same u.
struct Means {
  Xyz compiled, plain;
};

Means means_of(const WavelengthSampler& sampler, const TabulatedSpectrum& lamp) {
  const Observer& observer = Observer::cie1931();
  const CompiledSampler compiled(sampler, observer, std::span(&lamp, 1));
  const PlainSampler<4> plain_sampler(sampler);
  constexpr std::uint32_t kPackets = 1 << 14;
  Means means;
  for (std::uint32_t p = 0; p < kPackets; ++p) {
    const UintLanes bits = bits_of_packet(p, kPackets);
    const WavelengthLanes<4> drawn = compiled.draw<4>(bits);
    const auto [x, y, z, emission] = compiled.look_up(drawn, 0);
    const SpectrumLanes<4> arriving = emission * drawn.weight;
    for (int i = 0; i < kLanes; ++i) {
      const auto plain = plain_sampler(bits[i]);
      for (std::size_t j = 0; j < 4; ++j) {
        means.compiled += Xyz{x.v[j][i], y.v[j][i], z.v[j][i]} * double{arriving.v[j][i]};
        means.plain += observer(plain.lambda[j]) *
                       (lamp(plain.lambda[j]) / (plain.density_sum[j] * observer.y_integral()));
      }
    }
  }
  return means;
}

// What is lost to rounding does not add up.
TEST(CompiledSampler, HasThePlainSamplersMean) {
  for (const auto& [name, lamp] : test::hard_lamps()) {
    for (const WavelengthSampler& sampler : test::all_samplers(lamp, 4, 11)) {
      const auto [compiled, plain] = means_of(sampler, lamp);
      test::expect_same_xyz(compiled, plain, 2e-5, std::string(sampler_name(sampler)) + ", " + name);
    }
  }
}

// A packet's lanes do not depend on each other.
TEST(CompiledSampler, DrawsEachLaneAlone) {
  const TabulatedSpectrum lamp = tabulate_emission(*cie_illuminant("FL11"));
  const WavelengthSampler sampler = test::all_samplers(lamp, 8, 13).back();
  const CompiledSampler compiled(sampler, Observer::cie1931(), std::span(&lamp, 1));
  const UintLanes bits = bits_of_packet(3, 7);
  const WavelengthLanes<8> together = compiled.draw<8>(bits);
  for (int i = 0; i < kLanes; ++i) {
    const WavelengthLanes<8> alone = compiled.draw<8>(UintLanes{} + bits[i]);
    for (std::size_t j = 0; j < 8; ++j) {
      EXPECT_EQ(std::bit_cast<std::uint32_t>(alone.lambda.v[j][0]),
                std::bit_cast<std::uint32_t>(together.lambda.v[j][i]));
      EXPECT_EQ(std::bit_cast<std::uint32_t>(alone.weight.v[j][0]),
                std::bit_cast<std::uint32_t>(together.weight.v[j][i]));
    }
  }
}

}  // namespace
}  // namespace photopic
