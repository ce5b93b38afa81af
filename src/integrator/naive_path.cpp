#include "integrator/naive_path.h"

#include <limits>

#include "integrator/vertex.h"
#include "integrator/with_bsdf.h"
#include "spectral/path_wavelengths.h"
#include "spectral/rgb_light.h"
#include "spectral/wavelength_sampler.h"

namespace photopic {
namespace {

/// A sampled continuation, the same for every BSDF.
template <int N>
struct Step {
  Vec3f origin, direction;
  SampledSpectrum<N> weight;
  bool inwards;
  bool split;
};

template <int N, typename Bsdf>
std::optional<Step<N>> step(const Vertex<N, Bsdf>& vertex, const PathMedia& media, float u_lobe, Sample2d u) {
  const auto s = vertex.sample(u_lobe, u);
  if (!s) return {};
  SurfacePoint point = vertex.point;
  media.widen(point);
  return Step<N>{point.leave(s->wi), s->wi, s->weight, vertex.is_inwards(s->wi), s->split};
}

/// One by one, where the batches look up 16 paths at once.
template <int N>
PathWavelengths<N> look_up(const SampledWavelengths<N>& w, const Observer& observer) {
  PathWavelengths<N> path;
  for (int j = 0; j < N; ++j) {
    const double lambda = w.lambda[j], weight = 1.0 / w.density_sum[j];
    const Xyz h = observer(lambda) * (weight / observer.y_integral());
    path.lambda.v[j] = static_cast<float>(lambda);
    path.weight.v[j] = static_cast<float>(weight);
    path.xyz_per_radiance[0].v[j] = static_cast<float>(h.x);
    path.xyz_per_radiance[1].v[j] = static_cast<float>(h.y);
    path.xyz_per_radiance[2].v[j] = static_cast<float>(h.z);
  }
  return path;
}

template <int N>
SampledSpectrum<N> sample_emission(const TabulatedSpectrum& emission, const SampledWavelengths<N>& w) {
  SampledSpectrum<N> result;
  for (int j = 0; j < N; ++j) result.v[j] = static_cast<float>(emission(w.lambda[j]));
  return result;
}

}  // namespace

template <int N>
void NaivePathTracer<N>::trace(std::span<const PathKey> paths, Film& film) {
  for (const PathKey& path : paths) {
    const Xyz xyz = trace(path);
    if (std::isfinite(xyz.x + xyz.y + xyz.z))
      film.add(path.pixel, xyz);
    else
      ++stats_.non_finite;
  }
  stats_.paths += paths.size();
}

template <int N>
Xyz NaivePathTracer<N>::trace(const PathKey& path) {
  const SampleStream stream(options_.sequence, options_.seed, path.pixel, path.sample);
  const auto sampled = sample_wavelengths<N>(sampler_, stream.get_1d_fine(kWavelength));
  const PathWavelengths<N> wavelengths = look_up(sampled, *options_.observer);
  const SampledSpectrum<N> lambda = wavelengths.lambda;

  Ray ray = camera_ray(scene_.scene.camera, path.pixel, stream);
  SampledSpectrum<N> throughput(1.0f), radiance(0.0f);
  PathMedia media = camera_media_;
  for (int depth = 1, hidden = 0;; ++depth) {
    Hit hit = scene_.accel.intersect(ray);
    ++stats_.rays;
    if (!is_traceable(ray)) {
      radiance = SampledSpectrum<N>(std::numeric_limits<float>::quiet_NaN());
      break;
    }
    const bool escaped = hit.shape == kNoHit;
    attenuate(throughput, scene_, media.current(), lambda,
              escaped ? std::numeric_limits<float>::infinity() : hit.t);
    if (escaped) {
      if (const Environment* environment = scene_.scene.environment.get()) {
        const Vec3f rgb = environment->radiance(ray.direction);
        const auto& spectrum =
            scene_.scene.emission_spectra[static_cast<std::size_t>(environment->emission_spectrum)];
        radiance +=
            throughput * SampledTints<N>(lambda)(rgb.x, rgb.y, rgb.z) * sample_emission<N>(spectrum, sampled);
      }
      break;
    }

    meet(media, scene_, hit, ray.direction);
    mend(throughput, scene_, media, lambda);
    if (throughput.is_black()) break;

    // Light from the surface itself.
    const Surface& surface = scene_.surfaces[scene_.shapes[hit.shape].material];
    const Surface* outside = surface_of(scene_, media.outside());
    const ShadingMaterial<N> material(surface, lambda, {scene_.scene.geometry, hit}, outside);
    const bool shines = surface.double_sided || meets_front(scene_.scene.geometry, hit, ray.direction);
    if (surface.emits && !media.hidden() && shines) {
      const auto& spectrum =
          scene_.scene.emission_spectra[static_cast<std::size_t>(surface.emission_spectrum)];
      radiance += throughput * sample_emission<N>(spectrum, sampled) * material.emission_tint() *
                  surface.emission_luminance;
    }
    if (media.hidden() && ++hidden < kMostHidden) {
      ray.origin = pass_hidden(media, scene_, hit, ray.direction);
      --depth;
      continue;
    }
    if (depth == options_.max_depth) break;

    // Where the path goes on.
    const float u_lobe = stream.get_1d(bounce_dimension(depth, kBsdfLobe));
    const Sample2d u = stream.get_2d(bounce_dimension(depth, kBsdfDirection));
    const Vec3f wo = -ray.direction;
    const BsdfKind kind = material.choose_kind(stream.get_1d(bounce_dimension(depth, kBsdfChoice)));
    std::optional<Step<N>> next;
    with_bsdf<N>(kind, [&]<typename Bsdf>(std::type_identity<Bsdf>) {
      next = step(Vertex<N, Bsdf>(scene_, hit, wo, lambda, throughput, outside), media, u_lobe, u);
    });
    if (!next) break;
    throughput *= next->weight;
    if (throughput.is_black()) break;
    stats_.split_paths += next->split;
    ray = {next->origin, next->direction};
    media.go_on(next->inwards);
  }
  stats_.media_overflows += media.overflowed();
  stats_.media_slips += media.slipped();
  return wavelengths.to_xyz(radiance);
}

template class NaivePathTracer<1>;
template class NaivePathTracer<4>;
template class NaivePathTracer<8>;
template class NaivePathTracer<16>;

}  // namespace photopic
