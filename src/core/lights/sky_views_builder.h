#pragma once

#include "core/lights/sky_views.h"

namespace photopic {

/// Learns views from what places see.
class SkyViews::Builder {
 public:
  Builder(SkyViews& views, const Sky& sky, std::span<const LightReference> places, const Survey& survey);

 private:
  /// Mean squares of what is seen of each part of the sky.
  using Squares = std::vector<double>;
  struct Split {
    std::size_t axis = 0;
    float at = 0.0f;
    double gain = 0.0;  ///< [lx]
  };

  struct Sums {
    struct Sum {
      float square = 0.0f, count = 0.0f;
    };
    std::vector<Sum> of;  ///< each part of the sky
    void add(std::span<const Glimpse> glimpses);
    Squares means(const Squares& prior) const;
  };

  void look_around(std::size_t place, std::span<const double> ends, const Survey& survey);
  std::int32_t build(std::span<std::uint32_t> places, const Squares& prior, std::int32_t level);
  Sums sums_of(std::span<const std::uint32_t> places) const;
  double light(const Squares& squares, std::size_t source) const;
  Split best_split(std::span<const std::uint32_t> places, const Sums& sums, const Squares& prior) const;
  float middle(std::span<const std::uint32_t> places, std::size_t axis) const;
  std::int32_t add_view(std::span<const std::uint32_t> places, const Squares& squares);

  SkyViews& views_;
  const Sky& sky_;
  std::vector<double> fluxes_;
  std::vector<Key<float>> keys_;                ///< of the places
  std::vector<std::vector<Glimpse>> glimpses_;  ///< of the places
};

}  // namespace photopic
