#pragma once

#include <array>
#include <vector>

#include "core/fresnel.h"
#include "core/visible_normals.h"

namespace photopic {

/// The share of light that one bounce off, or one passage through, a rough dielectric interface keeps (both
/// together; GGX, exact Fresnel terms). What is missing goes on between the microfacets; glass BSDFs give it
/// back by dividing by this share, after Turquin 2019 ("Practical multiple scattering compensation for
/// microfacet models").
class GlassAlbedo {
 public:
  struct Range {
    float low, high;
  };

  /// What a film on the interface adds to the reflectance, linear in the cosine in the thinner medium between
  /// the nodes and 0, where it is 0. From inside it is the same.
  static constexpr int kFilmNodes = 16;
  using Film = std::array<float, kFilmNodes>;
  static float film_node(int k) { return static_cast<float>(k + 1) / kFilmNodes; }

  /// How reflectance differs from that of the bare interface.
  struct Reflection {
    SpecularScale specular;
    const Film* film = nullptr;  ///< its difference times `specular`; null: none
  };

  /// Integrates the table: 10 to 40 ms for each index and roughness, of which a range has 24.
  /// @param iors ratios of the denser medium's index to the other's, rising, > 1; exact there, interpolated
  /// between @param roughness √α, in [0, 1] @param films whether there will be any
  GlassAlbedo(std::vector<float> iors, Range roughness, bool films = false);

  /// @param cos_theta of the viewer to the normal on his side, in [0, 1] @param eta η_t/η_i as he sees it
  float operator()(float cos_theta, float roughness, float eta, const Reflection& reflection) const;

 private:
  /// The share, and what it gains when all that is reflected, though it might pass, passes instead: plainly,
  /// and weighed with Schlick's weight.
  struct Share {
    float total = 0.0f, exchanged = 0.0f, exchanged_grazing = 0.0f;

    float of(SpecularScale s) const {
      return total + (1.0f - s.at_normal) * exchanged + (s.at_normal - s.at_grazing) * exchanged_grazing;
    }
  };
  void integrate(const VisibleNormals& normals, float cos_theta, float roughness, float eta,
                 std::size_t entry);
  std::size_t entry(std::size_t ior, int roughness, bool inside, int cosine) const;
  float row(std::size_t ior, int roughness, bool inside, float cos_theta, const Reflection& reflection) const;

  std::vector<float> iors_;
  Range roughness_;
  int roughnesses_;  ///< number of nodes, equally far apart
  std::vector<Share> share_;
  std::vector<Film> exchanged_;  ///< what it gains by each node's share of light passing; empty without films
};

}  // namespace photopic
