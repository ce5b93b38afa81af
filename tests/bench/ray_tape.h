#pragma once

#if PHOTOPIC_EMBREE >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace photopic {

inline constexpr std::size_t kPacketSize = 16;

/// Rays as they were handed to Embree in one call.
struct RayPacket {
  using Lanes = std::array<float, kPacketSize>;
  Lanes org_x{}, org_y{}, org_z{}, dir_x{}, dir_y{}, dir_z{}, tnear{}, tfar{};
  std::uint32_t flags = 0;  ///< of the context: coherent or not
  std::uint16_t valid = 0;  ///< a bit a lane
  bool shadow = false;
};

/// All rays of a render, in their order.
struct RayTape {
  RTCScene scene = nullptr;
  std::vector<RayPacket> packets;
  std::uint64_t rays = 0, shadow_rays = 0;
  std::uint64_t hits = 0, blocked = 0;  ///< what Embree answered
};

/// While it lives, whatever the calling thread hands to rtcIntersect16 and rtcOccluded16 is recorded. (This
/// program's functions of these names stand before Embree's: the renderer knows nothing of it.)
class Recording {
 public:
  explicit Recording(RayTape& tape);
  ~Recording();
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;
};

/// The same rays in full packets without any order, nor marked as coherent: nearest-hit rays, then shadow
/// rays.
std::vector<RayPacket> shuffled(std::span<const RayPacket> packets);

/// What tracing packets again came to.
struct Traversal {
  double seconds = 0;  ///< CPU, of Embree's calls alone
  std::uint64_t hits = 0, blocked = 0;
};

/// Hands the packets to Embree's own functions, some at a time, ready in buffers before the clock starts.
Traversal traverse(RTCScene scene, std::span<const RayPacket> packets);

}  // namespace photopic
