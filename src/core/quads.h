#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/lanes.h"
#include "core/scene.h"

namespace photopic {

/// Two triangles as one of Embree's quadrilaterals, by their corners: 0, 1, 3 are the first, 2, 3, 1 the
/// second. One triangle alone has its last corner twice.
using Quad = std::array<std::uint32_t, 4>;

/// A shape's primitives in the BVH: triangles, or pairs of them and then triangles.
struct PrimitiveRange {
  std::uint32_t first_triangle = 0;
  std::uint32_t pairs = 0;  ///< the first primitives are two triangles each

  /// Of one hit, or of 16.
  template <typename U, typename T>
  struct TriangleHit {
    U triangle;  ///< index into Geometry::triangles
    T u, v;      ///< barycentric coordinates of its second and third corner
  };
  /// @param first, pairs a range's numbers
  /// @param u and v as Embree has them: across a quadrilateral from its corner 0 to 1 and to 3
  template <typename U, typename T>
  static TriangleHit<U, T> locate(U first, U pairs, U primitive, T u, T v) {
    const auto second = (primitive < pairs) & (u + v > 1.0f);
    const U in_pair = 2u * primitive + (second ? U{} + 1u : U{});
    return {first + (primitive < pairs ? in_pair : pairs + primitive), select(second, 1.0f - u, u),
            select(second, 1.0f - v, v)};
  }
  TriangleHit<std::uint32_t, float> locate(std::uint32_t primitive, float u, float v) const {
    return locate(first_triangle, pairs, primitive, u, v);
  }
};

/// Whether the BVH is better made of pairs: it and its building take 0.6 times the memory (Embree 3.13: 48 +
/// 16 instead of 67 + 32 bytes a triangle) and rays into large scenes find their triangles 1.2 times as fast,
/// into small ones 0.93 times. So for many triangles, if most have a partner.
bool is_worth_pairing(const Geometry& geometry);

/// Pairs triangles that stand next to each other in a shape where they share an edge and are bent by less
/// than 60° at it; what exporters split or meshed in rows comes in this order. Reorders each shape's
/// triangles and their corners, pairs first.
struct Quads {
  explicit Quads(Geometry& geometry);

  /// None where that is not worth while.
  static std::unique_ptr<const Quads> pair_where_worth(Geometry& geometry);

  std::vector<Quad> quads;             ///< shape by shape
  std::vector<std::uint32_t> first;    ///< of each shape; and the end
  std::vector<PrimitiveRange> ranges;  ///< of each shape
};

}  // namespace photopic
