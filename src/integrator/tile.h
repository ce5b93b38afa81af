#pragma once

#include <optional>
#include <vector>

#include "core/film.h"
#include "integrator/path_start.h"

namespace photopic {

/// That one thread renders at a time.
using Tile = PixelWindow;

/// Cover the window, row by row: the whole film's tiles, so far as they lie in it.
std::vector<Tile> film_tiles(const PixelWindow& window);

/// A tile's paths with samples first … last − 1: a pixel's side by side, pixels in small blocks, so that
/// neighbours in a batch look at nearly the same thing.
std::vector<PathKey> tile_paths(const Tile& tile, int film_width, int first, int last);

/// The mean ΔE (CIEDE2000) to be expected between all samples of two films and the truth, over
/// a tile's pixels that have samples in both. The films' estimates are independent: of m and n samples they
/// are √(1/m + 1/n) apart, in units in which all are √(1/(m + n)) from the truth.
/// @param white D65 (Y = 1) as the films' observer sees it @return nothing where no pixel has samples in both
std::optional<double> expected_delta_e(const Film& a, const Film& b, const Tile& tile, Xyz white);

/// The same over tiles; nothing where one of them has nothing.
std::optional<double> expected_delta_e(const Film& a, const Film& b, const std::vector<Tile>& tiles,
                                       Xyz white);

}  // namespace photopic
