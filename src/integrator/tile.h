#pragma once

#include <optional>
#include <vector>

#include "core/camera.h"
#include "core/film.h"
#include "integrator/path_start.h"

namespace photopic {

/// A rectangle of pixels that one thread renders at a time.
struct Tile {
  int x0, y0, x1, y1;  ///< [pixels]; the upper bounds lie outside
  int pixel_count() const { return (x1 - x0) * (y1 - y0); }
};

/// Cover the film, row by row.
std::vector<Tile> film_tiles(const Camera& camera);

/// A tile's paths with samples first … last − 1: a pixel's side by side, pixels in small blocks, so that
/// neighbours in a batch look at nearly the same thing.
std::vector<PathKey> tile_paths(const Tile& tile, int film_width, int first, int last);

/// The mean ΔE (CIEDE2000, D65 at Y = 1) to be expected between all samples of two films and the truth, over
/// a tile's pixels that have samples in both. The films' estimates are independent: of m and n samples they
/// are √(1/m + 1/n) apart, in units in which all are √(1/(m + n)) from the truth.
/// @return nothing where no pixel has samples in both
std::optional<double> expected_delta_e(const Film& a, const Film& b, const Tile& tile);

/// The same over tiles; nothing where one of them has nothing.
std::optional<double> expected_delta_e(const Film& a, const Film& b, const std::vector<Tile>& tiles);

}  // namespace photopic
