#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/bsdf/fresnel.h"
#include "core/bsdf/visible_normals.h"

namespace photopic {

/// The share of light that one bounce off, or one passage through, a rough dielectric interface loses between
/// its microfacets (both together; GGX, exact Fresnel terms). Glass BSDFs give it back as Kulla & Conty 2017
/// do, in a lobe that is the product of what is missing from either direction, on both sides.
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
    std::optional<Film> film;  ///< what it adds, `specular` included
  };

  /// Integrates the table: 10 to 40 ms of one core for each index and roughness, of which a range has 24.
  /// @param iors ratios of the denser medium's index to the other's, rising, > 1; exact there, interpolated
  /// between @param roughness √α, in [0, 1] @param films whether there will be any
  GlassAlbedo(std::vector<float> iors, Range roughness, bool films = false);

  /// What is missing of light seen at cos_theta. @param cos_theta of the direction to the normal on its side,
  /// in [0, 1] @param eta η_t/η_i as seen from there
  float missing(float cos_theta, float roughness, float eta, const Reflection& reflection) const;
  /// The same averaged over that side's directions, weighed by the cosine; above 0.
  float average_missing(float roughness, float eta, const Reflection& reflection) const;

 private:
  /// What is missing, and what is gained when all that is reflected, though it might pass, passes instead:
  /// plainly, and weighed with Schlick's weight; and when all that might pass is reflected, what passes and
  /// what does not.
  struct Share {
    float missing = 0.0f, exchanged = 0.0f, exchanged_grazing = 0.0f, all = 0.0f;

    float of(SpecularScale s) const {
      return missing - (1.0f - s.at_normal * s.passed) * exchanged -
             (s.at_normal - s.at_grazing) * exchanged_grazing + s.at_normal * (1.0f - s.passed) * all;
    }
    void add(const Share& other, float factor) {
      missing += factor * other.missing, all += factor * other.all;
      exchanged += factor * other.exchanged, exchanged_grazing += factor * other.exchanged_grazing;
    }
  };
  void integrate(const VisibleNormals& normals, float cos_theta, float roughness, float eta,
                 std::size_t entry);
  std::size_t entry(std::size_t ior, int roughness, bool inside, int cosine) const;
  float of(std::size_t entry, const Reflection& reflection) const;
  template <typename F>
  float interpolate(float roughness, float eta, const F& row) const;

  std::vector<float> iors_;
  Range roughness_;
  int roughnesses_;              ///< number of nodes, whose roots are equally far apart
  std::vector<Share> share_;     ///< [ior][roughness][side][cos θ], then the average
  std::vector<Film> exchanged_;  ///< what is gained by each node's light passing; empty without films
};

}  // namespace photopic
