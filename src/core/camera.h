#pragma once

#include "core/ray.h"
#include "core/sampling.h"

namespace photopic {

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
  template <typename T>
  BasicRay<T> ray(T x, T y) const {
    const Vec3<T> offset = film_offset(x, y), behind = broadcast<T>(back), eye = broadcast<T>(position);
    if (orthographic()) return {eye + offset, -behind};
    return {eye, normalize(offset - behind)};
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
  template <typename T>
  Vec3<T> film_offset(T x, T y) const {
    const float half = orthographic() ? half_height : tan_half_yfov;
    const float scale = 2.0f * half / static_cast<float>(height);
    const T dx = (x - 0.5f * static_cast<float>(width)) * scale;
    const T dy = (0.5f * static_cast<float>(height) - y) * scale;
    return broadcast<T>(right) * dx + broadcast<T>(up) * dy;
  }
};

}  // namespace photopic
