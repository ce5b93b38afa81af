#include "core/image_metrics.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "spectral/color_difference.h"

namespace photopic {
namespace {

constexpr double kRelativeFloor = 1e-2;  // keeps dark pixels from ruling relmse

bool is_finite(const float* pixel) {
  return std::isfinite(pixel[0]) && std::isfinite(pixel[1]) && std::isfinite(pixel[2]);
}

Lab pixel_lab(const float* pixel, Xyz white) {
  return xyz_to_lab(linear_srgb_to_xyz({pixel[0], pixel[1], pixel[2]}), white);
}

double percentile(const std::vector<double>& sorted, double fraction) {
  const double position = fraction * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], position - static_cast<double>(below));
}

}  // namespace

std::vector<double> delta_e_map(const Image& reference, const Image& image, Xyz white) {
  std::vector<double> map(reference.pixels.size() / 3);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, map.size(), 1024), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const float *a = &reference.pixels[3 * i], *b = &image.pixels[3 * i];
      const bool finite = is_finite(a) && is_finite(b);
      map[i] = finite ? delta_e_2000(pixel_lab(a, white), pixel_lab(b, white))
                      : std::numeric_limits<double>::quiet_NaN();
    }
  });
  return map;
}

ImageDifference compare_images(const Image& reference, const Image& image, Xyz white) {
  if (reference.width != image.width || reference.height != image.height) {
    throw std::invalid_argument(fmt::format("the images differ in size: {} x {} and {} x {}", reference.width,
                                            reference.height, image.width, image.height));
  }
  ImageDifference difference;
  std::vector<double> map = delta_e_map(reference, image, white);
  double sum = 0.0, squares = 0.0, relative = 0.0;
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (std::isnan(map[i])) {
      ++difference.non_finite;
      continue;
    }
    sum += map[i];
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) {
      const double a = reference.pixels[k], error = image.pixels[k] - a;
      squares += error * error;
      relative += error * error / (a * a + kRelativeFloor);
    }
  }

  std::erase_if(map, [](double value) { return std::isnan(value); });
  std::ranges::sort(map);
  const auto count = static_cast<double>(map.size());
  difference.mean_delta_e = sum / count;
  difference.mse = squares / (3.0 * count);
  difference.relmse = relative / (3.0 * count);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  difference.median_delta_e = map.empty() ? kNan : percentile(map, 0.5);
  difference.p95_delta_e = map.empty() ? kNan : percentile(map, 0.95);
  difference.max_delta_e = map.empty() ? kNan : map.back();
  return difference;
}

}  // namespace photopic
