#include "core/lights/environment.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <span>

#include "error.h"
#include "spectral/color.h"

namespace photopic {
namespace {

constexpr double kPiD = std::numbers::pi;

double luminance(const float* pixel) {
  return linear_srgb_to_xyz({pixel[0], pixel[1], pixel[2]}).y;
}

/// Bilinear interpolation's mean over a pixel weighs it and its neighbours by 1/8, 3/4, 1/8 along each axis.
constexpr std::array<double, 3> kPixelMean = {0.125, 0.75, 0.125};

/// Divides cumulative sums so that they end at 1; a row without light gets equal shares.
void normalise(std::span<double> sums, std::span<float> result) {
  const double total = sums.back();
  const double count = static_cast<double>(sums.size() - 1);
  for (std::size_t i = 0; i < sums.size(); ++i)
    result[i] = static_cast<float>(total > 0.0 ? sums[i] / total : static_cast<double>(i) / count);
}

/// The interval of cumulative probabilities that u lies in, none of which is empty.
struct Interval {
  int index;
  float part;         ///< where in it, 0 … 1
  float probability;  ///< its own
};
Interval find_interval(std::span<const float> cumulative, float u) {
  const auto above = std::ranges::upper_bound(cumulative, u);
  auto i = std::clamp<std::ptrdiff_t>(above - cumulative.begin() - 1, 0,
                                      static_cast<std::ptrdiff_t>(cumulative.size()) - 2);
  while (i > 0 && cumulative[static_cast<std::size_t>(i + 1)] == cumulative[static_cast<std::size_t>(i)]) --i;
  const float low = cumulative[static_cast<std::size_t>(i)],
              high = cumulative[static_cast<std::size_t>(i + 1)];
  const float part = high > low ? std::clamp((u - low) / (high - low), 0.0f, 1.0f) : 0.5f;
  return {static_cast<int>(i), part, high - low};
}

}  // namespace

Environment::Environment(Image picture, double rotation)
    : picture_(std::move(picture)),
      cos_rotation_(static_cast<float>(std::cos(rotation * kPiD / 180.0))),
      sin_rotation_(static_cast<float>(std::sin(rotation * kPiD / 180.0))),
      rows_(static_cast<std::size_t>(picture_.height) + 1),
      columns_(static_cast<std::size_t>(picture_.height) * (width() + 1)),
      cos_theta_(rows_.size()) {
  const int w = picture_.width, h = picture_.height;
  for (int y = 0; y <= h; ++y)
    cos_theta_[static_cast<std::size_t>(y)] = static_cast<float>(std::cos(kPiD * y / h));
  std::vector<double> row_sums(rows_.size());
  tbb::parallel_for(0, h, [&](int y) {
    // Mean luminance over the pixel's height, for each column; then along the row.
    std::vector<double> means(width()), sums(width() + 1);
    for (int dy = -1; dy <= 1; ++dy)
      for (int x = 0; x < w; ++x)
        means[static_cast<std::size_t>(x)] += kPixelMean[static_cast<std::size_t>(dy + 1)] *
                                              luminance(picture_.at(x, std::clamp(y + dy, 0, h - 1)));
    for (std::size_t x = 0; x < width(); ++x)
      sums[x + 1] = sums[x] + kPixelMean[0] * means[(x + width() - 1) % width()] + kPixelMean[1] * means[x] +
                    kPixelMean[2] * means[(x + 1) % width()];
    const double solid_angle = 2.0 * kPiD / w * (std::cos(kPiD * y / h) - std::cos(kPiD * (y + 1) / h));
    row_sums[static_cast<std::size_t>(y) + 1] = sums.back() * solid_angle;
    normalise(sums, std::span(columns_).subspan(static_cast<std::size_t>(y) * (width() + 1), width() + 1));
  });
  for (std::size_t y = 1; y < row_sums.size(); ++y) row_sums[y] += row_sums[y - 1];
  flux_density_ = row_sums.back();
  normalise(row_sums, rows_);
}

Environment::Position Environment::position_of(Vec3f direction) const {
  // Into the picture's own directions: turned back about +y.
  const float x = direction.x * cos_rotation_ - direction.z * sin_rotation_;
  const float z = direction.x * sin_rotation_ + direction.z * cos_rotation_;
  const float phi = std::atan2(x, -z), theta = std::atan2(std::sqrt(x * x + z * z), direction.y);
  return {(phi * (0.5f * kInvPi) + 0.5f) * static_cast<float>(picture_.width),
          theta * kInvPi * static_cast<float>(picture_.height)};
}

Vec3f Environment::radiance(Vec3f direction) const {
  const auto [px, py] = position_of(direction);
  const float fx = std::floor(px - 0.5f), fy = std::floor(py - 0.5f);
  const float tx = px - 0.5f - fx, ty = py - 0.5f - fy;
  const int w = picture_.width, h = picture_.height;
  const int x0 = (static_cast<int>(fx) + w) % w, x1 = (x0 + 1) % w;
  const int y0 = std::clamp(static_cast<int>(fy), 0, h - 1),
            y1 = std::clamp(static_cast<int>(fy) + 1, 0, h - 1);
  const auto pixel = [&](int x, int y) {
    const float* p = picture_.at(x, y);
    return Vec3f{p[0], p[1], p[2]};
  };
  return (pixel(x0, y0) * (1.0f - tx) + pixel(x1, y0) * tx) * (1.0f - ty) +
         (pixel(x0, y1) * (1.0f - tx) + pixel(x1, y1) * tx) * ty;
}

Environment::Sample Environment::sample(Sample2d u) const {
  const Interval y = find_interval(rows_, u.y);
  const Interval x = find_interval(std::span(row(y.index), width() + 1), u.x);
  const float top = cos_theta_[static_cast<std::size_t>(y.index)];
  const float bottom = cos_theta_[static_cast<std::size_t>(y.index) + 1];
  const float cos_theta = top + (bottom - top) * y.part, sin_theta = safe_sqrt(1.0f - sqr(cos_theta));
  const float columns = static_cast<float>(picture_.width);
  const float phi = 2.0f * kPi * ((static_cast<float>(x.index) + x.part) / columns - 0.5f);
  const float right = sin_theta * std::sin(phi), back = -sin_theta * std::cos(phi);
  const float solid_angle = 2.0f * kPi / columns * (top - bottom);
  return {
      {right * cos_rotation_ + back * sin_rotation_, cos_theta, back * cos_rotation_ - right * sin_rotation_},
      x.probability * y.probability / solid_angle};
}

float Environment::pdf(Vec3f direction) const {
  const auto [px, py] = position_of(direction);
  const auto x = static_cast<std::size_t>(std::clamp(static_cast<int>(px), 0, picture_.width - 1));
  const auto y = static_cast<std::size_t>(std::clamp(static_cast<int>(py), 0, picture_.height - 1));
  const float* columns = row(static_cast<int>(y));
  const float solid_angle =
      2.0f * kPi / static_cast<float>(picture_.width) * (cos_theta_[y] - cos_theta_[y + 1]);
  return (columns[x + 1] - columns[x]) * (rows_[y + 1] - rows_[y]) / solid_angle;
}

Environment load_environment(const EnvironmentOptions& options, std::vector<std::string>& warnings) {
  Image picture = read_image(options.file);
  std::size_t negative = 0;
  float brightest = 0.0f;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    float& value = picture.pixels[i];
    value *= static_cast<float>(options.strength);
    if (!std::isfinite(value)) {
      const std::size_t pixel = i / 3, width = static_cast<std::size_t>(picture.width);
      throw InputError(options.file.string(),
                       fmt::format("the pixel ({}, {}) is not a finite number", pixel % width, pixel / width),
                       "mend the picture, or lower --environment-strength");
    }
    if (value < 0.0f) value = 0.0f, ++negative;
    brightest = std::max(brightest, value);
  }
  if (!(brightest > 0.0f))
    throw InputError(options.file.string(), "the picture is black: it gives no light", "choose another");
  if (negative > 0)
    warnings.push_back(fmt::format("{}: {} negative values, taken for 0", options.file.string(), negative));
  return {std::move(picture), options.rotation};
}

Environment overcast_sky() {
  constexpr int kRows = 256;
  constexpr double kWhiteGround = 1.0, kGroundAlbedo = 0.2;  // luminance [cd/m²], reflectance
  constexpr double kZenith = kWhiteGround * 9.0 / 7.0;       // the sky's illuminance is 7π/9·L_z
  Image picture(1, kRows);
  for (int y = 0; y < kRows; ++y) {
    const double elevation = kPiD * (0.5 - (y + 0.5) / kRows);
    const double l =
        elevation > 0.0 ? kZenith * (1.0 + 2.0 * std::sin(elevation)) / 3.0 : kWhiteGround * kGroundAlbedo;
    std::fill_n(picture.at(0, y), 3, static_cast<float>(l));
  }
  return {std::move(picture), 0.0};
}

}  // namespace photopic
