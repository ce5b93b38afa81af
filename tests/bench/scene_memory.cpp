// What a scene must take at least: bytes of its geometry, of the textures its materials use, and of Embree's
// structures (as Embree reports them, with the pairs of triangles that a large scene's are made of; at their
// peak while building and afterwards), as JSON.
//   scene_memory SCENE
#include <dlfcn.h>

#if PHOTOPIC_EMBREE >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <set>

#include "bench_scene.h"
#include "core/quads.h"
#include "core/texture.h"

using namespace photopic;

namespace {

/// Of Embree's devices; its memory monitor has nowhere else to put them.
std::atomic<std::ptrdiff_t> embree_bytes = 0, embree_peak = 0;

bool count_bytes(void*, ssize_t bytes, bool) {
  const std::ptrdiff_t now = embree_bytes += bytes;
  for (std::ptrdiff_t peak = embree_peak; now > peak && !embree_peak.compare_exchange_weak(peak, now);) {
  }
  return true;
}

template <typename T>
std::size_t bytes_of(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

std::size_t geometry_bytes(const Geometry& g) {
  std::size_t sum = bytes_of(g.positions) + bytes_of(g.triangles) + bytes_of(g.shapes) +
                    bytes_of(g.prototypes) + bytes_of(g.instances) + bytes_of(g.normals) +
                    bytes_of(g.tangents) + bytes_of(g.colors);
  for (const auto& uv : g.uvs) sum += bytes_of(uv);
  return sum;
}

constexpr Texture MaterialTextures::*kTextures[] = {&MaterialTextures::base_color,
                                                    &MaterialTextures::metallic_roughness,
                                                    &MaterialTextures::normal,
                                                    &MaterialTextures::emissive,
                                                    &MaterialTextures::transmission,
                                                    &MaterialTextures::specular,
                                                    &MaterialTextures::specular_color,
                                                    &MaterialTextures::clearcoat,
                                                    &MaterialTextures::clearcoat_roughness,
                                                    &MaterialTextures::clearcoat_normal,
                                                    &MaterialTextures::sheen_color,
                                                    &MaterialTextures::sheen_roughness,
                                                    &MaterialTextures::anisotropy,
                                                    &MaterialTextures::iridescence,
                                                    &MaterialTextures::iridescence_thickness,
                                                    &MaterialTextures::diffuse_transmission,
                                                    &MaterialTextures::diffuse_transmission_color};
static_assert(sizeof(MaterialTextures) < (std::size(kTextures) + 1) * sizeof(Texture), "one is not listed");

std::size_t pair_bytes(Geometry geometry) {
  return is_worth_pairing(geometry) ? bytes_of(Quads(geometry).quads) : 0;
}

/// Each image once.
std::size_t texture_bytes(const Scene& scene) {
  std::set<const TextureImage*> images;
  for (const Material& material : scene.materials)
    if (material.textures)
      for (const auto which : kTextures) images.insert(((*material.textures).*which).image.get());
  images.erase(nullptr);
  std::size_t sum = 0;
  for (const TextureImage* image : images)
    sum += std::visit([](const auto& texels) { return bytes_of(texels); }, image->texels);
  return sum;
}

}  // namespace

/// Before Embree's own: each device counts its memory.
RTCDevice rtcNewDevice(const char* config) {
  static auto* const real = reinterpret_cast<RTCDevice (*)(const char*)>(dlsym(RTLD_NEXT, "rtcNewDevice"));
  RTCDevice device = real(config);
  if (device != nullptr) rtcSetDeviceMemoryMonitorFunction(device, count_bytes, nullptr);
  return device;
}

int main(int count, char** words) {
  try {
    const auto scene = load_bench_scene(parse_bench_request(count, words));
    const auto pairs = static_cast<std::ptrdiff_t>(pair_bytes(scene->scene.geometry));
    std::printf("{\"geometry\": %zu, \"textures\": %zu, \"bvh\": %td, \"bvh_peak\": %td}\n",
                geometry_bytes(scene->scene.geometry), texture_bytes(scene->scene), pairs + embree_bytes,
                pairs + embree_peak);
    return EXIT_SUCCESS;
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "scene_memory: %s\n", problem.what());
    return EXIT_FAILURE;
  }
}
