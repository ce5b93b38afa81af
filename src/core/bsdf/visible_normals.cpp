#include "core/bsdf/visible_normals.h"

namespace photopic {

VisibleNormals::VisibleNormals(int count) {
  for (int first = 0; first < count; first += kLanes) {
    Lanes turn{}, rise{}, weight{};
    for (int lane = 0; lane < kLanes; ++lane) {
      const double i = first + lane + 0.5, y = i / count, turns = i / std::numbers::phi;
      turn[lane] = static_cast<float>(turns - std::floor(turns));
      rise[lane] = static_cast<float>(y * y), weight[lane] = static_cast<float>(2.0 * y / count);
    }
    const SinCos phi = sin_cos_two_pi(turn);
    turn_.push_back(turn), cos_.push_back(phi.cos), sin_.push_back(phi.sin);
    rise_.push_back(rise), weight_.push_back(weight);
  }
}

// AnisotropicGgx::sample_visible and lambda in lanes. With s = lambda(wi)·G1(wo), kept is G2/G1 = 1/(1 + s).
VisibleNormals::Bounces VisibleNormals::bounces(const AnisotropicGgx& ggx, Vec3f wo) const {
  const std::size_t n = weight_.size();
  Bounces all{std::vector<Lanes>(n), std::vector<Lanes>(n)};
  Lanes lost{};
  const float ax = ggx.alpha_x, ay = ggx.alpha_y, g1 = ggx.g1(wo);
  const Vec3f seen = normalize(Vec3f{wo.x * ax, wo.y * ay, wo.z});
  for (std::size_t i = 0; i < n; ++i) {
    const Lanes z = rise_[i] * (1.0f + seen.z) - seen.z, r = sqrt(max(Lanes{}, 1.0f - z * z));
    const Vec3Lanes h{(r * cos_[i] + seen.x) * ax, (r * sin_[i] + seen.y) * ay,
                      max(Lanes{} + 1e-6f, z + seen.z)};
    const Vec3Lanes m = h * (1.0f / sqrt(dot(h, h)));
    const Lanes cosine = dot(broadcast<Lanes>(wo), m);
    const Vec3Lanes wi = m * (2.0f * cosine) - broadcast<Lanes>(wo);
    const Lanes x = wi.x * ax / wi.z, y = wi.y * ay / wi.z;
    const Lanes s = (0.5f * g1) * (sqrt(1.0f + x * x + y * y) - 1.0f);
    all.cosine[i] = cosine;
    all.kept[i] = weight_[i] * select(wi.z > 0.0f, 1.0f / (1.0f + s), Lanes{});
    lost += weight_[i] * select(wi.z > 0.0f, 1.0f / (1.0f + 1.0f / s), Lanes{} + 1.0f);
  }
  for (int lane = 0; lane < kLanes; ++lane) all.missing += lost[lane];
  return all;
}

}  // namespace photopic
