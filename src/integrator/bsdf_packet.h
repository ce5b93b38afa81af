#pragma once

#include <optional>

#include "core/bsdf/opaque_bsdf.h"
#include "core/upsampling_lanes.h"

namespace photopic {

/// Where up to 16 paths go on: BsdfSample's fields, directions in the shading frame.
template <int N>
struct DirectionSamples {
  Vec3Lanes wi{};
  SpectrumLanes<N> weight{0.0f};
  Lanes pdf{}, eta = Lanes{} + 1.0f;      ///< pdf is 0 of a delta
  IntLanes found{}, split{}, straight{};  ///< masks
};

/// The BSDFs of up to 16 paths, made and asked one by one.
template <int N, typename Bsdf>
class OneByOne {
 public:
  /// @param make gives the BSDF of a lane
  template <typename Make>
  OneByOne(const Packet& packet, const Make& make) {
    for (int i = 0; i < packet.count; ++i) bsdf_[static_cast<std::size_t>(i)].emplace(make(i));
  }

  /// The lanes that have no value to evaluate.
  IntLanes deltas(const Packet& packet) const {
    IntLanes result{};
    if constexpr (requires(const Bsdf& b) { b.is_delta(); })
      for (int i = 0; i < packet.count; ++i) result[i] = bsdf_of(i).is_delta() ? -1 : 0;
    return result;
  }

  /// @param asked mask of the lanes whose value matters; the others' are zero
  BasicBsdfValue<N, Lanes> evaluate(const Vec3Lanes& wi, IntLanes asked) const {
    LaneSpectra<N> f_cos{};
    Lanes pdf{};
    for_each_lane(asked, [&](int i) {
      const BsdfValue<N> value = bsdf_of(i).evaluate(lane(wi, i));
      f_cos[static_cast<std::size_t>(i)] = value.f_cos, pdf[i] = value.pdf;
    });
    return {to_lanes<N>(f_cos), pdf};
  }

  DirectionSamples<N> sample(const Packet& packet, Lanes u_lobe, const Sample2dLanes& u) const {
    DirectionSamples<N> samples;
    LaneSpectra<N> weight{};
    for (int i = 0; i < packet.count; ++i) {
      const auto s = bsdf_of(i).sample(lane(u_lobe, i), lane(u, i));
      if (!s) continue;
      set_lane(samples.wi, i, s->wi);
      weight[static_cast<std::size_t>(i)] = s->weight;
      samples.pdf[i] = s->delta ? 0.0f : s->pdf, samples.eta[i] = s->eta;
      samples.found[i] = -1, samples.split[i] = s->split ? -1 : 0;
      samples.straight[i] = s->straight ? -1 : 0;
    }
    samples.weight = to_lanes<N>(weight);
    return samples;
  }

 private:
  const Bsdf& bsdf_of(int i) const { return *bsdf_[static_cast<std::size_t>(i)]; }

  std::array<std::optional<Bsdf>, kLanes> bsdf_;
};

/// The same, all at once.
template <int N, typename Bsdf>
class InLanes {
 public:
  InLanes(const auto& material, const Vec3Lanes& wo) : bsdf_(material, wo) {}

  IntLanes deltas(const Packet&) const { return IntLanes{}; }

  BasicBsdfValue<N, Lanes> evaluate(const Vec3Lanes& wi, IntLanes asked) const {
    BasicBsdfValue<N, Lanes> value = bsdf_.evaluate(wi);
    value.pdf = select(asked, value.pdf, Lanes{});
    return value;
  }

  DirectionSamples<N> sample(const Packet& packet, Lanes u_lobe, const Sample2dLanes& u) const {
    const BsdfDraw<N, Lanes> draw = bsdf_.draw(u_lobe, u);
    return {.wi = draw.wi,
            .weight = draw.weight,
            .pdf = select(draw.delta, Lanes{}, draw.pdf),
            .eta = Lanes{} + 1.0f,
            .found = draw.found & packet.used(),
            .split = IntLanes{},
            .straight = IntLanes{}};
  }

