#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/box.h"
#include "core/gltf/vertex_selection.h"

namespace photopic {

enum class Closure : unsigned char { closed, inside_out, open };

/// Triangles of one mesh, as it has them at its default weights. A node that mirrors them turns them, too.
class MeshSurface {
 public:
  void add(const GltfDocument& document, const PrimitiveRef& ref) {
    const auto first = static_cast<std::uint32_t>(positions_.size());
    const VertexSelection selection(document, ref);
    const auto positions = read_morphed<Vec3f>(document, ref, -1, "POSITION");
    selection.for_each(positions.size(), [&](std::size_t, std::size_t i) {  // places rise from 0
      positions_.push_back(positions[i]);
      box_.add(to_double(positions[i]));
    });
    for_each_triangle(document, ref, [&](Triangle t) {
      for (std::uint32_t& corner : t) corner = first + selection.place_of(corner);
      triangles_.push_back(t);
    });
  }

  const Boxd& box() const { return box_; }

  /// Closed: each edge is run through as often one way as the other. Inside out: the volume is negative.
  Closure closure() const {
    // Vertices in one cell of a grid count as one: exporters split them where normals or coordinates differ,
    // and seams round. That opens nothing. A border between cells may part a seam, but not of all grids.
    constexpr double kShifts[] = {0.3, 0.55, 0.8, 0.05};
    if (std::ranges::none_of(kShifts, [&](double shift) { return edge_sum(shift) == 0; }))
      return Closure::open;
    return is_inside_out() ? Closure::inside_out : Closure::closed;
  }

 private:
  double size() const { return box_.is_empty() ? 0.0 : max_abs(box_.high - box_.low); }

  /// splitmix64's finaliser (Steele et al. 2014).
  static std::uint64_t scramble(std::uint64_t x) {
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9;
    x = (x ^ x >> 27) * 0x94d049bb133111eb;
    return x ^ x >> 31;
  }

  /// Of a random number for each edge, negative one way: 0 where all cancel, else by a chance of 2⁻⁶⁴. No
  /// list of edges has to be sorted.
  std::uint64_t edge_sum(double shift) const {
    constexpr double kCells = 1 << 14;
    const double scale = size() > 0.0 ? kCells / size() : 0.0;
    std::vector<std::uint64_t> ends;
    ends.reserve(positions_.size());
    for (const Vec3f p : positions_) {
      const Vec3d cell = (to_double(p) - box_.low) * scale + Vec3d{shift, shift, shift};
      const auto part = [](double x) { return static_cast<std::uint64_t>(x); };
      ends.push_back(scramble(1 + (part(cell.x) | part(cell.y) << 20 | part(cell.z) << 40)));
    }
    std::uint64_t sum = 0;
    for (const Triangle& t : triangles_)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint64_t a = ends[t[k]], b = ends[t[(k + 1) % 3]];
        if (a < b) sum += scramble(a + 3 * b);
        if (b < a) sum -= scramble(b + 3 * a);
      }
    return sum;
  }

  /// By more than single precision may have rounded.
  bool is_inside_out() const {
    constexpr double kRounding = 1e-6;
    const Vec3d middle = box_.middle();
    double volume = 0.0, area = 0.0;  // 6 and 2 times
    for (const Triangle& t : triangles_) {
      const Vec3d a = to_double(positions_[t[0]]) - middle;
      const Vec3d normal =
          cross(to_double(positions_[t[1]]) - middle - a, to_double(positions_[t[2]]) - middle - a);
      volume += dot(a, normal);
      area += length(normal);
    }
    return volume < -kRounding * area * size();
  }

  std::vector<Vec3f> positions_;
  std::vector<Triangle> triangles_;
  Boxd box_;
};

}  // namespace photopic
