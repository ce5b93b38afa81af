#include "ray_tape.h"

#include <dlfcn.h>
#include <xmmintrin.h>

#include <algorithm>
#include <bit>
#include <memory>
#include <numeric>
#include <random>
#include <stdexcept>

#include "bench_scene.h"

namespace photopic {
namespace {

#if RTC_VERSION_MAJOR >= 4
using Context = RTCIntersectArguments;
using OcclusionContext = RTCOccludedArguments;
using Intersect16 = void(const int*, RTCScene, RTCRayHit16*, RTCIntersectArguments*);
using Occluded16 = void(const int*, RTCScene, RTCRay16*, RTCOccludedArguments*);
#else
using Context = RTCIntersectContext;
using OcclusionContext = RTCIntersectContext;
using Intersect16 = void(const int*, RTCScene, RTCIntersectContext*, RTCRayHit16*);
using Occluded16 = void(const int*, RTCScene, RTCIntersectContext*, RTCRay16*);
#endif

/// Embree's own, behind this program's of the same name.
Intersect16* const embree_intersect16 = reinterpret_cast<Intersect16*>(dlsym(RTLD_NEXT, "rtcIntersect16"));
Occluded16* const embree_occluded16 = reinterpret_cast<Occluded16*>(dlsym(RTLD_NEXT, "rtcOccluded16"));

thread_local RayTape* recording = nullptr;

void call_intersect16(const int* valid, RTCScene scene, Context* context, RTCRayHit16* query) {
#if RTC_VERSION_MAJOR >= 4
  embree_intersect16(valid, scene, query, context);
#else
  embree_intersect16(valid, scene, context, query);
#endif
}

void call_occluded16(const int* valid, RTCScene scene, OcclusionContext* context, RTCRay16* query) {
#if RTC_VERSION_MAJOR >= 4
  embree_occluded16(valid, scene, query, context);
#else
  embree_occluded16(valid, scene, context, query);
#endif
}

Context make_context(std::uint32_t flags) {
  Context context;
#if RTC_VERSION_MAJOR >= 4
  rtcInitIntersectArguments(&context);
#else
  rtcInitIntersectContext(&context);
#endif
  context.flags = static_cast<decltype(context.flags)>(flags);
  return context;
}

/// A packet as Embree takes it.
struct alignas(64) Query {
  RTCRayHit16 rays;
  std::array<int, kPacketSize> valid;
};

/// With room for what the renderer's filters note behind Embree's own part.
struct ShadowContext {
#if RTC_VERSION_MAJOR >= 4
  RTCRayQueryContext context;
#else
  RTCIntersectContext context;
#endif
  std::array<std::uint32_t, 4> notes{};
};

void call_occluded16(RTCScene scene, std::uint32_t flags, Query& query) {
  ShadowContext shadow;
#if RTC_VERSION_MAJOR >= 4
  rtcInitRayQueryContext(&shadow.context);
  OcclusionContext arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &shadow.context;
  OcclusionContext* context = &arguments;
#else
  rtcInitIntersectContext(&shadow.context);
  OcclusionContext* context = &shadow.context;
#endif
  context->flags = static_cast<decltype(context->flags)>(flags);
  call_occluded16(query.valid.data(), scene, context, &query.rays.ray);
}

template <typename AnyContext>
std::uint32_t flags_of(const AnyContext* context) {
  return context != nullptr ? static_cast<std::uint32_t>(context->flags) : 0u;
}

void copy_lanes(const float* from, RayPacket::Lanes& to) {
  std::copy_n(from, kPacketSize, to.begin());
}

RayPacket make_packet(const int* valid, const RTCRay16& r, std::uint32_t flags, bool shadow) {
  RayPacket p;
  copy_lanes(r.org_x, p.org_x), copy_lanes(r.org_y, p.org_y), copy_lanes(r.org_z, p.org_z);
  copy_lanes(r.dir_x, p.dir_x), copy_lanes(r.dir_y, p.dir_y), copy_lanes(r.dir_z, p.dir_z);
  copy_lanes(r.tnear, p.tnear), copy_lanes(r.tfar, p.tfar);
  for (std::size_t i = 0; i < kPacketSize; ++i)
    if (valid[i] != 0) p.valid = static_cast<std::uint16_t>(p.valid | 1u << i);
  p.flags = flags;
  p.shadow = shadow;
  return p;
}

void load(const RayPacket& p, Query& query) {
  RTCRay16& r = query.rays.ray;
  std::ranges::copy(p.org_x, r.org_x), std::ranges::copy(p.org_y, r.org_y),
      std::ranges::copy(p.org_z, r.org_z);
  std::ranges::copy(p.dir_x, r.dir_x), std::ranges::copy(p.dir_y, r.dir_y),
      std::ranges::copy(p.dir_z, r.dir_z);
  std::ranges::copy(p.tnear, r.tnear), std::ranges::copy(p.tfar, r.tfar);
  std::fill_n(r.time, kPacketSize, 0.0f);
  std::fill_n(r.mask, kPacketSize, ~0u);
  std::fill_n(r.flags, kPacketSize, 0u);
  std::iota(r.id, r.id + kPacketSize, 0u);
  std::fill_n(query.rays.hit.geomID, kPacketSize, RTC_INVALID_GEOMETRY_ID);
  for (auto& ids : query.rays.hit.instID) std::fill_n(ids, kPacketSize, RTC_INVALID_GEOMETRY_ID);
  for (std::size_t i = 0; i < kPacketSize; ++i) query.valid[i] = (p.valid >> i & 1u) != 0 ? -1 : 0;
}

void call(RTCScene scene, const RayPacket& packet, Query& query) {
  if (packet.shadow) {
    call_occluded16(scene, packet.flags, query);
  } else {
    Context context = make_context(packet.flags);
    call_intersect16(query.valid.data(), scene, &context, &query.rays);
  }
}

std::uint64_t count_hits(const int* valid, const RTCHit16& hit) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < kPacketSize; ++i)
    count += valid[i] != 0 && hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
  return count;
}

