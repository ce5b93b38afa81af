#include "core/lights/environment.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/sampling.h"
#include "error.h"
#include "spectral/color.h"

namespace photopic {
namespace {

constexpr double kPiD = std::numbers::pi;

double luminance(const float* pixel) {
  return linear_srgb_to_xyz({pixel[0], pixel[1], pixel[2]}).y;
}

/// What is indexed by 32 bits.
constexpr std::size_t kMostNumbers = std::numeric_limits<std::int32_t>::max();

/// Bilinear interpolation's mean over a pixel weighs it and its neighbours by 1/8, 3/4, 1/8 along each axis.
constexpr std::array<double, 3> kPixelMean = {0.125, 0.75, 0.125};

/// As many cells as pixels, or a multiple, so that there is one for each tile.
std::int32_t cells(int pixels, std::int32_t tiles) {
  return pixels * ((tiles + pixels - 1) / pixels);
}

/// Edges of equal parts of whole cells.
std::vector<std::int32_t> edges(std::int32_t cells, std::int32_t parts) {
  std::vector<std::int32_t> result;
  for (std::int32_t i = 0; i <= parts; ++i)
    result.push_back(static_cast<std::int32_t>(static_cast<std::int64_t>(i) * cells / parts));
  return result;
}

/// The part in which a cell lies.
std::int32_t part_of(std::int32_t cell, const std::vector<std::int32_t>& edges) {
  return static_cast<std::int32_t>(std::ranges::upper_bound(edges, cell) - edges.begin()) - 1;
}

}  // namespace

Environment::Environment(Image picture, double rotation)
    : picture_(std::move(picture)),
      cos_rotation_(static_cast<float>(std::cos(rotation * kPiD / 180.0))),
      sin_rotation_(static_cast<float>(std::sin(rotation * kPiD / 180.0))),
      rows_(cells(picture_.height, kTileRows)),
      columns_(cells(picture_.width, kTileColumns)),
      row_edges_(edges(rows_, kTileRows)),
      column_edges_(edges(columns_, kTileColumns)) {
  for (std::int32_t y = 0; y <= rows_; ++y) {
    cos_theta_.push_back(static_cast<float>(std::cos(kPiD * y / rows_)));
    solid_angle_.push_back(static_cast<float>(solid_angle(y)));
  }
  for (std::int32_t y = 0; y < kTileRows; ++y) add_tiles(y);
  flux_density_ = std::accumulate(tile_fluxes_.begin(), tile_fluxes_.end(), 0.0);
}

/// Of a cell in a row [sr]: 2π/columns times the difference of its edges' cosines.
double Environment::solid_angle(std::int32_t row) const {
  const double step = kPiD / rows_;
  return 4.0 * kPiD / columns_ * std::sin(step * (row + 0.5)) * std::sin(0.5 * step);
}

/// A row of them.
void Environment::add_tiles(std::int32_t y) {
  const std::int32_t *edge = &row_edges_[static_cast<std::size_t>(y)], first = edge[0], last = edge[1];
  const auto width = static_cast<std::size_t>(columns_);
  std::vector<double> fluxes(static_cast<std::size_t>(last - first) * width), of_tile;
  tbb::parallel_for(first, last, [&](std::int32_t row) {
    fill_fluxes(row, std::span(fluxes).subspan(static_cast<std::size_t>(row - first) * width, width));
  });
  for (std::size_t x = 0; x < kTileColumns; ++x) {
    const std::int32_t low = column_edges_[x], high = column_edges_[x + 1];
    of_tile.clear();
    for (auto row = fluxes.begin(); row != fluxes.end(); row += columns_)
      of_tile.insert(of_tile.end(), row + low, row + high);
    tiles_.push_back(cells_.add(of_tile, static_cast<std::size_t>(high - low)));
    tile_fluxes_.push_back(std::accumulate(of_tile.begin(), of_tile.end(), 0.0));
  }
}

/// ∫ L dω over each cell of a row, L being its pixel's mean.
void Environment::fill_fluxes(std::int32_t row, std::span<double> fluxes) const {
  const int width = picture_.width, height = picture_.height, y = row / (rows_ / height);
  // Mean luminance over the pixels' height, for each column; then along the row.
  std::vector<double> means(static_cast<std::size_t>(width));
  for (int dy = -1; dy <= 1; ++dy)
    for (int x = 0; x < width; ++x)
      means[static_cast<std::size_t>(x)] += kPixelMean[static_cast<std::size_t>(dy + 1)] *
                                            luminance(picture_.at(x, std::clamp(y + dy, 0, height - 1)));
  const auto mean = [&](int x) { return means[static_cast<std::size_t>((x + width) % width)]; };
  for (std::size_t cell = 0; cell < fluxes.size(); ++cell) {
    const int x = static_cast<int>(cell) / (columns_ / width);
    fluxes[cell] = solid_angle(row) *
                   (kPixelMean[0] * mean(x - 1) + kPixelMean[1] * mean(x) + kPixelMean[2] * mean(x + 1));
  }
}

template <typename T>
Environment::Position<T> Environment::position_of(Vec3<T> direction) const {
  // Into the picture's own directions: turned back about +y.
  const T right = direction.x * cos_rotation_ - direction.z * sin_rotation_;
  const T back = direction.x * sin_rotation_ + direction.z * cos_rotation_;
  const T phi = copysign(angle_above(abs(right), -back), right);
  const T theta = angle_above(sqrt(right * right + back * back), direction.y);
  return {phi * (0.5f * kInvPi) + 0.5f, theta * kInvPi};
}

template <typename T>
Vec3<T> Environment::interpolate(Vec3<T> direction) const {
  using I = IndexOf<T>;
  const Position<T> p = position_of(direction);
  const std::int32_t w = picture_.width, h = picture_.height;
  const T px = p.x * static_cast<float>(w) - 0.5f, py = p.y * static_cast<float>(h) - 0.5f;
  const T fx = floor(px), fy = floor(py), tx = px - fx, ty = py - fy;
  // What is no direction finds some pixel, too.
  const auto clamp = [](I i, std::int32_t count) {
    return select(i < 0, I{}, select(i >= count, I{} + (count - 1), i));
  };
  const auto wrap = [&](I x) { return clamp(select(x < 0, x + w, select(x >= w, x - w, x)), w); };
  const I x0 = wrap(to_int(fx)), x1 = wrap(x0 + 1), y0 = clamp(to_int(fy), h), y1 = clamp(to_int(fy) + 1, h);
  const auto pixel = [&](I x, I y) {
    const I i = 3 * (y * w + x);
    const float* rgb = picture_.pixels.data();
    return Vec3<T>{gather(rgb, i), gather(rgb, i + 1), gather(rgb, i + 2)};
  };
  return (pixel(x0, y0) * (1.0f - tx) + pixel(x1, y0) * tx) * (1.0f - ty) +
         (pixel(x0, y1) * (1.0f - tx) + pixel(x1, y1) * tx) * ty;
}

template <typename I>
GridDensities::Grid<I> Environment::tile(I x, I y) const {
  const std::int32_t *columns = column_edges_.data(), *rows = row_edges_.data();
  return {gather(tiles_.data(), y * kTileColumns + x), gather(columns, x + 1) - gather(columns, x),
          gather(rows, y + 1) - gather(rows, y)};
}

template <typename T>
Environment::Sample<T> Environment::sample_tile(IndexOf<T> tile_x, IndexOf<T> tile_y,
                                                BasicSample2d<T> u) const {
  const auto cell = cells_.sample<T>(tile(tile_x, tile_y), u);
  const IndexOf<T> x = gather(column_edges_.data(), tile_x) + cell.x,
                   y = gather(row_edges_.data(), tile_y) + cell.y;
  const T top = gather(cos_theta_.data(), y), bottom = gather(cos_theta_.data(), y + 1);
  const T cos_theta = top + (bottom - top) * cell.part.y, sin_theta = safe_sqrt(1.0f - sqr(cos_theta));
  const float columns = static_cast<float>(columns_);
  const auto phi = sin_cos_two_pi((to_float(x) + cell.part.x) / columns);  // half a turn on
  const T right = -sin_theta * phi.sin, back = sin_theta * phi.cos;
  return {
      {right * cos_rotation_ + back * sin_rotation_, cos_theta, back * cos_rotation_ - right * sin_rotation_},
      cell.probability / gather(solid_angle_.data(), y)};
}

Environment::Place Environment::place_of(Vec3f direction) const {
  const Position<float> p = position_of(direction);
  const std::int32_t x = std::clamp(to_int(p.x * static_cast<float>(columns_)), 0, columns_ - 1),
                     y = std::clamp(to_int(p.y * static_cast<float>(rows_)), 0, rows_ - 1);
  const std::int32_t tile_x = part_of(x, column_edges_), tile_y = part_of(y, row_edges_);
  const float probability =
      cells_.probability<float>(tile(tile_x, tile_y), x - column_edges_[static_cast<std::size_t>(tile_x)],
                                y - row_edges_[static_cast<std::size_t>(tile_y)]);
  return {tile_x, tile_y, probability / solid_angle_[static_cast<std::size_t>(y)]};
}

template Vec3f Environment::interpolate(Vec3f) const;
template Vec3Lanes Environment::interpolate(Vec3Lanes) const;
template Environment::Sample<float> Environment::sample_tile(std::int32_t, std::int32_t, Sample2d) const;
template Environment::Sample<Lanes> Environment::sample_tile(IntLanes, IntLanes, Sample2dLanes) const;

Environment load_environment(const EnvironmentOptions& options, std::vector<std::string>& warnings) {
  Image picture = read_image(options.file);
  if (picture.pixels.size() > kMostNumbers)
    throw InputError(
        options.file.string(),
        fmt::format("{} × {} pixels are more than an environment may have", picture.width, picture.height),
        "make it smaller: 16384 × 8192 are enough for any");
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
