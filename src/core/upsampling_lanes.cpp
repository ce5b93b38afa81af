#include "core/upsampling_lanes.h"

#include "spectral/rgb_table.h"

namespace photopic {
namespace {

using namespace rgb_table;

Lanes unit(Lanes v) {
  return select(v > 0.0f, min(v, Lanes{} + 1.0f), Lanes{});
}

/// As constant_sigmoid. @param value in [0, 1]
Lanes grey(Lanes value) {
  const Lanes most = Lanes{} + SigmoidPolynomial::kWhite, y = (value - 0.5f) / sqrt(value * (1.0f - value));
  return max(min(y, most), -most);
}

/// Where coordinates fall on an axis.
struct Places {
  explicit Places(Lanes x) {
    for (int i = 0; i < kLanes; ++i) cell[static_cast<std::size_t>(i)] = kAxis.find(lane(x, i));
    const auto [node, per_unit] =
        gather_rows<2>([&](int i) { return &kAxis[cell[static_cast<std::size_t>(i)]]; });
    fraction = (x - node) * per_unit;
  }
  std::array<int, kLanes> cell;
  Lanes fraction;
};

Lanes mix(Lanes a, Lanes b, Lanes f) {
  return a + (b - a) * f;
}

using Three = std::array<Lanes, 3>;

Three mix(const Three& a, const Three& b, Lanes f) {
  return {mix(a[0], b[0], f), mix(a[1], b[1], f), mix(a[2], b[2], f)};
}

/// @param largest channel of each lane
Three interpolate(const IntLanes& largest, const Places& z, const Places& y, const Places& x) {
  std::array<const float*, kLanes> first;
  for (std::size_t i = 0; i < kLanes; ++i)
    first[i] = &kNodes[index(lane(largest, static_cast<int>(i)), z.cell[i], y.cell[i], x.cell[i])];
  // Two neighbours on the axis x stand side by side.
  const auto row = [&](int offset) {
    const auto n = gather_rows<8>([&](int i) { return first[static_cast<std::size_t>(i)] + offset; });
    return mix(Three{n[0], n[1], n[2]}, Three{n[3], n[4], n[5]}, x.fraction);
  };
  constexpr int kNextY = index(0, 0, 1, 0), kNextZ = index(0, 1, 0, 0);
  return mix(mix(row(0), row(kNextY), y.fraction), mix(row(kNextZ), row(kNextZ + kNextY), y.fraction),
             z.fraction);
}

}  // namespace

SigmoidLanes tabulated_reflectance(const Vec3Lanes& rgb) {
  const Lanes r = unit(rgb.x), g = unit(rgb.y), b = unit(rgb.z);
  const IntLanes red = (r > g) & (r > b), green = ~(r > g) & (g > b), is_grey = (r == g) & (g == b);
  const Lanes z = max(max(r, g), b), next = select(red, g, select(green, b, r)),
              last = select(red, b, select(green, r, g)), per_z = 1.0f / max(z, Lanes{} + 1e-30f);
  const Three c = interpolate(select(red, IntLanes{}, select(green, IntLanes{} + 1, IntLanes{} + 2)),
                              Places(z), Places(next * per_z), Places(last * per_z));
  const Lanes mean = grey(select(is_grey, r, (r + g + b) * (1.0f / 3.0f))), scale = sqrt(per_z);
  return {select(is_grey, Lanes{}, c[0] * scale), select(is_grey, Lanes{}, c[1] * scale),
          mean + select(is_grey, Lanes{}, c[2] * scale)};
}

}  // namespace photopic
