#pragma once

#include "core/math.h"
#include "core/sampling.h"

namespace photopic {

/// A ray with a unit direction; t is in metres along it.
struct Ray {
  Vec3f origin;
  Vec3f direction;
};

/// Embree takes no others.
inline bool is_finite(const Ray& ray) {
  return std::isfinite(ray.origin.x + ray.origin.y + ray.origin.z + ray.direction.x + ray.direction.y +
                       ray.direction.z);
}

/// glTF's cameras: look down −z, +y up, square pixels; perspective or orthographic, with a pinhole or a thin
/// lens (Pharr et al. 2023, section 5.2.3).
struct Camera {
  Vec3f position;                                    ///< relative to Scene::origin [m]
  Vec3f right{1, 0, 0}, up{0, 1, 0}, back{0, 0, 1};  ///< orthonormal
  float tan_half_yfov = 0.5f;
  float half_height = 0.0f;      ///< of an orthographic camera's view [m]; 0: perspective
  float aperture_radius = 0.0f;  ///< of the lens [m]; 0: everything is sharp
  float focus_distance = 0.0f;   ///< from the lens to the plane that is sharp [m]
  int width = 0, height = 0;     ///< [pixels]

  bool orthographic() const { return half_height > 0.0f; }
  bool has_lens() const { return aperture_radius > 0.0f; }

  /// The pinhole's ray through film position (x, y) in pixels, (0, 0) the top left corner of the film.
  Ray ray(float x, float y) const {
    const Vec3f offset = film_offset(x, y);
    if (orthographic()) return {position + offset, -back};
    return {position, normalize(offset - back)};
  }

  /// The ray through a point of the lens, drawn uniformly by u, to where the pinhole's meets the plane of
  /// focus.
  Ray ray(float x, float y, Sample2d u) const {
    const Sample2d disk = sample_disk(u);
    const Vec3f lens = (right * disk.x + up * disk.y) * aperture_radius;
    const Vec3f offset = film_offset(x, y);
    if (orthographic()) return {position + offset + lens, normalize(-back * focus_distance - lens)};
    return {position + lens, normalize((offset - back) * focus_distance - lens)};
  }

 private:
  /// From the view's middle, in the plane at distance 1 or, orthographic, of the camera itself.
  Vec3f film_offset(float x, float y) const {
    const float half = orthographic() ? half_height : tan_half_yfov;
    const float scale = 2.0f * half / static_cast<float>(height);
    const float dx = (x - 0.5f * static_cast<float>(width)) * scale;
    const float dy = (0.5f * static_cast<float>(height) - y) * scale;
    return right * dx + up * dy;
  }
};

}  // namespace photopic
