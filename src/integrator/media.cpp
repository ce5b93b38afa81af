#include "integrator/media.h"

#include <algorithm>
#include <tuple>
#include <vector>

namespace photopic {
namespace {

/// Removes the last that is equal. @return whether there was one
bool take_last(std::vector<std::uint32_t>& list, std::uint32_t value) {
  for (std::size_t i = list.size(); i-- > 0;)
    if (list[i] == value) {
      list.erase(list.begin() + static_cast<std::ptrdiff_t>(i));
      return true;
    }
  return false;
}

}  // namespace

bool MediaStack::contains(std::uint32_t material) const {
  return std::ranges::count(std::span(materials_).first(size_), material) > 0;
}

void MediaStack::enter(std::span<const Surface> surfaces, std::uint32_t material) {
  std::uint32_t at = size_;
  while (at > 0 && surfaces[materials_[at - 1]].priority > surfaces[material].priority) --at;
  insert(at, material);
}

void MediaStack::surround(std::span<const Surface> surfaces, std::uint32_t material) {
  std::uint32_t at = 0;
  while (at < size_ && surfaces[materials_[at]].priority < surfaces[material].priority) ++at;
  insert(at, material);
}

void MediaStack::insert(std::uint32_t at, std::uint32_t material) {
  if (size_ == kCapacity) {
    overflowed_ = true;
    if (at == 0) return;
    std::shift_left(materials_.begin(), materials_.begin() + at, 1);
    materials_[at - 1] = material;
    return;
  }
  std::shift_right(materials_.begin() + at, materials_.begin() + size_ + 1, 1);
  materials_[at] = material;
  ++size_;
}

void MediaStack::leave(std::uint32_t material) {
  for (std::uint32_t i = size_; i-- > 0;)
    if (materials_[i] == material) {
      std::shift_left(materials_.begin() + i, materials_.begin() + size_, 1);
      --size_;
      return;
    }
}

/// Beyond the back of a solid's surface.
void PathMedia::look_out(std::span<const Surface> surfaces, std::uint32_t material) {
  if (beyond_.contains(material)) {
    beyond_.leave(material);
  } else {
    here_.surround(surfaces, material);
    slipped_ = true;
  }
}

void PathMedia::meet(std::span<const Surface> surfaces, Boundary alone) {
  in_the_open_ = false;
  believed_ = here_.current(), beyond_ = here_;
  alone.from_inside ? look_out(surfaces, alone.material) : look_in(surfaces, alone.material);
  if (!crossed_) believed_ = here_.current();
  from_inside_ = alone.from_inside;
  hidden_ = here_.current() == beyond_.current();
  outside_ = from_inside_ ? beyond_.current() : here_.current();
  front_ = back_ = 0.0f;
}

const Contact::Face& PathMedia::meet(std::span<const Surface> surfaces, const Contact& contact) {
  in_the_open_ = false;
  believed_ = here_.current(), beyond_ = here_;
  for (const Contact::Face& f : contact.solids())
    if (f.boundary.from_inside) look_out(surfaces, f.boundary.material);
  for (const Contact::Face& f : contact.solids())
    if (!f.boundary.from_inside) look_in(surfaces, f.boundary.material);
  if (!crossed_) believed_ = here_.current();
  overflowed_ |= contact.overflowed || beyond_.overflowed();
  hidden_ = !contact.screen && here_.current() == beyond_.current();
  const Contact::Face& seen = interface(surfaces, contact);
  see(seen, contact);
  outside_ = from_inside_ && !contact.screen ? beyond_.current() : here_.current();
  return seen;
}

const Contact::Face& PathMedia::interface(std::span<const Surface> surfaces, const Contact& contact) const {
  if (contact.screen) return *contact.screen;
  const Contact::Face* best = nullptr;
  const auto rank = [&](const Contact::Face& f) {
    const Surface& s = surfaces[f.boundary.material];
    return std::tuple(s.priority, s.roughness, f.boundary.material);
  };
  for (const Contact::Face& f : contact.solids()) {
    const std::int32_t behind = f.boundary.from_inside ? here_.current() : beyond_.current();
    if (behind == static_cast<std::int32_t>(f.boundary.material) && (!best || rank(f) > rank(*best)))
      best = &f;
  }
  return best && !hidden_ ? *best : contact.met;
}

void PathMedia::see(const Contact::Face& face, const Contact& contact) {
  const float near = face.depth - contact.near_end, far = contact.far_end - face.depth;
  from_inside_ = face.boundary.from_inside;
  front_ = from_inside_ ? far : near, back_ = from_inside_ ? near : far;
}

bool has_media(const PreparedScene& scene) {
  return std::ranges::any_of(scene.surfaces, &Surface::encloses);
}

PathMedia media_at(const PreparedScene& scene, Vec3f point) {
  // Upwards, and along no axis or diagonal, where edges lie.
  const Vec3f up = normalize(Vec3f{0.1234f, 0.9731f, 0.0837f});
  std::vector<std::uint32_t> entered, around;  // from the inside out
  Ray ray{point, up};
  for (int i = 0; i < kMostHidden; ++i) {
    Hit hit = scene.accel.intersect(ray);
    if (hit.shape == kNoHit) break;
    const Contact contact = contact_at(scene, hit, up);
    for (const Contact::Face& f : contact.solids()) {
      const std::uint32_t material = f.boundary.material;
      if (!f.boundary.from_inside)
        entered.push_back(material);
      else if (!take_last(entered, material))
        around.push_back(material);
    }
    PathMedia passed;
    hit = passed.meet(scene.surfaces, contact).hit;
    ray.origin = pass_hidden(passed, scene, hit, up);
  }
  for (const std::uint32_t material : entered) take_last(around, material);  // turned inside out
  MediaStack media;
  std::ranges::reverse(around);
  for (const std::uint32_t material : around) media.enter(scene.surfaces, material);
  return PathMedia(media);
}

void meet_place(PathMedia& media, const PreparedScene& scene, Hit& hit, Vec3f direction) {
  const std::uint32_t material = scene.shapes[hit.shape].material;
  const Surface& surface = scene.surfaces[material];
  const SurfacePoint point = surface_point(scene.scene.geometry, hit);
  const float cosine = dot(point.geometric_normal, direction);
  // On what nothing passes, the place matters to rays alone that come out of a gap narrower than rounding.
  if (touches(scene, hit) && (surface.lets_through || std::abs(cosine) * hit.t < 2.0f * point.error))
    hit = media.meet(scene.surfaces, contact_at(scene, hit, direction)).hit;
  else if (surface.encloses)
    media.meet(scene.surfaces, Boundary{material, cosine >= 0.0f});
  else
    media.meet_screen();
}

Vec3f pass_hidden(PathMedia& media, const PreparedScene& scene, const Hit& hit, Vec3f direction) {
  SurfacePoint point = surface_point(scene.scene.geometry, hit);
  media.widen(point);
  media.cross();
  return point.leave(direction);
}

}  // namespace photopic
