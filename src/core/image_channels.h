#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/image_io.h"

namespace photopic {

/// Which of an image's channels are its colours; of a grey one all three are the same.
struct ColorChannels {
  std::array<std::size_t, 3> index;
  ColorSpace space = ColorSpace::linear_srgb;
};

/// Channels R, G, B (in either case); else X, Y, Z; else those of the one layer whose name ends in
/// "Combined", as Blender calls what it rendered; else those of the only layer that has R, G, B; else Y,
/// where there is but alpha besides. Nothing where none of these are.
std::optional<ColorChannels> find_color_channels(const std::vector<std::string>& names);

/// The first of the names, and how many more there are.
std::string list_channels(const std::vector<std::string>& names);

}  // namespace photopic
