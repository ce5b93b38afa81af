#include "integrator/tile.h"

#include <algorithm>

#include "spectral/color_difference.h"

namespace photopic {
namespace {

constexpr int kTileSize = 16;

}  // namespace

std::vector<Tile> film_tiles(const Camera& camera) {
  std::vector<Tile> tiles;
  for (int y = 0; y < camera.height; y += kTileSize)
    for (int x = 0; x < camera.width; x += kTileSize)
      tiles.push_back({x, y, std::min(x + kTileSize, camera.width), std::min(y + kTileSize, camera.height)});
  return tiles;
}

std::vector<PathKey> tile_paths(const Tile& tile, int film_width, int first, int last) {
  std::vector<PathKey> paths;
  paths.reserve(static_cast<std::size_t>(tile.pixel_count()) * static_cast<std::size_t>(last - first));
  for (int s = first; s < last; ++s)
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x)
        paths.push_back({static_cast<std::uint32_t>(y * film_width + x), static_cast<std::uint32_t>(s)});
  return paths;
}

double expected_delta_e(const Film& a, const Film& b, const Tile& tile) {
  const Xyz white = d65_white();
  double sum = 0.0;
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; ++x) {
      const auto pixel = static_cast<std::size_t>(y * a.width() + x);
      sum += delta_e_2000(xyz_to_lab(a.mean(pixel), white), xyz_to_lab(b.mean(pixel), white));
    }
  }
  return 0.5 * sum / tile.pixel_count();
}

}  // namespace photopic
