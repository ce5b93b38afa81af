#include "integrator/tile.h"

#include <algorithm>
#include <cmath>

#include "spectral/color_difference.h"

namespace photopic {
namespace {

constexpr int kTileSize = 16;
constexpr int kBlockSize = 4;

}  // namespace

std::vector<Tile> film_tiles(const PixelWindow& window) {
  const auto first = [](int side) { return side / kTileSize * kTileSize; };
  std::vector<Tile> tiles;
  for (int y = first(window.y0); y < window.y1; y += kTileSize)
    for (int x = first(window.x0); x < window.x1; x += kTileSize)
      tiles.push_back({std::max(x, window.x0), std::max(y, window.y0), std::min(x + kTileSize, window.x1),
                       std::min(y + kTileSize, window.y1)});
  return tiles;
}

std::vector<PathKey> tile_paths(const Tile& tile, int film_width, int first, int last) {
  std::vector<PathKey> paths;
  paths.reserve(static_cast<std::size_t>(tile.pixel_count()) * static_cast<std::size_t>(last - first));
  const auto add_pixel = [&](int x, int y) {
    for (int s = first; s < last; ++s)
      paths.push_back({static_cast<std::uint32_t>(y * film_width + x), static_cast<std::uint32_t>(s)});
  };
  for (int y0 = tile.y0; y0 < tile.y1; y0 += kBlockSize)
    for (int x0 = tile.x0; x0 < tile.x1; x0 += kBlockSize)
      for (int y = y0; y < std::min(y0 + kBlockSize, tile.y1); ++y)
        for (int x = x0; x < std::min(x0 + kBlockSize, tile.x1); ++x) add_pixel(x, y);
  return paths;
}

std::optional<double> expected_delta_e(const Film& a, const Film& b, const Tile& tile, Xyz white) {
  double sum = 0.0;
  int known = 0;
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; ++x) {
      const auto pixel = static_cast<std::size_t>(y * a.width() + x);
      const auto m = static_cast<double>(a.count(pixel)), n = static_cast<double>(b.count(pixel));
      if (m == 0.0 || n == 0.0) continue;
      ++known;
      sum += std::sqrt(m * n) / (m + n) *
             delta_e_2000(xyz_to_lab(a.mean(pixel), white), xyz_to_lab(b.mean(pixel), white));
    }
  }
  if (known == 0) return std::nullopt;
  return sum / known;
}

std::optional<double> expected_delta_e(const Film& a, const Film& b, const std::vector<Tile>& tiles,
                                       Xyz white) {
  double sum = 0.0;
  int pixels = 0;
  for (const Tile& tile : tiles) {
    const auto error = expected_delta_e(a, b, tile, white);
    if (!error) return std::nullopt;
    sum += *error * tile.pixel_count();
    pixels += tile.pixel_count();
  }
  return sum / pixels;
}

}  // namespace photopic
