#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "spectral/piecewise_density.h"
#include "spectral/spectrum.h"

namespace photopic {

/// The uniform density's share in a base density: the illuminant sampler's weights are at most
/// 1/kDefensiveShare times those of uniform sampling, however dark the lamp is there.
inline constexpr double kDefensiveShare = 0.02;

/// The base density b(λ) [1/nm]: piecewise linear through the values of I·c on the union of the emission I's
/// knots and the observer's, c = 0.6 x̄ + ȳ + 0.35 z̄, with a uniform share of `defensive` mixed in, and then a
/// share of `visible` of VisibleWavelengths' sech² density. (The more of that, the smoother the estimate's
/// weights, which many wavelengths can use; the less, the more closely a lamp's lines are followed.)
/// @throws std::invalid_argument when the emission is zero from 360 to 830 nm, or a share is not in [0, 1]
PiecewiseLinearDensity base_density(const TabulatedSpectrum& emission, double defensive = kDefensiveShare,
                                    double visible = 0.0);

/// N densities p_k(λ) = q_k(B(λ))·b(λ): q_k piecewise linear on equal cells of t = B(λ) in [0, 1]. All are
/// driven by one u: λ_k = B⁻¹(Q_k⁻¹(u_k)), u_k = u or, where the density runs backwards, 1 − u.
struct WavelengthDistribution {
  /// One density on t: node values > 0 (any scale; normalised on use) at t = i/(n − 1), and its orientation.
  /// Of a stepped distribution the values are those of n cells, and only their sum over the components must
  /// be > 0 in each.
  struct Component {
    std::vector<double> nodes;
    bool backwards = false;
  };

  /// What an optimisation aimed at.
  struct TargetRecord {
    std::string white = "D65";         ///< of ΔE; or "illuminant"
    int constructed = 0;               ///< the optimiser's own reflectances, R = 1 among them
    std::uint64_t seed = 0;            ///< theirs, and the search's
    int measured = 0;                  ///< further ones that the user gave
    std::string measured_file = {};    ///< as the user named it
    std::string measured_digest = {};  ///< reflectances_digest()
  };

  PiecewiseLinearDensity base;
  std::vector<Component> components;  ///< N of them

  // Where it comes from: kept in the file, so that a render can tell a distribution made for other lamps.
  std::string spectrum = {};         ///< as the user named it
  std::string spectrum_digest = {};  ///< digest() of the tabulated emission
  std::string objective = {};        ///< "asymptotic" or "mean-delta-e"
  TargetRecord targets = {};
  double optimize_seconds = 0.0;  ///< wall clock of the search
  double value = 0.0;             ///< the objective's value reached [ΔE]
  double illuminant_value = 0.0, visible_value = 0.0, uniform_value = 0.0;  ///< the baselines' [ΔE]

  bool stepped = false;  ///< the densities are constant on equal cells of t, rather than linear
};

/// The q_k, all with the same knots.
/// @throws std::invalid_argument when there are none, they differ in their number of nodes, or have too few
std::vector<PiecewiseLinearDensity> densities_on_t(const WavelengthDistribution& distribution);

/// The distribution's JSON file: versioned, self-contained, written whole or not at all.
/// @throws InputError when it cannot be written, read, or does not hold what it should
void write_distribution(const std::filesystem::path& file, const WavelengthDistribution& distribution);
WavelengthDistribution read_distribution(const std::filesystem::path& file);

}  // namespace photopic
