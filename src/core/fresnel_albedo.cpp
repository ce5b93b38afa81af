#include "core/fresnel_albedo.h"

#include <tbb/parallel_for.h>

#include "core/anisotropic_ggx.h"
#include "core/fresnel.h"
#include "core/table_position.h"

namespace photopic {
namespace {

using Weights = FresnelAlbedo::Weights;

float step(int i, int count) {
  return count == 1 ? 0.0f : static_cast<float>(i) / static_cast<float>(count - 1);
}

TablePosition place(float x, int count) {
  return count == 1 ? TablePosition{0, 0.0f} : locate(x, count);
}

// Visible-normal sampling leaves F·G2/G1 to average; steep normals, where light is lost, are drawn more
// often.
Weights integrate(const AnisotropicGgx& ggx, Vec3f wo, std::uint32_t samples) {
  Weights sum;
  for (std::uint32_t i = 0; i < samples; ++i) {
    const Sample2d u = SampleStream(Sequence::sobol, 0, 0, i).get_2d(0);
    const Vec3f m = ggx.sample_visible(wo, {u.x, 1.0f - sqr(u.y)});
    const Vec3f wi = reflect(wo, m);
    if (wi.z > 0.0f) sum.add(FresnelAlbedo::at(dot(wo, m)), 2.0f * u.y * ggx.g2(wo, wi));
  }
  Weights mean;
  mean.add(sum, 1.0f / (static_cast<float>(samples) * ggx.g1(wo)));
  return mean;
}

}  // namespace

void FresnelAlbedo::Weights::add(const Weights& other, float factor) {
  f0 += factor * other.f0;
  f90 += factor * other.f90;
  for (std::size_t k = 0; k < kNodes; ++k) rest[k] += factor * other.rest[k];
}

FresnelAlbedo::Weights FresnelAlbedo::at(float cos_theta) {
  Weights weights;
  weights.f90 = schlick_weight(cos_theta);
  weights.f0 = 1.0f - weights.f90;
  const auto place = locate(cos_theta, kNodes + 2);  // among the nodes, 0 and 1
  if (place.cell > 0) weights.rest[static_cast<std::size_t>(place.cell - 1)] = 1.0f - place.t;
  if (place.cell < kNodes) weights.rest[static_cast<std::size_t>(place.cell)] = place.t;
  return weights;
}

const FresnelAlbedo& FresnelAlbedo::isotropic() {
  static const FresnelAlbedo table({32, 1, 1, 32});
  return table;
}
const FresnelAlbedo& FresnelAlbedo::anisotropic() {
  static const FresnelAlbedo table({20, 12, 8, 16});
  return table;
}

FresnelAlbedo::FresnelAlbedo(Size size)
    : size_(size),
      directional_(entry(size.roughness, 0, 0, 0)),
      average_(static_cast<std::size_t>(size.roughness * size.strength)) {
  const std::uint32_t samples = size.strength == 1 ? 512 : 256;
  tbb::parallel_for(0, size.roughness * size.strength, [&](int i) {
    const int r = i / size_.strength, s = i % size_.strength;
    const auto ggx = AnisotropicGgx::of(std::max(step(r, size_.roughness), 1e-2f), step(s, size_.strength));
    for (int a = 0; a < size_.azimuth; ++a)
      for (int c = 0; c < size_.cosine; ++c) {
        const SinCos phi = sin_cos_two_pi(0.25f * step(a, size_.azimuth));
        const float cos_theta = sqr(std::max(step(c, size_.cosine), 1e-2f));
        const float sin_theta = safe_sqrt(1.0f - sqr(cos_theta));
        directional_[entry(r, s, a, c)] =
            integrate(ggx, {sin_theta * phi.cos, sin_theta * phi.sin, cos_theta}, samples);
      }
    average_[static_cast<std::size_t>(i)] = average_of(r, s);
  });
}

std::size_t FresnelAlbedo::entry(int roughness, int strength, int azimuth, int cosine) const {
  return static_cast<std::size_t>(
      ((roughness * size_.strength + strength) * size_.azimuth + azimuth) * size_.cosine + cosine);
}

Weights FresnelAlbedo::average_of(int roughness, int strength) const {
  // Between two entries the albedo is linear in x = √μ, and 2μ dμ = 4x³ dx; in azimuth the trapezoidal rule.
  Weights average;
  for (int a = 0; a < size_.azimuth; ++a) {
    const bool end = a == 0 || a == size_.azimuth - 1;
    const float share =
        size_.azimuth == 1 ? 1.0f : (end ? 0.5f : 1.0f) / static_cast<float>(size_.azimuth - 1);
    for (int c = 0; c + 1 < size_.cosine; ++c) {
      const float low = step(c, size_.cosine), high = step(c + 1, size_.cosine);
      const float whole = sqr(sqr(high)) - sqr(sqr(low));
      const float first = 0.8f * (sqr(sqr(high)) * high - sqr(sqr(low)) * low);
      const float t = (first / whole - low) / (high - low);
      average.add(directional_[entry(roughness, strength, a, c)], share * whole * (1.0f - t));
      average.add(directional_[entry(roughness, strength, a, c + 1)], share * whole * t);
    }
  }
  return average;
}

Weights FresnelAlbedo::directional(Vec3f w, float roughness, float strength) const {
  const auto r = place(roughness, size_.roughness), s = place(strength, size_.strength),
             c = place(safe_sqrt(w.z), size_.cosine),
             a = place(size_.azimuth == 1 ? 0.0f : std::atan2(std::abs(w.y), std::abs(w.x)) * (2.0f * kInvPi),
                       size_.azimuth);
  Weights weights;
  for (int i = 0; i < 16; ++i) {
    const int dr = i & 1, ds = i >> 1 & 1, da = i >> 2 & 1, dc = i >> 3 & 1;
    const float weight = r.weight(dr) * s.weight(ds) * a.weight(da) * c.weight(dc);
    if (weight > 0.0f)
      weights.add(directional_[entry(r.cell + dr, s.cell + ds, a.cell + da, c.cell + dc)], weight);
  }
  return weights;
}

Weights FresnelAlbedo::average(float roughness, float strength) const {
  const auto r = place(roughness, size_.roughness), s = place(strength, size_.strength);
  Weights weights;
  for (int i = 0; i < 4; ++i) {
    const int dr = i & 1, ds = i >> 1;
    const float weight = r.weight(dr) * s.weight(ds);
    const int at = (r.cell + dr) * size_.strength + s.cell + ds;
    if (weight > 0.0f) weights.add(average_[static_cast<std::size_t>(at)], weight);
  }
  return weights;
}

}  // namespace photopic
