#include "optimize/color_bar.h"

#include <algorithm>

#include "optimize/target_table.h"
#include "spectral/observer.h"

namespace photopic {
namespace {

/// E(u) for R = 1.
Xyz estimate(const WavelengthSampler& sampler, const Emitter& emitter, double u) {
  const auto count = static_cast<std::size_t>(wavelength_count(sampler));
  std::vector<double> lambda(count), density_sum(count);
  draw_wavelengths(sampler, u, lambda, density_sum);
  Xyz sum;
  for (std::size_t j = 0; j < count; ++j)
    sum += Observer::cie1931()(lambda[j]) * (emitter.scale * emitter.emission(lambda[j]) / density_sum[j]);
  return sum;
}

}  // namespace

ColorBar color_bar(std::span<const WavelengthSampler> samplers, const TabulatedSpectrum& emission, int width,
                   int rows_per_block, double luminance) {
  const Emitter emitter = make_emitter(emission);
  const Xyz lamp = emission_xyz(emitter.emission, Observer::cie1931());
  ColorBar bar{width, rows_per_block * (static_cast<int>(samplers.size()) + 1), {}};

  const auto add_block = [&](const std::vector<Rgb>& row) {
    for (int i = 0; i < rows_per_block; ++i) bar.pixels.insert(bar.pixels.end(), row.begin(), row.end());
  };
  for (const WavelengthSampler& sampler : samplers) {
    std::vector<Rgb> row;
    for (int i = 0; i < width; ++i)
      row.push_back(xyz_to_linear_srgb(estimate(sampler, emitter, (i + 0.5) / width) * luminance));
    add_block(row);
  }
  add_block(std::vector<Rgb>(width, xyz_to_linear_srgb(lamp * (luminance / lamp.y))));
  return bar;
}

}  // namespace photopic
