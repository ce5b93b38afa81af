#include "core/light_sampler.h"

#include <algorithm>

#include "core/surface_point.h"

namespace photopic {
namespace {

/// Luminance over the sides that emit.
double emitted(const Material& m) {
  return m.emission_luminance * (m.double_sided ? 2.0 : 1.0);
}

}  // namespace

LightSampler::LightSampler(const Scene& scene)
    : pdf_of_material_(scene.materials.size()), power_of_spectrum_(scene.emission_spectra.size()) {
  // Collect the emitting triangles and their power.
  std::vector<double> power;
  double total = 0.0;
  for (const Shape& shape : scene.geometry.shapes) {
    const Material& material = scene.materials[shape.material];
    if (material.emission_spectrum < 0 || !(material.emission_luminance > 0.0f)) continue;
    for (std::uint32_t i = 0; i < shape.triangle_count; ++i) {
      const auto& [a, b, c] = scene.geometry.triangles[shape.first_triangle + i];
      const auto& positions = scene.geometry.positions;
      const Vec3f v = positions[a], e1 = positions[b] - v, e2 = positions[c] - v;
      const Vec3d n = cross(to_double(e1), to_double(e2));
      const double area = 0.5 * length(n);
      if (!(area > 0.0)) continue;
      const float error = position_error(v, positions[b], positions[c]);
      const float shrink = shrink_to_middle(error, std::max(max_abs(e1), max_abs(e2)));
      triangles_.push_back({v + (e1 + e2) * (shrink / 3.0f), e1 * (1.0f - shrink), e2 * (1.0f - shrink),
                            to_float(n / (2.0 * area)), shape.material, shape.first_triangle + i, error});
      power.push_back(area * emitted(material));
      total += power.back();
      power_of_spectrum_[static_cast<std::size_t>(material.emission_spectrum)] += power.back();
    }
  }
  if (triangles_.empty()) return;

  for (std::size_t m = 0; m < scene.materials.size(); ++m)
    if (scene.materials[m].emission_spectrum >= 0)
      pdf_of_material_[m] = static_cast<float>(emitted(scene.materials[m]) / total);

  // Vose 1991: fill bins of equal probability from one small and one large entry each.
  const std::size_t n = triangles_.size();
  bins_.resize(n);
  std::vector<std::uint32_t> small, large;
  for (std::uint32_t i = 0; i < n; ++i) {
    power[i] *= static_cast<double>(n) / total;
    (power[i] < 1.0 ? small : large).push_back(i);
  }
  while (!small.empty() && !large.empty()) {
    const std::uint32_t s = small.back(), l = large.back();
    small.pop_back();
    bins_[s] = {power[s], l};
    power[l] -= 1.0 - power[s];
    if (power[l] < 1.0) {
      large.pop_back();
      small.push_back(l);
    }
  }
  for (const std::uint32_t i : small) bins_[i] = {1.0, i};
  for (const std::uint32_t i : large) bins_[i] = {1.0, i};
}

LightSample LightSampler::sample(double u_choice, Sample2d u) const {
  const double scaled = u_choice * static_cast<double>(bins_.size());
  const auto bin = std::min(static_cast<std::uint32_t>(scaled), static_cast<std::uint32_t>(bins_.size() - 1));
  const bool keep = scaled - bin < bins_[bin].keep;
  const Triangle& t = triangles_[keep ? bin : bins_[bin].alias];
  const Sample2d b = sample_triangle(u);
  return {t.vertex + t.edge1 * b.x + t.edge2 * b.y,
          t.normal,
          pdf_of_material_[t.material],
          t.material,
          t.index,
          b,
          t.error};
}

}  // namespace photopic
