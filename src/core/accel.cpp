#include "core/accel.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/accel_tree.h"

namespace photopic {
namespace {

RTCRay make_ray(Vec3f origin, Vec3f direction, float t_max) {
  RTCRay ray{};
  ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
  ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
  ray.tnear = 0.0f;
  ray.tfar = t_max;
  ray.mask = ~0u;
  return ray;
}

template <typename T, typename Vector>
void store(T* to, Vector values) {
  static_assert(sizeof(values) == kLanes * sizeof(T));
  std::memcpy(to, &values, sizeof(values));
}

/// Of the slots' rays those are valid that Embree takes. @return t_max
Lanes load(const RayArray& rays, const Packet& slots, RTCRay16& packet, std::array<int, kLanes>& valid) {
  const Vec3Lanes o = rays.origin.gather_vectors(slots);
  const auto [x, y, z, t_max] = rays.direction.gather(slots);
  const Vec3Lanes d{x, y, z};
  store(packet.org_x, o.x), store(packet.org_y, o.y), store(packet.org_z, o.z);
  store(packet.dir_x, d.x), store(packet.dir_y, d.y), store(packet.dir_z, d.z);
  store(packet.tnear, Lanes{}), store(packet.time, Lanes{});
  store(packet.mask, ~UintLanes{}), store(packet.flags, UintLanes{});
  store(valid.data(), is_traceable(RayLanes{o, d}) & slots.used());
  return t_max;
}

}  // namespace

Accel::Accel(Geometry& geometry, std::span<const Surface> surfaces, const Quads* quads,
             std::span<const float> touching)
    : tree_(std::make_unique<Tree>(geometry, surfaces, quads, touching)),
      ranges_(tree_->ranges()),
      baked_shapes_(static_cast<std::uint32_t>(geometry.baked_shape_count())) {
  for (const Instance& instance : geometry.instances)
    first_shape_.push_back(geometry.prototypes[instance.prototype].first_shape);
}

Accel::~Accel() = default;
Accel::Accel(Accel&&) noexcept = default;
Accel& Accel::operator=(Accel&&) noexcept = default;

Hit Accel::make_hit(std::uint32_t geometry, std::uint32_t primitive, std::uint32_t instance, float u, float v,
                    float t) const {
  if (geometry == RTC_INVALID_GEOMETRY_ID) return {};
  const bool baked = instance == RTC_INVALID_GEOMETRY_ID;
  const std::uint32_t index = baked ? kNoInstance : instance - baked_shapes_,
                      shape = baked ? geometry : first_shape_[index] + geometry;
  const auto place = ranges_[shape].locate(primitive, u, v);
  return {shape, place.triangle, index, place.u, place.v, t};
}

Hit Accel::intersect(const Ray& ray) const {
  if (!is_traceable(ray)) return {};
  const auto [found, hit] =
      tree_->intersect(make_ray(ray.origin, ray.direction, std::numeric_limits<float>::infinity()));
  return make_hit(hit.geomID, hit.primID, hit.instID[0], hit.u, hit.v, found.tfar);
}

double Accel::radius() const {
  if (ranges_.empty()) return 0.0;
  RTCBounds b;
  rtcGetSceneBounds(tree_->scene(), &b);
  const double x = b.upper_x - b.lower_x, y = b.upper_y - b.lower_y, z = b.upper_z - b.lower_z;
  return 0.5 * std::sqrt(x * x + y * y + z * z);
}

void Accel::intersect(const RayArray& rays, std::span<const std::uint32_t> slots, std::span<Hit> hits,
                      bool coherent) const {
  for (std::size_t first = 0; first < slots.size(); first += kLanes) {
    const Packet packet(slots, first);
    alignas(64) RTCRayHit16 query;
    alignas(64) std::array<int, kLanes> valid;
    load(rays, packet, query.ray, valid);
    store(query.ray.tfar, Lanes{} + std::numeric_limits<float>::infinity());
    store(query.hit.geomID, UintLanes{} + RTC_INVALID_GEOMETRY_ID);
    tree_->intersect(valid.data(), query, coherent);
    store_hits(query, packet, hits);
  }
}

/// make_hit of each, where there are no instances for all at once.
template <typename Query>
void Accel::store_hits(const Query& query, const Packet& slots, std::span<Hit> hits) const {
  const auto& hit = query.hit;
  if (!first_shape_.empty() || ranges_.empty()) {
    for (int i = 0; i < slots.count; ++i)
      hits[slots[i]] =
          make_hit(hit.geomID[i], hit.primID[i], hit.instID[0][i], hit.u[i], hit.v[i], query.ray.tfar[i]);
    return;
  }
  const auto shape = load<UintLanes>(hit.geomID), primitive = load<UintLanes>(hit.primID);
  const IntLanes missed = shape == RTC_INVALID_GEOMETRY_ID;
  const UintLanes known = missed ? UintLanes{} : shape;
  const auto [first, pairs] = gather_rows<2>([&](int i) { return &ranges_[lane(known, i)]; });
  const auto place =
      PrimitiveRange::locate(reinterpret_cast<UintLanes>(first), reinterpret_cast<UintLanes>(pairs),
                             primitive, load<Lanes>(hit.u), load<Lanes>(hit.v));
  const auto bits = [](UintLanes v) { return reinterpret_cast<Lanes>(v); };
  const UintLanes nothing = UintLanes{} + kNoHit;
  const auto rows = rows_of(std::array<Lanes, 8>{bits(shape), bits(missed ? nothing : place.triangle),
                                                 bits(UintLanes{} + kNoInstance), place.u, place.v,
                                                 load<Lanes>(query.ray.tfar), Lanes{}, Lanes{}});
  const auto by_lane = std::bit_cast<std::array<Hit, kLanes>>(rows);
  for (int i = 0; i < slots.count; ++i) hits[slots[i]] = by_lane[static_cast<std::size_t>(i)];
}

void Accel::occluded(const RayArray& rays, std::span<const std::uint32_t> slots,
                     std::span<Shadow> shadows) const {
  for (std::size_t first = 0; first < slots.size(); first += kLanes) {
    const Packet packet(slots, first);
    alignas(64) RTCRay16 query;
    alignas(64) std::array<int, kLanes> valid;
    store(query.tfar, load(rays, packet, query, valid));
    store(query.id, kLaneNumbers);
    const std::uint32_t met_panes = tree_->occluded(valid.data(), query);
    for (int i = 0; i < packet.count; ++i)
      shadows[packet[i]] = query.tfar[i] < 0.0f ? Shadow::blocked : Shadow::clear;
    for (std::uint32_t bits = met_panes; bits != 0; bits &= bits - 1)
      if (Shadow& shadow = shadows[packet[std::countr_zero(bits)]]; shadow == Shadow::clear)
        shadow = Shadow::by_panes;
  }
}

}  // namespace photopic
