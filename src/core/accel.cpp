#include "core/accel.h"

#if PHOTOPIC_EMBREE >= 4
#include <embree4/rtcore.h>
#define PHOTOPIC_QUERY_FILTER RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS
#else
#include <embree3/rtcore.h>
#define PHOTOPIC_QUERY_FILTER RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

#include "core/sample_sequence.h"
#include "core/surface.h"

namespace photopic {
namespace {

/// Embree calls this from inside, where nothing may be thrown: the message is kept until it returns.
void keep_error(void* kept, RTCError, const char* message) {
  *static_cast<std::string*>(kept) = message;
}

RTCRay make_ray(Vec3f origin, Vec3f direction, float t_max) {
  RTCRay ray{};
  ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
  ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
  ray.tnear = 0.0f;
  ray.tfar = t_max;
  ray.mask = ~0u;
  return ray;
}

constexpr std::size_t kPacket = kLanes;

/// A number in [0, 1) for a ray and a triangle, whatever stands beside it in a batch: as pbrt-v4 does
/// (GeometricPrimitive::Intersect).
float hash_to_unit(const RTCFilterFunctionNArguments& a, unsigned i) {
  std::uint32_t hash = RTCHitN_primID(a.hit, a.N, i) * 0x9e3779b9u + RTCHitN_geomID(a.hit, a.N, i);
  for (const float x :
       {RTCRayN_org_x(a.ray, a.N, i), RTCRayN_org_y(a.ray, a.N, i), RTCRayN_org_z(a.ray, a.N, i),
        RTCRayN_dir_x(a.ray, a.N, i), RTCRayN_dir_y(a.ray, a.N, i), RTCRayN_dir_z(a.ray, a.N, i)})
    hash = mix_bits(hash * 31u + std::bit_cast<std::uint32_t>(x));
  return static_cast<float>(hash >> 8) * 0x1p-24f;
}

template <typename T, typename Vector>
void store(T* to, Vector values) {
  static_assert(sizeof(values) == kPacket * sizeof(T));
  std::memcpy(to, &values, sizeof(values));
}

/// Of the slots' rays those are valid that Embree takes.
void load(const RayArray& rays, const Packet& slots, RTCRay16& packet, std::array<int, kPacket>& valid) {
  const Vec3Lanes o = rays.origin.gather(slots), d = rays.direction.gather(slots);
  store(packet.org_x, o.x), store(packet.org_y, o.y), store(packet.org_z, o.z);
  store(packet.dir_x, d.x), store(packet.dir_y, d.y), store(packet.dir_z, d.z);
  store(packet.tnear, Lanes{}), store(packet.time, Lanes{});
  store(packet.mask, ~UintLanes{}), store(packet.flags, UintLanes{});
  constexpr IntLanes kLane{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  store(valid.data(), is_traceable(RayLanes{o, d}) & (kLane < slots.count));
}

/// What lets rays through a shape that covers in part.
struct Sieve {
  const Geometry& geometry;
  const Surface& surface;
  std::uint32_t first_triangle;

  /// Embree's filter, for nearest hits and for shadows.
  static void filter(const RTCFilterFunctionNArguments* a) {
    const Sieve& sieve = *static_cast<const Sieve*>(a->geometryUserPtr);
    for (unsigned i = 0; i < a->N; ++i) {
      if (a->valid[i] == 0) continue;
      const TrianglePoint point(sieve.geometry, sieve.first_triangle + RTCHitN_primID(a->hit, a->N, i),
                                RTCHitN_u(a->hit, a->N, i), RTCHitN_v(a->hit, a->N, i));
      const float coverage = sieve.surface.coverage(point);
      if (coverage < 1.0f && hash_to_unit(*a, i) >= coverage) a->valid[i] = 0;
    }
  }

  void attach(RTCGeometry mesh) {
    rtcSetGeometryUserData(mesh, this);
    rtcSetGeometryIntersectFilterFunction(mesh, filter);
    rtcSetGeometryOccludedFilterFunction(mesh, filter);
  }
};

}  // namespace

struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using SceneHandle = std::unique_ptr<RTCSceneTy, ReleaseScene>;

struct Accel::Handles {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::string error;  ///< the last that Embree reported
  std::vector<std::unique_ptr<Sieve>> sieves;

