#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include "core/prepared_scene.h"
#include "core/surface_point.h"
#include "integrator/contact.h"

namespace photopic {

/// Solid glasses that a point lies in. Light travels in the one of the highest priority, among equals in the
/// one entered last; all else is hidden (Schmidt & Budge 2002, "Simple nested dielectrics in ray traced
/// images"). So shells within shells need no priorities, and where solids overlap the higher priority says
/// where the interface is. Outside all media the index is 1.
class MediaStack {
 public:
  static constexpr std::uint32_t kCapacity = 8;
  static constexpr std::int32_t kVacuum = -1;

  /// The medium (index of its material, or kVacuum) that light travels in.
  std::int32_t current() const {
    return size_ == 0 ? kVacuum : static_cast<std::int32_t>(materials_[size_ - 1]);
  }
  bool contains(std::uint32_t material) const;

  void enter(std::span<const Surface> surfaces, std::uint32_t material);
  void leave(std::uint32_t material);
  /// Into what lies around all that was entered.
  void surround(std::span<const Surface> surfaces, std::uint32_t material);

  /// Whether there were ever more than kCapacity: then the outermost is forgotten until it is left.
  bool overflowed() const { return overflowed_; }

 private:
  void insert(std::uint32_t at, std::uint32_t material);

  std::array<std::uint32_t, kCapacity> materials_{};  ///< by rising priority, then as they were entered
  std::uint32_t size_ = 0;
  bool overflowed_ = false;
};

/// The media that a path is in, and those beyond the surfaces that it has met.
class PathMedia {
 public:
  static constexpr std::int32_t kVacuum = MediaStack::kVacuum;

  PathMedia() = default;
  explicit PathMedia(const MediaStack& around) : here_(around), beyond_(around) {}

  /// Surfaces in one place that the path meets next; the state is that of before them until they are crossed.
  /// A solid met from within that the path never entered held it all along, outside of what it did enter.
  /// @return what shades: the contact's screen, or the face that is the interface between the media on both
  /// sides; where there are two, that of the higher priority, among equals the rougher
  const Contact::Face& meet(std::span<const Surface> surfaces, const Contact& contact);
  /// A surface that nothing touches: of a solid,
  void meet(std::span<const Surface> surfaces, Boundary alone);
  /// or one that bounds no medium.
  void meet_screen() {
    if (in_the_open_) return;
    believed_ = here_.current(), beyond_ = here_;
    outside_ = here_.current(), front_ = back_ = 0.0f;
    from_inside_ = hidden_ = false;
    in_the_open_ = here_.current() == kVacuum;
  }
  /// Whether the path is outside all media and what it met last bounds none: to meet a screen changes
  /// nothing.
  bool in_the_open() const { return in_the_open_; }

  /// Whether the path goes on through what it met as if there were nothing, which emits nothing either: the
  /// same medium lies on both sides.
  bool hidden() const { return hidden_; }

  /// The medium (index of its material, or kVacuum) that light travels in.
  std::int32_t current() const { return here_.current(); }
  /// What light was taken to travel in before a solid was left that had not been entered; else current(). A
  /// path that has crossed nothing began in that solid.
  std::int32_t believed() const { return believed_; }
  /// The medium in front of the solid that shades, whose own lies behind it; of a screen that on either side.
  std::int32_t outside() const { return outside_; }
  /// The medium on the front of what shades, or on its back.
  std::int32_t on_side(bool inside) const {
    return inside == from_inside_ ? here_.current() : beyond_.current();
  }

  /// On to the front of what shades, or to its back.
  void go_on(bool inside) {
    if (inside != from_inside_) cross();
  }
  /// To the other side; on_side() still knows both.
  void cross() {
    std::swap(here_, beyond_);
    from_inside_ = !from_inside_, crossed_ = true;
    in_the_open_ = false;  // until a screen is met
  }

  /// Whether anything lies in the place of what was met.
  bool is_thick() const { return front_ != 0.0f || back_ != 0.0f; }
  /// Makes a point of what shades so thick that rays leave it beyond all that lies in its place.
  void widen(SurfacePoint& point) const {
    if (!is_thick()) return;
    point.position = point.position + point.geometric_normal * (0.5f * (front_ - back_));
    point.error = 0.5f * (front_ + back_);
  }

  /// Whether there were more media at once, or more surfaces in one place, than are kept.
  bool overflowed() const { return overflowed_ || here_.overflowed(); }
  /// Whether the path left a solid that it had not entered.
  bool slipped() const { return slipped_; }

 private:
  void look_out(std::span<const Surface> surfaces, std::uint32_t material);
  void look_in(std::span<const Surface> surfaces, std::uint32_t material) {
    beyond_.enter(surfaces, material);
  }
  const Contact::Face& interface(std::span<const Surface> surfaces, const Contact& contact) const;
  void see(const Contact::Face& face, const Contact& contact);

  bool in_the_open_ = false, hidden_ = false, from_inside_ = false, crossed_ = false, overflowed_ = false,
       slipped_ = false;
  std::int32_t outside_ = kVacuum, believed_ = kVacuum;
  float front_ = 0, back_ = 0;  ///< how far the place reaches there [m]; 0: no further than rounding
  MediaStack here_, beyond_;
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

/// Whether what a ray hit bounds no medium, and nothing touches it there.
inline bool is_lone_screen(const PreparedScene& scene, const Hit& hit) {
  return !scene.shapes[hit.shape].encloses && !touches(scene, hit);
}

/// Whether it is a lamp that may lie hidden in glass: one of glass itself.
inline bool is_hideable(const ShapeTraits& shape) {
  return shape.emits && shape.encloses;
}

/// PathMedia::meet with all that lies where a ray hits something. @param hit becomes one of what shades
void meet_place(PathMedia& media, const PreparedScene& scene, Hit& hit, Vec3f direction);
inline void meet(PathMedia& media, const PreparedScene& scene, Hit& hit, Vec3f direction) {
  if (is_lone_screen(scene, hit))
    media.meet_screen();
  else
    meet_place(media, scene, hit, direction);
}

/// Where a path took itself to be in another medium than it was, it slipped in somewhere unrefracted: what
/// stays the same is radiance over the index squared.
template <int N>
void mend(SampledSpectrum<N>& throughput, const PreparedScene& scene, const PathMedia& media,
          SampledSpectrum<N> lambda) {
  if (media.believed() == media.current()) return;
  const Surface *from = surface_of(scene, media.believed()), *to = surface_of(scene, media.current());
  for (int j = 0; j < N; ++j) {
    const float ratio = (from ? from->index(lambda[j]) : 1.0f) / (to ? to->index(lambda[j]) : 1.0f);
    throughput.set(j, throughput[j] * sqr(ratio));
  }
}

/// Where the ray goes on that crosses a hidden surface.
Vec3f pass_hidden(PathMedia& media, const PreparedScene& scene, const Hit& hit, Vec3f direction);

/// More surfaces than any path passes unseen: rounding must not hold a ray for ever.
inline constexpr int kMostHidden = 1 << 14;

}  // namespace photopic
