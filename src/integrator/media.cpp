#include "integrator/media.h"

#include <algorithm>
#include <ranges>
#include <vector>

#include "core/surface_point.h"

namespace photopic {
namespace {

/// Glass as a ray meets it, one surface after the other.
struct Crossing {
  std::uint32_t material;
  bool leaves;
};

std::vector<Crossing> crossings(const PreparedScene& scene, Ray ray) {
  std::vector<Crossing> found;
  for (int i = 0; i < kMostHidden; ++i) {
    const Hit hit = scene.accel.intersect(ray);
    if (hit.shape == kNoHit) break;
    const std::uint32_t material = scene.scene.geometry.shapes[hit.shape].material;
    const SurfacePoint point = surface_point(scene.scene.geometry, hit);
    if (scene.surfaces[material].encloses)
      found.push_back({material, dot(point.geometric_normal, ray.direction) >= 0.0f});
    ray.origin = point.leave(ray.direction);
  }
  return found;
}

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

void PathMedia::meet(std::span<const Surface> surfaces, std::uint32_t material, bool from_inside) {
  met_ = material, from_inside_ = from_inside, outside_ = kVacuum, hidden_ = false;
  encloses_ = surfaces[material].encloses;
  if (!encloses_) return;
  const int priority = surfaces[material].priority;
  if (!from_inside) {
    outside_ = current();
    const bool in_it = outside_ == static_cast<std::int32_t>(material);
    hidden_ = in_it || (size_ > 0 && surfaces[materials_[size_ - 1]].priority > priority);
    return;
  }
  if (!contains(material)) {
    std::uint32_t at = 0;
    while (at < size_ && surfaces[materials_[at]].priority < priority) ++at;
    insert(at, material);
  }
  outside_ = size_ < 2 ? kVacuum : static_cast<std::int32_t>(materials_[size_ - 2]);
  const auto glass = static_cast<std::int32_t>(material);
  hidden_ = current() != glass || outside_ == glass;
}

void PathMedia::cross(std::span<const Surface> surfaces) {
  if (!encloses_) return;
  if (from_inside_)
    leave(met_);
  else
    enter(surfaces, met_);
}

void PathMedia::enter(std::span<const Surface> surfaces, std::uint32_t material) {
  std::uint32_t at = size_;
  while (at > 0 && surfaces[materials_[at - 1]].priority > surfaces[material].priority) --at;
  insert(at, material);
}

bool PathMedia::contains(std::uint32_t material) const {
  return std::ranges::count(std::span(materials_).first(size_), material) > 0;
}

void PathMedia::insert(std::uint32_t at, std::uint32_t material) {
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

void PathMedia::leave(std::uint32_t material) {
  for (std::uint32_t i = size_; i-- > 0;)
    if (materials_[i] == material) {
      std::shift_left(materials_.begin() + i, materials_.begin() + size_, 1);
      --size_;
      return;
    }
}

bool has_media(const PreparedScene& scene) {
  return std::ranges::any_of(scene.surfaces, &Surface::encloses);
}

PathMedia media_at(const PreparedScene& scene, Vec3f point) {
  // Upwards, and along no axis or diagonal, where edges lie.
  const Vec3f up = normalize(Vec3f{0.1234f, 0.9731f, 0.0837f});
  std::vector<std::uint32_t> entered, around;  // from the inside out
  for (const Crossing& c : crossings(scene, {point, up})) {
    if (!c.leaves)
      entered.push_back(c.material);
    else if (!take_last(entered, c.material))
      around.push_back(c.material);
  }
  for (const std::uint32_t material : entered) take_last(around, material);  // turned inside out
  PathMedia media;
  for (const std::uint32_t material : around | std::views::reverse) media.enter(scene.surfaces, material);
  return media;
}

void meet(PathMedia& media, const PreparedScene& scene, const Hit& hit, Vec3f direction) {
  const Geometry& geometry = scene.scene.geometry;
  const std::uint32_t material = geometry.shapes[hit.shape].material;
  const bool from_inside = scene.surfaces[material].encloses &&
                           dot(surface_point(geometry, hit).geometric_normal, direction) >= 0.0f;
  media.meet(scene.surfaces, material, from_inside);
}

Vec3f pass_hidden(PathMedia& media, const PreparedScene& scene, const Hit& hit, Vec3f direction) {
  media.cross(scene.surfaces);
  return surface_point(scene.scene.geometry, hit).leave(direction);
}

}  // namespace photopic
