#pragma once

#if PHOTOPIC_EMBREE >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/accel.h"
#include "core/surface.h"

namespace photopic {

struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using SceneHandle = std::unique_ptr<RTCSceneTy, ReleaseScene>;

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};

/// What Embree holds, and the ways of asking it that differ from version 3 to 4. For accel*.cpp alone.
class Accel::Tree {
 public:
  /// @throws std::runtime_error when Embree fails
  Tree(Geometry& geometry, std::span<const Surface> surfaces, const Quads* quads,
       std::span<const float> touching);
  ~Tree();
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;

  RTCScene scene() const { return scene_.get(); }
  const std::vector<PrimitiveRange>& ranges() const { return ranges_; }

  RTCRayHit intersect(const RTCRay& ray) const {
    RTCRayHit query{ray, {}};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(scene(), &query);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene(), &context, &query);
#endif
    return query;
  }

  void intersect(const int* valid, RTCRayHit16& query, bool coherent) const {
#if RTC_VERSION_MAJOR >= 4
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    if (coherent) arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcIntersect16(valid, scene(), &query, &arguments);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    if (coherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(valid, scene(), &context, &query);
#endif
  }

  /// @return bits of the lanes that met panes
  std::uint32_t occluded(const int* valid, RTCRay16& query) const {
    ShadowContext shadow{{}, 0};
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&shadow.context);
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &shadow.context;
    rtcOccluded16(valid, scene(), &query, &arguments);
#else
    rtcInitIntersectContext(&shadow.context);
    rtcOccluded16(valid, scene(), &shadow.context, &query);
#endif
    return shadow.met_panes;
  }

 private:
  struct Sieve;

  /// Embree hands its first member to filters.
  struct ShadowContext {
#if RTC_VERSION_MAJOR >= 4
    RTCRayQueryContext context;
#else
    RTCIntersectContext context;
#endif
    std::uint32_t met_panes;  ///< bits of the rays' ids
  };

  SceneHandle new_scene() const;
  void attach(RTCScene to, RTCGeometry made) const;
  RTCGeometry new_mesh(const Geometry& geometry, std::size_t shape) const;
  void attach_shapes(RTCScene to, const Geometry& geometry, std::span<const Surface> surfaces,
                     std::span<const float> touching, std::size_t first, std::size_t count);
  void attach_instance(RTCScene prototype, const Affinef& to_world) const;

  RTCSceneFlags flags_;
  const Quads* quads_;  ///< none: the BVH is of triangles
  std::string error_;   ///< the last that Embree reported
  std::vector<std::unique_ptr<Sieve>> sieves_;
  std::vector<PrimitiveRange> ranges_;  ///< of each shape
  std::unique_ptr<RTCDeviceTy, ReleaseDevice> device_;
  SceneHandle scene_;
};

}  // namespace photopic
