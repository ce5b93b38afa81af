#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/image_io.h"
#include "core/math.h"
#include "core/sample_sequence.h"

namespace photopic {

/// Light from infinitely far, all around: a picture in latitude and longitude, its upper edge in direction
/// +y, its middle in −z (where glTF's cameras look), +x right of it. Pixels are interpolated bilinearly;
/// directions are drawn from a density that is constant on each pixel, proportional to its mean luminance.
class Environment {
 public:
  /// @param picture linear sRGB, luminances in cd/m²; finite, not negative, not all black
  /// @param rotation about +y, counter-clockwise seen from above [degrees]
  Environment(Image picture, double rotation);

  /// Linear sRGB [cd/m²] in a unit direction.
  Vec3f radiance(Vec3f direction) const;

  struct Sample {
    Vec3f direction;  ///< unit
    float pdf;        ///< [1/sr]
  };
  Sample sample(Sample2d u) const;
  float pdf(Vec3f direction) const;  ///< of sample() [1/sr]

  /// ∫ L dω over all directions [lm/m²]
  double flux_density() const { return flux_density_; }

  int emission_spectrum = -1;  ///< index into Scene::emission_spectra, of what the colours tint

 private:
  struct Position {
    float x, y;  ///< in pixels from the upper left corner
  };
  Position position_of(Vec3f direction) const;
  const float* row(int y) const { return &columns_[static_cast<std::size_t>(y) * (width() + 1)]; }
  std::size_t width() const { return static_cast<std::size_t>(picture_.width); }

  Image picture_;
  float cos_rotation_, sin_rotation_;
  std::vector<float> rows_;       ///< cumulative probability of the rows, height + 1 of them
  std::vector<float> columns_;    ///< of the columns within each row, width + 1 for each
  std::vector<float> cos_theta_;  ///< of the rows' edges, height + 1
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