 private:
  Bsdf bsdf_;
};

/// Of a surface on which all lanes lie, where it is the same all over and easily had. @param lambda [nm]
template <int N>
PHOTOPIC_INLINE std::optional<SpectrumLanes<N>> uniform_color(const Spectrum& color,
                                                              const SpectrumLanes<N>& lambda) {
  if (const auto* constant = std::get_if<ConstantSpectrum>(&color))
    return SpectrumLanes<N>(static_cast<float>(constant->value));
  if (const auto* s = std::get_if<SigmoidPolynomial>(&color))
    return SpectrumLanes<N>::each(
        [&](const Lanes& nm) { return SigmoidPolynomial::at(nm, s->c0, s->c1, s->c2); }, lambda);
  return {};
}

/// @param color_of gives a lane's
template <int N, typename ColorOf>
SpectrumLanes<N> colors_one_by_one(const Packet& packet, const ColorOf& color_of) {
  LaneSpectra<N> colors{};
  for (int i = 0; i < packet.count; ++i) colors[static_cast<std::size_t>(i)] = color_of(i);
  return to_lanes<N>(colors);
}

/// @param material_at gives the ShadingMaterial of a lane, whose base colour varies
template <typename MaterialAt>
PHOTOPIC_INLINE Vec3Lanes base_rgb_of(const Packet& packet, const MaterialAt& material_at) {
  std::array<Float4, kLanes> rows{};
  for (int i = 0; i < packet.count; ++i) {
    const Vec3f rgb = material_at(i).base_rgb();
    rows[static_cast<std::size_t>(i)] = Float4{rgb.x, rgb.y, rgb.z};
  }
  const auto [r, g, b, rest] = gather_rows<4>([&](int i) { return &rows[static_cast<std::size_t>(i)]; });
  return {r, g, b};
}

/// @param material_at gives the ShadingMaterial of a lane @param surface on which all lanes lie, or null
/// @param lambda_of gives the wavelengths of all lanes [nm]
template <int N, typename MaterialAt, typename LambdaOf>
PHOTOPIC_INLINE SpectrumLanes<N> base_colors(const Packet& packet, const MaterialAt& material_at,
                                             const Surface* surface, const LambdaOf& lambda_of) {
  if (surface != nullptr && !surface->base_varies)
    if (auto color = uniform_color<N>(surface->base_color, lambda_of())) return *color;
  if (surface != nullptr && surface->base_varies && !surface->base_is_measured)
    return tabulated_reflectance(base_rgb_of(packet, material_at))(lambda_of());
  return colors_one_by_one<N>(packet, [&](int i) { return material_at(i).base_color(); });
}

/// @param in_vacuum whether all lanes are
template <int N, typename MaterialAt, typename LambdaOf>
PHOTOPIC_INLINE SpectrumLanes<N> dielectric_f0s(const Packet& packet, const MaterialAt& material_at,
                                                const Surface* surface, const LambdaOf& lambda_of,
                                                bool in_vacuum) {
  if (surface != nullptr && in_vacuum && !(surface->textures && surface->textures->specular_color))
    if (auto color = uniform_color<N>(surface->specular_color, lambda_of()))
      return *color * (surface->specular_scale * normal_reflectance(surface->ior));
  return colors_one_by_one<N>(packet, [&](int i) { return material_at(i).dielectric_f0(); });
}

template <int N, typename MaterialAt, typename LambdaOf>
OpaqueMaterial<N, Lanes> opaque_materials(const Packet& packet, const MaterialAt& material_at,
                                          const Surface* surface, const LambdaOf& lambda_of, bool in_vacuum) {
  OpaqueMaterial<N, Lanes> m;
  m.base = base_colors<N>(packet, material_at, surface, lambda_of);
  m.f0 = dielectric_f0s<N>(packet, material_at, surface, lambda_of, in_vacuum);
  if (surface != nullptr && !surface->textures) {
    const ShadingMaterial<N> one = material_at(0);
    m.roughness = Lanes{} + one.roughness(), m.metallic = Lanes{} + one.opaque_metallic();
    m.specular = Lanes{} + one.specular();
    return m;
  }
  std::array<Float4, kLanes> rows{};
  for (int i = 0; i < packet.count; ++i) {
    const ShadingMaterial<N> one = material_at(i);
    rows[static_cast<std::size_t>(i)] = Float4{one.roughness(), one.opaque_metallic(), one.specular()};
  }
  const auto numbers = gather_rows<4>([&](int i) { return &rows[static_cast<std::size_t>(i)]; });
  m.roughness = numbers[0], m.metallic = numbers[1], m.specular = numbers[2];
  return m;
}

/// How the BSDFs of a kind stand in packets.
template <int N, typename Bsdf>
struct BsdfPacketOf {
  using Type = OneByOne<N, Bsdf>;
};
template <int N>
struct BsdfPacketOf<N, DiffuseBsdf<N>> {
  using Type = InLanes<N, BasicDiffuseBsdf<N, Lanes>>;
};
template <int N>
struct BsdfPacketOf<N, OpaqueBsdf<N>> {
  using Type = InLanes<N, BasicOpaqueBsdf<N, Lanes>>;
};
template <int N, typename Bsdf>
using BsdfPacket = typename BsdfPacketOf<N, Bsdf>::Type;

}  // namespace photopic
