#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/prepared_scene.h"

namespace photopic {

/// The media that a path is in: solid glasses that it entered and did not leave. Light travels in the one of
/// the highest priority, among equals in the one entered last; all else is hidden (Schmidt & Budge 2002,
/// "Simple nested dielectrics in ray traced images"). So shells within shells need no priorities, and where
/// solids overlap the higher priority says where the interface is. Outside all media the index is 1.
class PathMedia {
 public:
  static constexpr std::uint32_t kCapacity = 8;
  static constexpr std::int32_t kVacuum = -1;

  /// A surface that the path meets next; the state is that of before it until it is crossed. Glass met from
  /// within that the path never entered held it all along, outside of what it did enter.
  /// @param surfaces of the scene's materials @param from_inside whether the path comes from the back
  void meet(std::span<const Surface> surfaces, std::uint32_t material, bool from_inside);

  /// Whether the path goes on through the surface that it met as if there were none: the same medium lies on
  /// both sides.
  bool hidden() const { return hidden_; }

  /// The medium (index of its material, or kVacuum) that light travels in.
  std::int32_t current() const {
    return size_ == 0 ? kVacuum : static_cast<std::int32_t>(materials_[size_ - 1]);
  }
  /// The medium in front of the surface that was met, which is not hidden; the glass itself lies behind it.
  std::int32_t outside() const { return outside_; }
  /// The medium on the surface's front, or on its back.
  std::int32_t on_side(bool inside) const {
    if (!encloses_ || inside == from_inside_) return current();
    return inside ? static_cast<std::int32_t>(met_) : outside_;
  }

  /// On to the front of the surface that was met, or to its back.
  void go_on(std::span<const Surface> surfaces, bool inside) {
    if (inside != from_inside_) cross(surfaces);
  }
  /// To the other side.
  void cross(std::span<const Surface> surfaces);

  /// Into a medium, whatever was met.
  void enter(std::span<const Surface> surfaces, std::uint32_t material);

  /// Whether there were ever more than kCapacity: then the outermost is forgotten until it is left.
  bool overflowed() const { return overflowed_; }

 private:
  bool contains(std::uint32_t material) const;
  void insert(std::uint32_t at, std::uint32_t material);
  void leave(std::uint32_t material);

  std::array<std::uint32_t, kCapacity> materials_{};  ///< by rising priority, then as they were entered
  std::uint32_t size_ = 0;
  std::uint32_t met_ = 0;
  std::int32_t outside_ = kVacuum;
  bool encloses_ = false, from_inside_ = false, hidden_ = false, overflowed_ = false;
};

/// Whether a path can be in a medium at all.
bool has_media(const PreparedScene& scene);

/// The media around a point, found along one ray upwards: those that it leaves more often than it enters.
PathMedia media_at(const PreparedScene& scene, Vec3f point);

/// The surface that bounds a medium, or null.
inline const Surface* surface_of(const PreparedScene& scene, std::int32_t medium) {
  return medium == PathMedia::kVacuum ? nullptr : &scene.surfaces[static_cast<std::size_t>(medium)];
}

/// Beer's law along a ray. @param distance [m], may be infinite
template <int N>
void attenuate(SampledSpectrum<N>& radiance, const PreparedScene& scene, std::int32_t medium,
               SampledSpectrum<N> lambda, float distance) {
  if (const Surface* glass = surface_of(scene, medium); glass && glass->absorbs())
    radiance *= glass->transmittance(lambda, distance);
}

/// PathMedia::meet with what a ray hits.
void meet(PathMedia& media, const PreparedScene& scene, const Hit& hit, Vec3f direction);

/// Where the ray goes on that crosses a hidden surface.
Vec3f pass_hidden(PathMedia& media, const PreparedScene& scene, const Hit& hit, Vec3f direction);

/// More surfaces than any path passes unseen: rounding must not hold a ray for ever.
inline constexpr int kMostHidden = 1 << 14;

}  // namespace photopic
