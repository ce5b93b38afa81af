#include "support/bsdf_checks.h"

#include <array>
#include <memory>
#include <numbers>

#include "core/bsdf/conductor_bsdf.h"
#include "core/bsdf/glass_bsdf.h"
#include "core/bsdf/layered_bsdf.h"
#include "core/bsdf/opaque_bsdf.h"
#include "core/bsdf/spectral_glass_bsdf.h"
#include "core/prepared_scene.h"

namespace photopic::test {
namespace {

using Value = LocalBsdf::Value;

Value operator+(Value a, Value b) {
  return {a.f_cos + b.f_cos, a.pdf + b.pdf};
}
Value operator*(Value a, double s) {
  return {a.f_cos * s, a.pdf * s};
}

template <typename Bsdf>
Bsdf make_bsdf(const Surface& surface, Vec3f wo) {
  SampledSpectrum<4> lambda;
  for (int j = 0; j < 4; ++j) lambda.set(j, 450.0f + 50.0f * static_cast<float>(j));
  const ShadingMaterial<4> material(surface, lambda);
  if constexpr (std::is_constructible_v<Bsdf, ShadingMaterial<4>, Vec3f, SampledSpectrum<4>>)
    return Bsdf(material, wo, SampledSpectrum<4>(1.0f));
  else
    return Bsdf(material, wo);
}

/// Made anew only where wo changes.
template <typename Bsdf>
class BsdfMaker {
 public:
  explicit BsdfMaker(const Material& material) : surface_(material) {
    prepare_albedos({true}, {&surface_, 1});
  }
  const Bsdf& operator()(Vec3f wo) {
    if (!bsdf_ || !(wo == wo_)) bsdf_.emplace(make_bsdf<Bsdf>(surface_, wo)), wo_ = wo;
    return *bsdf_;
  }

