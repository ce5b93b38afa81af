#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "core/quads.h"
#include "core/ray.h"
#include "core/row_array.h"
#include "core/scene.h"

namespace photopic {

/// Rays that stand in slots; t counts in lengths of the direction.
struct RayArray {
  RowArray origin;
  RowArray direction;  ///< and t_max
  explicit RayArray(std::size_t size) : origin(size), direction(size) {}

  Ray operator[](std::size_t i) const { return {origin[i], direction[i]}; }
  float t_max(std::size_t i) const { return direction.w(i); }
  void set(std::size_t i, const Ray& ray, float t_max = std::numeric_limits<float>::infinity()) {
    origin.set(i, ray.origin), direction.set(i, ray.direction, t_max);
  }
  /// Of nearest hits, which know no t_max.
  PHOTOPIC_INLINE void scatter(const Packet& p, const RayLanes& rays) {
    origin.scatter(p, rows_of(rays.origin)), direction.scatter(p, rows_of(rays.direction));
  }
};

inline constexpr std::uint32_t kNoHit = ~0u, kNoInstance = ~0u;

/// Where a ray meets a triangle. Half a line of memory, which is written as one.
struct alignas(32) Hit {
  std::uint32_t shape = kNoHit;
  std::uint32_t triangle = kNoHit;       ///< index into Geometry::triangles
  std::uint32_t instance = kNoInstance;  ///< index into Geometry::instances, if the shape is a prototype's
  float u = 0, v = 0;                    ///< barycentric coordinates of the second and third vertex
  float t = 0;                           ///< in lengths of the ray's direction
};

/// What is in a shadow ray's way.
enum class Shadow : std::uint8_t {
  clear,     ///< nothing
  blocked,   ///< something but panes
  by_panes,  ///< panes alone: ShapeTraits::is_pane
};

struct Surface;

/// The bounding volume hierarchy: the only home of Embree (3.13 or 4).
class Accel {
 public:
  /// Builds with TBB over the geometry's own buffers, which must stay where they are. (Embree reads vertices
  /// 16 bytes at a time, so positions get room for one more.) Rays pass surfaces that cover a point in part
  /// as a hash of the ray and the triangle decides. @param surfaces of Shape::material; must stay where they
  /// are @param quads the geometry's triangles in pairs, or none: then the BVH is made of triangles
  /// @param touching as touching_triangles gives them: what touches is no pane; where any does, crossings()
  /// may be asked
  /// @throws std::runtime_error when Embree does
  Accel(Geometry& geometry, std::span<const Surface> surfaces, const Quads* quads = nullptr,
        std::span<const float> touching = {});
  ~Accel();
  Accel(Accel&&) noexcept;
  Accel& operator=(Accel&&) noexcept;

  /// The nearest hit with 0 < t of the rays in the given slots. What is not traceable hits nothing, here and
  /// below. @param coherent whether the rays go nearly the same way, as those from the camera do: it changes
  /// how they are traced, not what they hit
  void intersect(const RayArray& rays, std::span<const std::uint32_t> slots, std::span<Hit> hits,
                 bool coherent = false) const;

  /// Whether something lies at 0 < t < t_max.
  void occluded(const RayArray& rays, std::span<const std::uint32_t> slots, std::span<Shadow> shadows) const;

  Hit intersect(const Ray& ray) const;

  /// All triangles that a ray meets at 0 < t < t_max, each once, in no order.
  /// @return how many are stored in `found`: where there are more than it holds, those that came first
  std::size_t crossings(const Ray& ray, float t_max, std::span<Hit> found) const;

  /// Of a sphere that holds the scene, wherever its middle [m]; 0 when there is nothing.
  double radius() const;

 private:
  class Tree;
  /// Of Embree's numbers.
  Hit make_hit(std::uint32_t geometry, std::uint32_t primitive, std::uint32_t instance, float u, float v,
               float t) const;

  template <typename Query>
  void store_hits(const Query& query, const Packet& slots, std::span<Hit> hits) const;

  std::unique_ptr<const Tree> tree_;
  std::vector<PrimitiveRange> ranges_;      ///< of each shape
  std::uint32_t baked_shapes_;              ///< stand before the instances in Embree's numbers
  std::vector<std::uint32_t> first_shape_;  ///< of each instance
};

}  // namespace photopic