  RTCSceneFlags flags = RTC_SCENE_FLAG_ROBUST;

  explicit Handles(bool finds_crossings) : device(rtcNewDevice(nullptr)) {
    // A filter for one query.
    if (finds_crossings) flags = flags | PHOTOPIC_QUERY_FILTER;
    if (!device) throw std::runtime_error("Embree: no device");
    rtcSetDeviceErrorFunction(device, keep_error, &error);
    scene = new_scene().release();
  }
  ~Handles() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;

  SceneHandle new_scene() const {
    SceneHandle made(rtcNewScene(device));
    rtcSetSceneFlags(made.get(), flags);
    rtcSetSceneBuildQuality(made.get(), RTC_BUILD_QUALITY_HIGH);
    return made;
  }

  void attach(RTCScene to, RTCGeometry made) const {
    rtcCommitGeometry(made);
    rtcAttachGeometry(to, made);
    rtcReleaseGeometry(made);
  }

  void attach_shapes(RTCScene to, const Geometry& geometry, std::span<const Surface> surfaces,
                     std::size_t first, std::size_t count) {
    for (const Shape& shape : std::span(geometry.shapes).subspan(first, count)) {
      RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
      rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                 geometry.positions.data(), 0, sizeof(Vec3f), geometry.positions.size());
      rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, geometry.triangles.data(),
                                 shape.first_triangle * sizeof(geometry.triangles[0]),
                                 sizeof(geometry.triangles[0]), shape.triangle_count);
      if (const Surface& surface = surfaces[shape.material]; surface.partly_covers) {
        sieves.push_back(std::make_unique<Sieve>(Sieve{geometry, surface, shape.first_triangle}));
        sieves.back()->attach(mesh);
      }
      attach(to, mesh);
    }
  }

  void attach_instance(RTCScene prototype, const Affinef& to_world) const {
    static_assert(sizeof(Affinef) == 12 * sizeof(float));  // four columns
    RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, prototype);
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &to_world);
    attach(scene, instance);
  }

  RTCRayHit intersect(const RTCRay& ray) const {
    RTCRayHit query{ray, {}};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(scene, &query);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &query);
#endif
    return query;
  }

  void intersect(const int* valid, RTCRayHit16& query) const {
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect16(valid, scene, &query);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect16(valid, scene, &context, &query);
#endif
  }

  void occluded(const int* valid, RTCRay16& query) const {
#if RTC_VERSION_MAJOR >= 4
    rtcOccluded16(valid, scene, &query);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded16(valid, scene, &context, &query);
#endif
  }

  bool occluded(RTCRay ray) const {
#if RTC_VERSION_MAJOR >= 4
    rtcOccluded1(scene, &ray);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
#endif
    return ray.tfar < 0.0f;
  }
};

Accel::Accel(Geometry& geometry, std::span<const Surface> surfaces, bool finds_crossings)
    : handles_(std::make_unique<Handles>(finds_crossings)),
      baked_shapes_(static_cast<std::uint32_t>(geometry.baked_shape_count())) {
  geometry.positions.reserve(geometry.positions.size() + 1);
  for (const Shape& shape : geometry.shapes) first_triangle_.push_back(shape.first_triangle);
  handles_->attach_shapes(handles_->scene, geometry, surfaces, 0, baked_shapes_);

  // Prototypes are scenes of their own; the instances keep them alive.
  std::vector<SceneHandle> prototypes;
  for (const Prototype& prototype : geometry.prototypes) {
    prototypes.push_back(handles_->new_scene());
    handles_->attach_shapes(prototypes.back().get(), geometry, surfaces, prototype.first_shape,
                            prototype.shape_count);
    rtcCommitScene(prototypes.back().get());
  }
  for (const Instance& instance : geometry.instances) {
    handles_->attach_instance(prototypes[instance.prototype].get(), instance.to_world);
    first_shape_.push_back(geometry.prototypes[instance.prototype].first_shape);
  }
  rtcCommitScene(handles_->scene);
  if (!handles_->error.empty()) throw std::runtime_error("Embree: " + handles_->error);
}

