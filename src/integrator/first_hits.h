#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "core/film.h"
#include "core/prepared_scene.h"
#include "core/sample_sequence.h"

namespace photopic {

/// A pixel's samples that first_hits() looks at, at most.
inline constexpr std::uint64_t kMostFirstHits = 64;

/// What the camera's rays meet first, be it glass or a mirror: means over a pixel's samples, for denoisers
/// and compositors. 0 where they meet nothing.
struct FirstHits {
  /// Linear sRGB reflectance under D65, in [0, 1]: a material's base colour, of a metal of measured index its
  /// reflectance at normal incidence. Rays that meet nothing count as black.
  Image albedo;
  /// The shading normal, in world space and towards the viewer. A mean of unit vectors and zeros: shorter
  /// than 1 where they differ.
  Image normal;
  /// Along the camera's axis [m], of the rays that meet something.
  std::vector<float> depth;
  /// The share of rays that meet something.
  std::vector<float> alpha;
};

/// Traces camera rays of a render's samples again, the first kMostFirstHits of each pixel at most.
/// @param film the render's, which knows the pixels' numbers of samples @param sequence, seed the render's
/// @param hurry once it is set, one sample of each pixel must do
FirstHits first_hits(const PreparedScene& scene, const Film& film, Sequence sequence, std::uint32_t seed,
                     const std::atomic<bool>& hurry);

}  // namespace photopic
