#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/lights/environment.h"
#include "core/lights/light.h"
#include "core/lights/sky.h"

namespace photopic {

/// What the places of a scene see of its sky, so that light is looked for where it comes from: through a
/// window, past a house, above the horizon of a surface. It is learned from some places before the render;
/// planes in position and normal part them from each other. (Atanasov et al. 2018, "Adaptive Environment
/// Sampling on CPU and GPU", keep what is seen in a grid about the camera.)
class SkyViews {
 public:
  /// What a place sees of a part of the sky: the cosine to the normal, 0 where something is in the way.
  struct Glimpse {
    std::uint32_t source;  ///< a tile, or tiles() + a directional light
    float seen;
  };
  /// Fills in what a place sees.
  using Survey = std::function<void(std::size_t place, std::span<Glimpse> glimpses)>;

  SkyViews() = default;
  /// @param places as densely as paths visit them; none: all is seen from everywhere
  SkyViews(const Sky& sky, std::span<const LightReference> places, const Survey& survey);

  bool empty() const { return lights_.empty(); }
  /// Whether there are several.
  bool differ() const { return levels_ > 0; }

  // T: float or Lanes.

  /// The number of the view that a place has.
  template <typename T>
  IndexOf<T> view_at(const BasicLightReference<T>& at) const;

  /// A direction to the environment.
  template <typename T>
  Environment::Sample<T> sample(const Environment& environment, IndexOf<T> view, BasicSample2d<T> u) const;
  float pdf(const Environment& environment, std::int32_t view,
            Vec3f direction) const;  ///< of sample() [1/sr]

  /// What arrives, as the root mean square over the view's places [lx].
  struct Light {
    double environment = 0.0, directional = 0.0;
    bool any = false;  ///< was seen
  };
  const std::vector<Light>& lights() const { return lights_; }  ///< of each view

 private:
  class Builder;

  /// Position and normal.
  template <typename T>
  using Key = std::array<T, 6>;
  template <typename T>
  static Key<T> key_of(const BasicLightReference<T>& place) {
    return {place.position.x, place.position.y, place.position.z,
            place.normal.x,   place.normal.y,   place.normal.z};
  }
  template <typename I>
  static GridDensities::Grid<I> grid_of(I view);

  // Planes that part places, the first of all: of each the axis of the key, what parts it, and the planes to
  // go on with below and above; leaves lead to themselves and have a view.
  std::vector<std::int32_t> axis_;
  std::vector<float> split_;
  std::vector<std::int32_t> below_, above_, view_;
  std::int32_t levels_ = 0;
  GridDensities tiles_;        ///< a grid for each view
  std::vector<Light> lights_;  ///< of each view
};

}  // namespace photopic
