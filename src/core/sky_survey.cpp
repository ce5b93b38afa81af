#include "core/sky_survey.h"

#include <algorithm>
#include <numeric>

#include "core/frame.h"
#include "core/sampling.h"
#include "core/surface_point.h"

namespace photopic {
namespace {

constexpr std::uint32_t kPaths = 2048, kMostVertices = 4;

/// Where light is gathered.
struct Site {
  SurfacePoint point;
  Vec3f normal;  ///< zero where light arrives from all around
};

/// Walks from the camera that only tell where light is gathered: whatever scatters does so as a white wall,
/// what transmits is passed straight.
class Walk {
 public:
  Walk(const Scene& scene, const Accel& accel, std::span<const Surface> surfaces)
      : scene_(scene), surfaces_(surfaces), rays_(kPaths), hits_(kPaths) {
    std::vector<std::uint32_t> slots(kPaths);
    std::iota(slots.begin(), slots.end(), 0u);
    for (const std::uint32_t slot : slots) rays_.set(slot, camera_ray(slot));
    for (depth_ = 0; depth_ < kMostVertices && !slots.empty(); ++depth_) {
      accel.intersect(rays_, slots, hits_);
      std::erase_if(slots, [this](std::uint32_t slot) { return !go_on(slot); });
    }
  }

  const std::vector<Site>& sites() const { return sites_; }

 private:
  static Sample2d random(std::uint32_t slot, std::uint32_t dimension) {
    return SampleStream(Sequence::sobol, 0u, 0u, slot).get_2d(dimension);
  }
  Ray camera_ray(std::uint32_t slot) const {
    const Camera& camera = scene_.camera;
    const Sample2d u = random(slot, 0);
    return camera.ray(u.x * static_cast<float>(camera.width), u.y * static_cast<float>(camera.height));
  }

  /// @return whether the walk does
  bool go_on(std::uint32_t slot) {
    const Hit& hit = hits_[slot];
    if (hit.shape == kNoHit) return false;
    const Surface& surface = surfaces_[scene_.geometry.shapes[hit.shape].material];
    const Vec3f direction = rays_.direction[slot];
    const SurfacePoint point = surface_point(scene_.geometry, hit);
    if (surface.transmits) {
      sites_.push_back({point, {}});
      rays_.set(slot, {point.leave(direction), direction});
      return true;
    }
    if (!surface.scatters) return false;
    const Frame frame = shading_frame(point, -direction, true);
    sites_.push_back({point, frame.n});
    const Vec3f wi = frame.to_world(sample_cosine_hemisphere(random(slot, 1 + depth_)));
    rays_.set(slot, {point.leave(wi), wi});
    return true;
  }

  const Scene& scene_;
  std::span<const Surface> surfaces_;
  RayArray rays_;
  std::vector<Hit> hits_;
  std::uint32_t depth_ = 0;
  std::vector<Site> sites_;
};

/// To 16 tiles, one a lane. @param number of the site, by which points of the tiles are drawn
Vec3Lanes directions_to_tiles(const Environment& environment, UintLanes tile, std::uint32_t number) {
  const SampleStreamLanes stream(Sequence::sobol, UintLanes{} + 1u, tile, UintLanes{} + number);
  const auto columns = std::uint32_t{Environment::kTileColumns};
  return environment
      .sample_tile<Lanes>(reinterpret_cast<IntLanes>(tile % columns),
                          reinterpret_cast<IntLanes>(tile / columns), stream.get_2d(0))
      .direction;
}

std::vector<Vec3f> directions_to(const Sky& sky, std::span<const SkyViews::Glimpse> glimpses,
                                 std::uint32_t number) {
  std::vector<Vec3f> directions;
  std::size_t next = 0;
  while (next < glimpses.size() && glimpses[next].source < sky.tiles()) {
    UintLanes tile{};
    int count = 0;
    for (; count < kLanes && next < glimpses.size() && glimpses[next].source < sky.tiles(); ++next)
      tile[count++] = glimpses[next].source;
    const Vec3Lanes w = directions_to_tiles(*sky.environment, tile, number);
    for (int i = 0; i < count; ++i) directions.push_back(lane(w, i));
  }
  for (; next < glimpses.size(); ++next)
    directions.push_back(sky.directions[glimpses[next].source - sky.tiles()]);
  return directions;
}

void look(const Sky& sky, const Accel& accel, const Site& site, std::uint32_t number,
          std::span<SkyViews::Glimpse> glimpses) {
  const std::vector<Vec3f> directions = directions_to(sky, glimpses, number);
  RayArray rays(glimpses.size());
  std::vector<std::uint32_t> slots;
  for (std::uint32_t i = 0; i < glimpses.size(); ++i) {
    const Vec3f w = directions[i];
    glimpses[i].seen = site.normal == Vec3f{} ? 1.0f : std::max(dot(site.normal, w), 0.0f);
    if (glimpses[i].seen == 0.0f) continue;
    rays.set(i, {site.point.leave(w), w});
    slots.push_back(i);
  }
  std::vector<Shadow> shadows(glimpses.size());
  accel.occluded(rays, slots, shadows);
  for (const std::uint32_t i : slots)
    if (shadows[i] == Shadow::blocked) glimpses[i].seen = 0.0f;
}

}  // namespace

SkyViews survey_sky(const Scene& scene, const Accel& accel, std::span<const Surface> surfaces) {
  const Sky sky(scene);
  const bool are_alone = sky.directions.size() == scene.punctual_lights.size() &&
                         std::ranges::none_of(surfaces, &Surface::emits);
  if (sky.empty() || (!sky.environment && are_alone)) return {};
  const Walk walk(scene, accel, surfaces);
  std::vector<LightReference> places;
  for (const Site& site : walk.sites()) places.push_back({site.point.position, site.normal});
  return {sky, places, [&](std::size_t i, std::span<SkyViews::Glimpse> glimpses) {
            look(sky, accel, walk.sites()[i], static_cast<std::uint32_t>(i), glimpses);
          }};
}

}  // namespace photopic
