#include "core/lights/sky_views.h"

namespace photopic {
namespace {

/// One of the numbers of each lane.
float choose(const std::array<float, 6>& key, std::int32_t axis) {
  return key[static_cast<std::size_t>(axis)];
}
Lanes choose(const std::array<Lanes, 6>& key, IntLanes axis) {
  return gather(reinterpret_cast<const float*>(key.data()),
                axis * kLanes + reinterpret_cast<IntLanes>(kLaneNumbers));
}

}  // namespace

template <typename T>
IndexOf<T> SkyViews::view_at(const BasicLightReference<T>& at) const {
  using I = IndexOf<T>;
  const Key<T> key = key_of(at);
  I node{};
  for (std::int32_t level = 0; level < levels_; ++level) {
    const T value = choose(key, gather(axis_.data(), node));
    node = select(value >= gather(split_.data(), node), gather(above_.data(), node),
                  gather(below_.data(), node));
  }
  return gather(view_.data(), node);
}
template std::int32_t SkyViews::view_at(const LightReference&) const;
template IntLanes SkyViews::view_at(const BasicLightReference<Lanes>&) const;

template <typename I>
GridDensities::Grid<I> SkyViews::grid_of(I view) {
  constexpr std::int32_t width = Environment::kTileColumns, height = Environment::kTileRows;
  return {view * GridDensities::size_of(width, height), I{} + width, I{} + height};
}

template <typename T>
Environment::Sample<T> SkyViews::sample(const Environment& environment, IndexOf<T> view,
                                        BasicSample2d<T> u) const {
  const auto tile = tiles_.sample<T>(grid_of(view), u);
  Environment::Sample<T> way = environment.sample_tile<T>(tile.x, tile.y, tile.part);
  way.pdf *= tile.probability;
  return way;
}
template Environment::Sample<float> SkyViews::sample(const Environment&, std::int32_t, Sample2d) const;
template Environment::Sample<Lanes> SkyViews::sample(const Environment&, IntLanes, Sample2dLanes) const;

float SkyViews::pdf(const Environment& environment, std::int32_t view, Vec3f direction) const {
  const Environment::Place place = environment.place_of(direction);
  return place.pdf * tiles_.probability<float>(grid_of(view), place.x, place.y);
}

}  // namespace photopic
