#include <algorithm>
#include <array>

#include "core/accel_tree.h"

namespace photopic {
namespace {

#if RTC_VERSION_MAJOR >= 4
using Context = RTCRayQueryContext;
#else
using Context = RTCIntersectContext;
#endif

struct Crossing {
  std::uint32_t geometry, primitive, instance;
  float u, v, t;

  bool is_second() const { return u + v > 1.0f; }  ///< of a pair's triangles
  bool same_triangle(const Crossing& c) const {
    return geometry == c.geometry && primitive == c.primitive && instance == c.instance &&
           is_second() == c.is_second();
  }
};

/// What a query has met so far. Embree hands its first member to the filter.
struct Query {
  Context context;
  std::span<Crossing> room;
  std::size_t count;

  /// Keeps each hit and takes none, so that the ray goes on. (Split triangles may be met twice.)
  static void keep(const RTCFilterFunctionNArguments* a) {
    if (a->valid[0] == 0) return;
    a->valid[0] = 0;
    Query& q = *reinterpret_cast<Query*>(a->context);
    const Crossing c{RTCHitN_geomID(a->hit, 1, 0),    RTCHitN_primID(a->hit, 1, 0),
                     RTCHitN_instID(a->hit, 1, 0, 0), RTCHitN_u(a->hit, 1, 0),
                     RTCHitN_v(a->hit, 1, 0),         RTCRayN_tfar(a->ray, 1, 0)};
    const auto met = q.room.first(q.count);
    if (q.count == q.room.size() || std::ranges::any_of(met, [&](auto& m) { return m.same_triangle(c); }))
      return;
    q.room[q.count++] = c;
  }
};

}  // namespace

std::size_t Accel::crossings(const Ray& ray, float t_max, std::span<Hit> found) const {
  if (!is_traceable(ray)) return 0;
  constexpr std::size_t kMost = 32;
  std::array<Crossing, kMost> room;
  Query query{{}, std::span(room).first(std::min(kMost, found.size())), 0};
  RTCRayHit hit{};
  hit.ray.org_x = ray.origin.x, hit.ray.org_y = ray.origin.y, hit.ray.org_z = ray.origin.z;
  hit.ray.dir_x = ray.direction.x, hit.ray.dir_y = ray.direction.y, hit.ray.dir_z = ray.direction.z;
  hit.ray.tfar = t_max, hit.ray.mask = ~0u;
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
  rtcInitRayQueryContext(&query.context);
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &query.context, arguments.filter = Query::keep;
  arguments.flags =
      static_cast<RTCRayQueryFlags>(arguments.flags | RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER);
  rtcIntersect1(tree_->scene(), &hit, &arguments);
#else
  rtcInitIntersectContext(&query.context);
  query.context.filter = Query::keep;
  rtcIntersect1(tree_->scene(), &query.context, &hit);
#endif
  for (std::size_t i = 0; i < query.count; ++i) {
    const Crossing& c = room[i];
    found[i] = make_hit(c.geometry, c.primitive, c.instance, c.u, c.v, c.t);
  }
  return query.count;
}

}  // namespace photopic
