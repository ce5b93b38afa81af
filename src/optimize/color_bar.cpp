#include "optimize/color_bar.h"

#include "optimize/path_estimate.h"
#include "spectral/observer.h"

namespace photopic {
ColorBar color_bar(std::span<const WavelengthSampler> samplers, const TabulatedSpectrum& emission, int width,
                   int rows_per_block, double luminance) {
  const Xyz lamp = emission_xyz(emission, Observer::cie1931());
  ColorBar bar{width, rows_per_block * (static_cast<int>(samplers.size()) + 1), {}};

  const auto add_block = [&](const std::vector<Rgb>& row) {
    for (int i = 0; i < rows_per_block; ++i) bar.pixels.insert(bar.pixels.end(), row.begin(), row.end());
  };
  for (const WavelengthSampler& sampler : samplers) {
    PathEstimate path(sampler, emission);
    std::vector<Rgb> row;
    for (int i = 0; i < width; ++i) {
      path.draw((i + 0.5) / width);
      row.push_back(xyz_to_linear_srgb(path.white() * luminance));
    }
    add_block(row);
  }
  add_block(std::vector<Rgb>(width, xyz_to_linear_srgb(lamp * (luminance / lamp.y))));
  return bar;
}

}  // namespace photopic