Accel::~Accel() = default;
Accel::Accel(Accel&&) noexcept = default;
Accel& Accel::operator=(Accel&&) noexcept = default;

RTCSceneTy* Accel::embree_scene() const {
  return handles_->scene;
}

Hit Accel::make_hit(std::uint32_t geometry, std::uint32_t primitive, std::uint32_t instance, float u, float v,
                    float t) const {
  if (geometry == RTC_INVALID_GEOMETRY_ID) return {};
  if (instance == RTC_INVALID_GEOMETRY_ID)
    return {geometry, first_triangle_[geometry] + primitive, kNoInstance, u, v, t};
  const std::uint32_t index = instance - baked_shapes_, shape = first_shape_[index] + geometry;
  return {shape, first_triangle_[shape] + primitive, index, u, v, t};
}

Hit Accel::intersect(const Ray& ray) const {
  if (!is_traceable(ray)) return {};
  const auto [found, hit] =
      handles_->intersect(make_ray(ray.origin, ray.direction, std::numeric_limits<float>::infinity()));
  return make_hit(hit.geomID, hit.primID, hit.instID[0], hit.u, hit.v, found.tfar);
}

bool Accel::occluded(const Ray& ray, float t_max) const {
  if (!is_traceable(ray)) return false;
  return handles_->occluded(make_ray(ray.origin, ray.direction, t_max));
}

double Accel::radius() const {
  if (first_triangle_.empty()) return 0.0;
  RTCBounds b;
  rtcGetSceneBounds(handles_->scene, &b);
  const double x = b.upper_x - b.lower_x, y = b.upper_y - b.lower_y, z = b.upper_z - b.lower_z;
  return 0.5 * std::sqrt(x * x + y * y + z * z);
}

void Accel::intersect(const RayArray& rays, std::span<const std::uint32_t> slots, std::span<Hit> hits) const {
  for (std::size_t first = 0; first < slots.size(); first += kPacket) {
    const Packet packet(slots, first);
    alignas(64) RTCRayHit16 query;
    alignas(64) std::array<int, kPacket> valid;
    load(rays, packet, query.ray, valid);
    store(query.ray.tfar, Lanes{} + std::numeric_limits<float>::infinity());
    store(query.hit.geomID, UintLanes{} + RTC_INVALID_GEOMETRY_ID);
    handles_->intersect(valid.data(), query);
    for (int i = 0; i < packet.count; ++i) {
      const auto& hit = query.hit;
      hits[packet[i]] =
          make_hit(hit.geomID[i], hit.primID[i], hit.instID[0][i], hit.u[i], hit.v[i], query.ray.tfar[i]);
    }
  }
}

void Accel::occluded(const RayArray& rays, std::span<const std::uint32_t> slots,
                     std::span<std::uint8_t> blocked) const {
  for (std::size_t first = 0; first < slots.size(); first += kPacket) {
    const Packet packet(slots, first);
    alignas(64) RTCRay16 query;
    alignas(64) std::array<int, kPacket> valid;
    load(rays, packet, query, valid);
    store(query.tfar, gather(rays.t_max.data(), packet));
    handles_->occluded(valid.data(), query);
    for (int i = 0; i < packet.count; ++i) blocked[packet[i]] = query.tfar[i] < 0.0f;
  }
}

}  // namespace photopic
