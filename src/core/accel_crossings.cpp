#include <algorithm>

#include "core/accel_tree.h"

namespace photopic {
namespace {

#if RTC_VERSION_MAJOR >= 4
using Context = RTCRayQueryContext;
#else
using Context = RTCIntersectContext;
#endif

/// What a query has met so far. Embree hands its first member to the filter.
struct Query {
  Context context;
  const Accel& accel;
  std::span<Hit> found;
  std::size_t count;
};

}  // namespace

std::size_t Accel::crossings(const Ray& ray, float t_max, std::span<Hit> found) const {
  if (!is_traceable(ray)) return 0;
  // Keeps each hit and takes none, so that the ray goes on. (Split triangles may be met twice.)
  const auto keep = [](const RTCFilterFunctionNArguments* a) {
    if (a->valid[0] == 0) return;
    a->valid[0] = 0;
    Query& q = *reinterpret_cast<Query*>(a->context);
    const Hit hit = q.accel.make_hit(RTCHitN_geomID(a->hit, 1, 0), RTCHitN_primID(a->hit, 1, 0),
                                     RTCHitN_instID(a->hit, 1, 0, 0), RTCHitN_u(a->hit, 1, 0),
                                     RTCHitN_v(a->hit, 1, 0), RTCRayN_tfar(a->ray, 1, 0));
    const auto same = [&](const Hit& h) { return h.triangle == hit.triangle && h.instance == hit.instance; };
    if (q.count < q.found.size() && std::ranges::none_of(q.found.first(q.count), same))
      q.found[q.count++] = hit;
  };
  Query query{{}, *this, found, 0};
  RTCRayHit hit{};
  hit.ray.org_x = ray.origin.x, hit.ray.org_y = ray.origin.y, hit.ray.org_z = ray.origin.z;
  hit.ray.dir_x = ray.direction.x, hit.ray.dir_y = ray.direction.y, hit.ray.dir_z = ray.direction.z;
  hit.ray.tfar = t_max, hit.ray.mask = ~0u;
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
  rtcInitRayQueryContext(&query.context);
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &query.context, arguments.filter = keep;
  arguments.flags =
      static_cast<RTCRayQueryFlags>(arguments.flags | RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER);
  rtcIntersect1(tree_->scene(), &hit, &arguments);
#else
  rtcInitIntersectContext(&query.context);
  query.context.filter = keep;
  rtcIntersect1(tree_->scene(), &query.context, &hit);
#endif
  return query.count;
}

}  // namespace photopic