 private:
  Surface surface_;
  Vec3f wo_;
  std::optional<Bsdf> bsdf_;
};

template <typename Bsdf>
LocalBsdf wrap(const Material& material, int lane) {
  const auto make = std::make_shared<BsdfMaker<Bsdf>>(material);
  return {[=](Vec3f wo, Vec3f wi) -> Value {
            const auto v = (*make)(wo).evaluate(wi);
            return {v.f_cos[lane], v.pdf};
          },
          [=](Vec3f wo, float u_lobe, Sample2d u) -> std::optional<LocalBsdf::Sample> {
            const auto s = (*make)(wo).sample(u_lobe, u);
            if (!s) return {};
            return LocalBsdf::Sample{s->wi, s->weight[lane], s->pdf, s->delta, s->eta};
          }};
}

/// Gauss–Legendre with 4 × 4 points, then the four quarters until they agree.
template <typename F>
Value quadrature(const F& f, double x0, double x1, double y0, double y1) {
  constexpr std::array<double, 4> kNode{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                        0.8611363115940526};
  constexpr std::array<double, 4> kWeight{0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                          0.3478548451374538};
  Value sum;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      sum = sum + f(0.5 * (x0 + x1 + (x1 - x0) * kNode[i]), 0.5 * (y0 + y1 + (y1 - y0) * kNode[j])) *
                      (kWeight[i] * kWeight[j]);
  return sum * (0.25 * (x1 - x0) * (y1 - y0));
}

template <typename F>
Value adaptive(const F& f, Value whole, double x0, double x1, double y0, double y1, int depth) {
  constexpr int kDeepest = 7;
  constexpr double kTolerance = 3e-6;
  const double x = 0.5 * (x0 + x1), y = 0.5 * (y0 + y1);
  const Value a = quadrature(f, x0, x, y0, y), b = quadrature(f, x, x1, y0, y),
              c = quadrature(f, x0, x, y, y1), d = quadrature(f, x, x1, y, y1);
  const Value parts = a + b + c + d;
  const double tolerance = kTolerance / (1 << depth);
  if (depth == kDeepest || (depth > 0 && std::abs(parts.f_cos - whole.f_cos) < tolerance &&
                            std::abs(parts.pdf - whole.pdf) < tolerance))
    return parts;
  return adaptive(f, a, x0, x, y0, y, depth + 1) + adaptive(f, b, x, x1, y0, y, depth + 1) +
         adaptive(f, c, x0, x, y, y1, depth + 1) + adaptive(f, d, x, x1, y, y1, depth + 1);
}

double cube(double x) {
  return x * x * x;
}

}  // namespace

LocalBsdf local_bsdf(const Material& material, int lane) {
  const Surface surface(material);
  switch (surface.transmits ? surface.glass_kind : surface.opaque_kind) {
    case BsdfKind::diffuse:
      return wrap<DiffuseBsdf<4>>(material, lane);
    case BsdfKind::opaque:
      return wrap<OpaqueBsdf<4>>(material, lane);
    case BsdfKind::glass:
      return wrap<GlassBsdf<4>>(material, lane);
    case BsdfKind::spectral_glass:
      return wrap<SpectralGlassBsdf<4>>(material, lane);
    case BsdfKind::conductor:
      return wrap<ConductorBsdf<4>>(material, lane);
    case BsdfKind::layered:
      return wrap<LayeredBsdf<4>>(material, lane);
  }
  return {};
}

Vec3f direction(double cos_theta) {
  const double sin_theta = std::sqrt(std::max(0.0, 1.0 - cos_theta * cos_theta)), phi = 0.7;
  return to_float({sin_theta * std::cos(phi), sin_theta * std::sin(phi), cos_theta});
}

SphereCells::SphereCells(Vec3f axis) : axis_(axis) {
  const Frame frame = Frame::about(axis);
  s_ = frame.s, t_ = frame.t;
}

std::size_t SphereCells::cell_of(Vec3f w) const {
  const Vec3d d = to_double(w);
  const double x = dot(to_double(s_), d), y = dot(to_double(t_), d), z = dot(to_double(axis_), d);
  const double polar = std::atan2(std::hypot(x, y), z), phi = std::atan2(y, x);
  const int ring = static_cast<int>(kRings * std::cbrt(polar / std::numbers::pi));
  const int sector = static_cast<int>(kSectors * (phi / (2.0 * std::numbers::pi) + 0.5));
  return static_cast<std::size_t>(std::clamp(ring, 0, kRings - 1) * kSectors +
                                  std::clamp(sector, 0, kSectors - 1));
}

std::vector<Value> SphereCells::integrate(const SphereFunction& f) const {
  // x: cube root of the polar angle over π; y: azimuth over 2π, from −1/2.
  const auto integrand = [&](double x, double y) {
    const double polar = std::numbers::pi * cube(x), phi = 2.0 * std::numbers::pi * y;
    const Vec3d w = to_double(s_) * (std::sin(polar) * std::cos(phi)) +
                    to_double(t_) * (std::sin(polar) * std::sin(phi)) + to_double(axis_) * std::cos(polar);
    const double jacobian = std::sin(polar) * 3.0 * x * x * 2.0 * std::numbers::pi * std::numbers::pi;
    return f(to_float(normalize(w))) * jacobian;
  };
  std::vector<Value> cells;
  for (int r = 0; r < kRings; ++r)
    for (int s = 0; s < kSectors; ++s) {
      const double x0 = static_cast<double>(r) / kRings, x1 = static_cast<double>(r + 1) / kRings;
      const double y0 = static_cast<double>(s) / kSectors - 0.5,
                   y1 = static_cast<double>(s + 1) / kSectors - 0.5;
      cells.push_back(adaptive(integrand, quadrature(integrand, x0, x1, y0, y1), x0, x1, y0, y1, 0));
    }
  return cells;
}

BsdfReport examine(const LocalBsdf& bsdf, Vec3f wo, Vec3f axis, int samples, std::uint32_t seed) {
  const SphereCells cells(axis);
  std::vector<double> observed(cells.size() + 1), expected;
  Value total;
  for (const Value& v : cells.integrate([&](Vec3f wi) { return bsdf.evaluate(wo, wi); })) {
    expected.push_back(v.pdf * samples);
    total = total + v;
  }
  expected.push_back(samples * std::max(0.0, 1.0 - total.pdf));  // samples that failed

  RunningMean albedo;
  BsdfReport report{};
  for (int i = 0; i < samples; ++i) {
    const SampleStream stream(Sequence::independent, seed, 0, static_cast<std::uint32_t>(i));
    const auto s = bsdf.sample(wo, stream.get_1d(0), stream.get_2d(1));
    ++observed[s ? cells.cell_of(s->wi) : cells.size()];
    albedo.add(s ? s->weight : 0.0);
    if (!s) continue;
    const Value v = bsdf.evaluate(wo, s->wi);
    report.worst_pdf = std::max(report.worst_pdf, std::abs(s->pdf - v.pdf) / v.pdf);
    report.worst_weight = std::max(report.worst_weight, std::abs(s->weight * v.pdf - v.f_cos) / v.f_cos);
  }
  report.chi_square_p = chi_square_p_value(observed, expected);
  report.pdf_integral = total.pdf;
  report.albedo_quadrature = total.f_cos;
  report.albedo = albedo.estimate();
  return report;
}

Estimate sampled_albedo(const LocalBsdf& bsdf, Vec3f wo, int samples, bool scaled) {
  RunningMean albedo;
  for (int i = 0; i < samples; ++i) {
    const SampleStream stream(Sequence::sobol, 1, 0, static_cast<std::uint32_t>(i));
    const auto s = bsdf.sample(wo, stream.get_1d(0), stream.get_2d(1));
    albedo.add(s ? s->weight * (scaled ? s->eta * s->eta : 1.0) : 0.0);
  }
  return albedo.estimate();
}

Furnace furnace(const LocalBsdf& bsdf, Vec3f wo, double ior) {
  constexpr std::uint32_t kSequences = 8, kFewest = 128, kMost = 16384;
  constexpr int kLobes = 16;  // choices of the lobe at every point, equally far apart
  constexpr double kError = 0.001, kBound = 0.005;
  const double crossing = wo.z > 0.0f ? ior * ior : 1.0 / (ior * ior);
  std::array<double, kSequences> sums{};
  RunningMean weights;
  Furnace result{{0.0, 1.0}, 0.0, 0.0};
  std::uint32_t i = 0;
  const auto is_decided = [&] {
    const double error = result.albedo.error;
    return error < kError && std::abs(std::abs(result.albedo.mean - 1.0) - kBound) > 3.0 * error;
  };
  for (std::uint32_t end = kFewest; end <= kMost && !is_decided(); end *= 2) {
    for (; i < end; ++i)
      for (std::uint32_t seed = 0; seed < kSequences; ++seed) {
        const SampleStream stream(Sequence::sobol, seed, 0, i);
        for (int lobe = 0; lobe < kLobes; ++lobe) {
          const float u_lobe = (stream.get_1d(0) + static_cast<float>(lobe)) / kLobes;
          const auto s = bsdf.sample(wo, std::min(u_lobe, 0x1.fffffep-1f), stream.get_2d(1));
          const double weight = s ? s->weight * (s->wi.z * wo.z < 0.0f ? crossing : 1.0) : 0.0;
          sums[seed] += weight, weights.add(weight);
          result.largest = std::max(result.largest, weight);
        }
      }
    RunningMean means;
    for (const double sum : sums) means.add(sum / (end * kLobes));
    result.albedo = means.estimate();
    result.variance = weights.estimate().error * weights.estimate().error * kSequences * end * kLobes;
  }
  return result;
}

}  // namespace photopic::test
