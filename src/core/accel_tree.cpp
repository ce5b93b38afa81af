#include "core/accel_tree.h"

#include <bit>
#include <stdexcept>

#include "core/sample_sequence.h"
#include "core/touching.h"

namespace photopic {
namespace {

/// Embree calls this from inside, where nothing may be thrown: the message is kept until it returns.
void keep_error(void* kept, RTCError, const char* message) {
  *static_cast<std::string*>(kept) = message;
}

/// A number in [0, 1) for a ray and a triangle of a shape, whatever stands beside it in a batch: as pbrt-v4
/// does (GeometricPrimitive::Intersect).
float hash_to_unit(const RTCFilterFunctionNArguments& a, unsigned i, std::uint32_t triangle) {
  std::uint32_t hash = triangle * 0x9e3779b9u + RTCHitN_geomID(a.hit, a.N, i);
  for (const float x :
       {RTCRayN_org_x(a.ray, a.N, i), RTCRayN_org_y(a.ray, a.N, i), RTCRayN_org_z(a.ray, a.N, i),
        RTCRayN_dir_x(a.ray, a.N, i), RTCRayN_dir_y(a.ray, a.N, i), RTCRayN_dir_z(a.ray, a.N, i)})
    hash = mix_bits(hash * 31u + std::bit_cast<std::uint32_t>(x));
  return static_cast<float>(hash >> 8) * 0x1p-24f;
}

RTCSceneFlags scene_flags(bool finds_crossings) {
  if (!finds_crossings) return RTC_SCENE_FLAG_ROBUST;
    // A query's own filter wants to be announced.
#if RTC_VERSION_MAJOR >= 4
  return RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;
#else
  return RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
#endif
}

}  // namespace

/// What lets rays through a shape that covers in part, and shadow rays through panes.
struct Accel::Tree::Sieve {
  const Geometry& geometry;
  const Surface& surface;
  bool is_pane;
  PrimitiveRange range;

  /// Embree's filter, for nearest hits and for shadows.
  static void filter(const RTCFilterFunctionNArguments* a) {
    const Sieve& sieve = *static_cast<const Sieve*>(a->geometryUserPtr);
    for (unsigned i = 0; i < a->N; ++i) {
      if (a->valid[i] == 0) continue;
      const auto [triangle, u, v] = sieve.range.locate(
          RTCHitN_primID(a->hit, a->N, i), RTCHitN_u(a->hit, a->N, i), RTCHitN_v(a->hit, a->N, i));
      const float coverage = sieve.surface.coverage(TrianglePoint(sieve.geometry, triangle, u, v));
      if (coverage < 1.0f && hash_to_unit(*a, i, triangle - sieve.range.first_triangle) >= coverage)
        a->valid[i] = 0;
    }
  }

  static void filter_shadow(const RTCFilterFunctionNArguments* a) {
    const Sieve& sieve = *static_cast<const Sieve*>(a->geometryUserPtr);
    if (sieve.surface.partly_covers) filter(a);
    if (!sieve.is_pane) return;
    auto& shadow = *reinterpret_cast<ShadowContext*>(a->context);
    for (unsigned i = 0; i < a->N; ++i) {
      if (a->valid[i] == 0) continue;
      shadow.met_panes |= 1u << RTCRayN_id(a->ray, a->N, i);
      a->valid[i] = 0;
    }
  }

  void attach(RTCGeometry mesh) {
    rtcSetGeometryUserData(mesh, this);
    if (surface.partly_covers) rtcSetGeometryIntersectFilterFunction(mesh, filter);
    rtcSetGeometryOccludedFilterFunction(mesh, filter_shadow);
  }
};

Accel::Tree::Tree(Geometry& geometry, std::span<const Surface> surfaces, const Quads* quads,
                  std::span<const float> touching)
    : flags_(scene_flags(!touching.empty())), quads_(quads), device_(rtcNewDevice(nullptr)) {
  if (!device_) throw std::runtime_error("Embree: no device");
  rtcSetDeviceErrorFunction(device_.get(), keep_error, &error_);
  scene_ = new_scene();
  geometry.positions.reserve(geometry.positions.size() + 1);
  if (quads_) {
    ranges_ = quads_->ranges;
  } else {
    for (const Shape& shape : geometry.shapes) ranges_.push_back({.first_triangle = shape.first_triangle});
  }
  attach_shapes(scene(), geometry, surfaces, touching, 0, geometry.baked_shape_count());

  // Prototypes are scenes of their own; the instances keep them alive.
  std::vector<SceneHandle> prototypes;
  for (const Prototype& prototype : geometry.prototypes) {
    prototypes.push_back(new_scene());
    attach_shapes(prototypes.back().get(), geometry, surfaces, touching, prototype.first_shape,
                  prototype.shape_count);
    rtcCommitScene(prototypes.back().get());
  }
  for (const Instance& instance : geometry.instances)
    attach_instance(prototypes[instance.prototype].get(), instance.to_world);
  rtcCommitScene(scene());
  if (!error_.empty()) throw std::runtime_error("Embree: " + error_);
}

Accel::Tree::~Tree() = default;

SceneHandle Accel::Tree::new_scene() const {
  SceneHandle made(rtcNewScene(device_.get()));
  rtcSetSceneFlags(made.get(), flags_);
  rtcSetSceneBuildQuality(made.get(), RTC_BUILD_QUALITY_HIGH);
  return made;
}

void Accel::Tree::attach(RTCScene to, RTCGeometry made) const {
  rtcCommitGeometry(made);
  rtcAttachGeometry(to, made);
  rtcReleaseGeometry(made);
}

RTCGeometry Accel::Tree::new_mesh(const Geometry& geometry, std::size_t i) const {
  const auto type = quads_ ? RTC_GEOMETRY_TYPE_QUAD : RTC_GEOMETRY_TYPE_TRIANGLE;
  RTCGeometry mesh = rtcNewGeometry(device_.get(), type);
  rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, geometry.positions.data(), 0,
                             sizeof(Vec3f), geometry.positions.size());
  const auto set_indices = [&](RTCFormat format, const auto& list, std::size_t first, std::size_t count) {
    constexpr std::size_t kSize = sizeof(list[0]);
    rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, format, list.data(), first * kSize, kSize,
                               count);
  };
  if (quads_)
    set_indices(RTC_FORMAT_UINT4, quads_->quads, quads_->first[i], quads_->first[i + 1] - quads_->first[i]);
  else
    set_indices(RTC_FORMAT_UINT3, geometry.triangles, geometry.shapes[i].first_triangle,
                geometry.shapes[i].triangle_count);
  return mesh;
}

void Accel::Tree::attach_shapes(RTCScene to, const Geometry& geometry, std::span<const Surface> surfaces,
                                std::span<const float> touching, std::size_t first, std::size_t count) {
  for (std::size_t i = first; i < first + count; ++i) {
    RTCGeometry mesh = new_mesh(geometry, i);
    const Surface& surface = surfaces[geometry.shapes[i].material];
    const bool is_pane = is_free_pane(geometry.shapes[i], surface, touching);
    if (surface.partly_covers || is_pane) {
      sieves_.push_back(std::make_unique<Sieve>(Sieve{geometry, surface, is_pane, ranges_[i]}));
      sieves_.back()->attach(mesh);
    }
    attach(to, mesh);
  }
}

void Accel::Tree::attach_instance(RTCScene prototype, const Affinef& to_world) const {
  static_assert(sizeof(Affinef) == 12 * sizeof(float));  // four columns
  RTCGeometry instance = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(instance, prototype);
  rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &to_world);
  attach(scene(), instance);
}

}  // namespace photopic
