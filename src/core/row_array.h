#pragma once

#include <array>
#include <bit>
#include <vector>

#include "core/lane_rows.h"
#include "core/math.h"

namespace photopic {

/// Vectors and a number beside each as rows, one a lane.
PHOTOPIC_INLINE std::array<Vec4f, kLanes> rows_of(const Vec3Lanes& v, const Lanes& w = Lanes{}) {
  return std::bit_cast<std::array<Vec4f, kLanes>>(rows_of(std::array<Lanes, 4>{v.x, v.y, v.z, w}));
}

/// A vector and a number w in each slot.
class RowArray {
 public:
  explicit RowArray(std::size_t size) : rows_(size) {}

  bool empty() const { return rows_.empty(); }
  Vec3f operator[](std::size_t i) const { return {rows_[i].x, rows_[i].y, rows_[i].z}; }
  float w(std::size_t i) const { return rows_[i].w; }
  void set(std::size_t i, const Vec4f& row) { rows_[i] = row; }
  void set(std::size_t i, Vec3f v, float w = 0) { rows_[i] = {v.x, v.y, v.z, w}; }
  void set_w(std::size_t i, float w) { rows_[i].w = w; }
  PHOTOPIC_INLINE void scatter(const Packet& p, const std::array<Vec4f, kLanes>& rows) {
    for (int i = 0; i < p.count; ++i) rows_[p[i]] = rows[static_cast<std::size_t>(i)];
  }

  /// x, y, z and w.
  PHOTOPIC_INLINE std::array<Lanes, 4> gather(const Packet& p) const {
    return gather_rows<4>([&](int i) { return &rows_[p[i]]; });
  }
  PHOTOPIC_INLINE Vec3Lanes gather_vectors(const Packet& p) const {
    const auto [x, y, z, w] = gather(p);
    return {x, y, z};
  }

 private:
  std::vector<Vec4f> rows_;
};

}  // namespace photopic