std::uint64_t count_blocked(const int* valid, const RTCRay16& ray) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < kPacketSize; ++i) count += valid[i] != 0 && ray.tfar[i] < 0.0f;
  return count;
}

}  // namespace

Recording::Recording(RayTape& tape) {
  if (embree_intersect16 == nullptr || embree_occluded16 == nullptr)
    throw std::runtime_error("Embree's functions are not to be found: it must be a shared library");
  recording = &tape;
}
Recording::~Recording() {
  recording = nullptr;
}

std::vector<RayPacket> shuffled(std::span<const RayPacket> packets) {
  struct Place {
    std::uint32_t packet, lane;
  };
  std::mt19937 random(1);
  std::vector<RayPacket> result;
  for (const bool shadow : {false, true}) {
    std::vector<Place> rays;
    for (std::uint32_t p = 0; p < packets.size(); ++p)
      for (std::uint32_t i = 0; i < kPacketSize; ++i)
        if (packets[p].shadow == shadow && (packets[p].valid >> i & 1u) != 0) rays.push_back({p, i});
    std::ranges::shuffle(rays, random);
    for (std::size_t k = 0; k < rays.size(); ++k) {
      const std::size_t to = k % kPacketSize, from = rays[k].lane;
      const RayPacket& source = packets[rays[k].packet];
      if (to == 0) result.push_back({.shadow = shadow});  // with no flags: coherent they are not
      RayPacket& packet = result.back();
      for (const auto member : {&RayPacket::org_x, &RayPacket::org_y, &RayPacket::org_z, &RayPacket::dir_x,
                                &RayPacket::dir_y, &RayPacket::dir_z, &RayPacket::tnear, &RayPacket::tfar})
        (packet.*member)[to] = (source.*member)[from];
      packet.valid = static_cast<std::uint16_t>(packet.valid | 1u << to);
    }
  }
  return result;
}

Traversal traverse(RTCScene scene, std::span<const RayPacket> packets) {
  constexpr std::size_t kAtOnce = 64;  // about what a batch of paths hands over
  const auto queries = std::make_unique<std::array<Query, kAtOnce>>();
  Traversal done;
  const unsigned saved = _mm_getcsr();
  _mm_setcsr(saved | 0x8040);  // denormals are flushed, as the renderer does
  for (std::size_t first = 0; first < packets.size(); first += kAtOnce) {
    const auto some = packets.subspan(first, std::min(kAtOnce, packets.size() - first));
    for (std::size_t i = 0; i < some.size(); ++i) load(some[i], (*queries)[i]);
    const double start = thread_cpu_seconds();
    for (std::size_t i = 0; i < some.size(); ++i) call(scene, some[i], (*queries)[i]);
    done.seconds += thread_cpu_seconds() - start;
    for (std::size_t i = 0; i < some.size(); ++i) {
      const Query& query = (*queries)[i];
      if (some[i].shadow)
        done.blocked += count_blocked(query.valid.data(), query.rays.ray);
      else
        done.hits += count_hits(query.valid.data(), query.rays.hit);
    }
  }
  _mm_setcsr(saved);
  return done;
}

namespace {

void record_intersect(const int* valid, RTCScene scene, Context* context, RTCRayHit16* query) {
  recording->packets.push_back(make_packet(valid, query->ray, flags_of(context), false));
  recording->scene = scene;
  recording->rays += static_cast<std::uint64_t>(std::popcount(recording->packets.back().valid));
  call_intersect16(valid, scene, context, query);
  recording->hits += count_hits(valid, query->hit);
}

void record_occluded(const int* valid, RTCScene scene, OcclusionContext* context, RTCRay16* query) {
  recording->packets.push_back(make_packet(valid, *query, flags_of(context), true));
  recording->scene = scene;
  recording->shadow_rays += static_cast<std::uint64_t>(std::popcount(recording->packets.back().valid));
  call_occluded16(valid, scene, context, query);
  recording->blocked += count_blocked(valid, *query);
}

}  // namespace
}  // namespace photopic

using namespace photopic;

#if RTC_VERSION_MAJOR >= 4
void rtcIntersect16(const int* valid, RTCScene scene, RTCRayHit16* query, RTCIntersectArguments* context) {
#else
void rtcIntersect16(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRayHit16* query) {
#endif
  if (recording == nullptr)
    call_intersect16(valid, scene, context, query);
  else
    record_intersect(valid, scene, context, query);
}

#if RTC_VERSION_MAJOR >= 4
void rtcOccluded16(const int* valid, RTCScene scene, RTCRay16* query, RTCOccludedArguments* context) {
#else
void rtcOccluded16(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRay16* query) {
#endif
  if (recording == nullptr)
    call_occluded16(valid, scene, context, query);
  else
    record_occluded(valid, scene, context, query);
}
