#pragma once

#include <optional>

#include "core/opaque_bsdf.h"

namespace photopic {

/// Where up to 16 paths go on: BsdfSample's fields, directions in the shading frame.
template <int N>
struct DirectionSamples {
  Vec3Lanes wi{};
  SpectrumLanes<N> weight{0.0f};
  Lanes pdf{}, eta = Lanes{} + 1.0f;  ///< pdf is 0 of a delta
  IntLanes found{}, split{};          ///< masks
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
      const auto s = bsdf_of(i).sample(u_lobe[i], lane(u, i));
      if (!s) continue;
      set_lane(samples.wi, i, s->wi);
      weight[static_cast<std::size_t>(i)] = s->weight;
      samples.pdf[i] = s->delta ? 0.0f : s->pdf, samples.eta[i] = s->eta;
      samples.found[i] = -1, samples.split[i] = s->split ? -1 : 0;
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
            .split = IntLanes{}};
  }

 private:
  Bsdf bsdf_;
};

/// @param material_at gives the ShadingMaterial of a lane
template <int N, typename MaterialAt>
SpectrumLanes<N> base_colors(const Packet& packet, const MaterialAt& material_at) {
  LaneSpectra<N> colors{};
  for (int i = 0; i < packet.count; ++i) colors[static_cast<std::size_t>(i)] = material_at(i).base_color();
  return to_lanes<N>(colors);
}

template <int N, typename MaterialAt>
OpaqueMaterial<N, Lanes> opaque_materials(const Packet& packet, const MaterialAt& material_at) {
  LaneSpectra<N> base{}, specular_color{};
  OpaqueMaterial<N, Lanes> m;
  m.roughness = m.metallic = m.specular = m.r0 = Lanes{};
  for (int i = 0; i < packet.count; ++i) {
    const OpaqueMaterial<N, float> one = opaque_material(material_at(i));
    base[static_cast<std::size_t>(i)] = one.base;
    specular_color[static_cast<std::size_t>(i)] = one.specular_color;
    m.roughness[i] = one.roughness, m.metallic[i] = one.metallic;
    m.specular[i] = one.specular, m.r0[i] = one.r0;
  }
  m.base = to_lanes<N>(base), m.specular_color = to_lanes<N>(specular_color);
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
