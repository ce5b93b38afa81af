#include "optimize/reflectance_set.h"

#include <array>
#include <cmath>

#include "optimize/random.h"
#include "spectral/content_hash.h"

namespace photopic {

std::vector<Spectrum> target_reflectances(int count, std::uint64_t seed) {
  constexpr double kRoot = 1.2207440846057594753617;  // the real root of x⁴ = x + 1, which makes R_3 even
  std::array<double, 3> point, step{1.0 / kRoot, 1.0 / (kRoot * kRoot), 1.0 / (kRoot * kRoot * kRoot)};
  Random random(seed);
  for (double& p : point) p = uniform(random);

  std::vector<Spectrum> reflectances{ConstantSpectrum{1.0}};
  for (int i = 1; i < count; ++i) {
    for (int d = 0; d < 3; ++d) point[d] = std::fmod(point[d] + step[d], 1.0);
    reflectances.emplace_back(
        upsample_reflectance({srgb_decode(point[0]), srgb_decode(point[1]), srgb_decode(point[2])}));
  }
  return reflectances;
}

std::vector<Spectrum> test_reflectances(int count) {
  constexpr std::uint64_t kSeed = 0x7e57;
  Random random(kSeed);
  const auto component = [&] { return srgb_decode(uniform(random)); };
  std::vector<Spectrum> reflectances;
  for (int i = 0; i < count; ++i) {
    const double r = component(), g = component(), b = component();
    reflectances.emplace_back(upsample_reflectance({r, g, b}));
  }
  return reflectances;
}

std::string reflectances_digest(std::span<const Spectrum> reflectances) {
  if (reflectances.empty()) return "";
  ContentHash hash;
  for (const Spectrum& reflectance : reflectances)
    for (double nm = kLambdaMin; nm <= kLambdaMax; nm += 1.0) hash.add(evaluate(reflectance, nm), 1e-7);
  return hash.text();
}

}  // namespace photopic
