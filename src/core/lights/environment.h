#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/image_io.h"
#include "core/lights/grid_densities.h"
#include "core/math.h"

namespace photopic {

/// Light from infinitely far, all around: a picture in latitude and longitude, its upper edge in direction
/// +y, its middle in −z (where glTF's cameras look), +x right of it. Pixels are interpolated bilinearly. To
/// draw a direction one of the picture's tiles is chosen, by what is likely to be seen of it (SkyViews), then
/// one of its pixels, in proportion to their mean luminances.
class Environment {
 public:
  /// @param picture linear sRGB, luminances in cd/m²; finite, not negative, not all black
  /// @param rotation about +y, counter-clockwise seen from above [degrees]
  Environment(Image picture, double rotation);

  /// Linear sRGB [cd/m²] in a unit direction.
  Vec3f radiance(Vec3f direction) const { return interpolate(direction); }
  Vec3Lanes radiance(const Vec3Lanes& direction) const { return interpolate(direction); }

  /// Tiles that are as wide as high, 11°, about the horizon.
  static constexpr std::int32_t kTileRows = 16, kTileColumns = 32;

  // T: float or Lanes.

  template <typename T>
  struct Sample {
    Vec3<T> direction;  ///< unit
    T pdf;              ///< [1/sr]
  };
  /// Within a tile. @return the density is that on the tile
  template <typename T>
  Sample<T> sample_tile(IndexOf<T> x, IndexOf<T> y, BasicSample2d<T> u) const;

  /// The tile a direction lies in, and sample_tile's density there [1/sr].
  struct Place {
    std::int32_t x, y;
    float pdf;
  };
  Place place_of(Vec3f direction) const;

  /// ∫ L dω over each tile's directions, row by row [lx], and over all.
  const std::vector<double>& tile_fluxes() const { return tile_fluxes_; }
  double flux_density() const { return flux_density_; }

  int emission_spectrum = -1;  ///< index into Scene::emission_spectra, of what the colours tint

 private:
  template <typename T>
  struct Position {
    T x, y;  ///< from the upper left corner, the picture's width and height being 1
  };
  template <typename T>
  Position<T> position_of(Vec3<T> direction) const;
  template <typename T>
  Vec3<T> interpolate(Vec3<T> direction) const;
  double solid_angle(std::int32_t row) const;
  void add_tiles(std::int32_t y);
  void fill_fluxes(std::int32_t row, std::span<double> fluxes) const;
  template <typename I>
  GridDensities::Grid<I> tile(I x, I y) const;

  Image picture_;
  float cos_rotation_, sin_rotation_;
  /// The density is constant on cells: pixels, or equal parts of them where there are fewer than tiles.
  std::int32_t rows_, columns_;
  std::vector<float> cos_theta_;                        ///< of the rows' edges, rows + 1
  std::vector<float> solid_angle_;                      ///< of a cell in each row [sr]
  std::vector<std::int32_t> row_edges_, column_edges_;  ///< of the tiles [cells]
  GridDensities cells_;                                 ///< in each tile
  std::vector<std::int32_t> tiles_;                     ///< the grid of each, row by row
  std::vector<double> tile_fluxes_;
  double flux_density_ = 0.0;
};

struct EnvironmentOptions {
  std::filesystem::path file;  ///< .exr or .hdr (or any picture); empty: none
  double rotation = 0.0;       ///< [degrees]
  double strength = 1.0;       ///< factor on the luminances
};

/// @param warnings tells of what was mended: negative values become 0
/// @throws InputError when there is no such picture, or it holds no light, or values that are not finite
Environment load_environment(const EnvironmentOptions& options, std::vector<std::string>& warnings);

/// The CIE standard overcast sky (CIE S 011:2003, type 16: L = L_z (1 + 2 sin γ)/3 at elevation γ) over a
/// ground that reflects a fifth; so bright that a white diffuse ground has 1 cd/m².
Environment overcast_sky();

}  // namespace photopic
