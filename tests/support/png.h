#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace photopic::test {

/// PNG's colour types (ISO/IEC 15948, table 11.1).
enum class PngColor : std::uint8_t { grey = 0, rgb = 2, palette = 3, grey_alpha = 4, rgba = 6 };

/// A PNG file, not compressed. @param samples row by row, `depth` (8 or 16) bits each
/// @param palette triples, for palettes
std::string make_png(int width, int height, PngColor color, const std::vector<int>& samples, int depth = 8,
                     const std::vector<int>& palette = {});

}  // namespace photopic::test
